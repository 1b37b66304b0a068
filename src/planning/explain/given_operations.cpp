#include "given_operations.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/clamping/made_surfaces.hpp"

namespace turnwright::planning {
namespace {

// The fixed operations of a setup in any of its clampings.
struct FixedWork {
  std::vector<OperationPlan> operations;
  bool refused = false;  // some of them
};
std::vector<FixedWork> fixed_work(const PreparedPart& p) {
  std::vector<FixedWork> all(p.setups.size());
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    for (const auto clamping : p.setups[s].clampings) {
      const auto work =
          auxiliary_work(p, s, clamping, p.work.setups[s], {p.machine_per_min, 1});
      for (const auto& o : work.all()) all[s].operations.push_back(o.plan);
      all[s].refused = all[s].refused || !work.conflicts.empty();
    }
  return all;
}

const part::InnerElement* bore(const part::Drawing& d, const std::string& surface) {
  const auto e = std::ranges::find(d.inner, surface, &part::InnerElement::id);
  return e == d.inner.end() ? nullptr : &*e;
}

bool is_hole(const part::Drawing& d, const std::string& surface) {
  const auto* e = bore(d, surface);
  return e && part::is_hole(*e);
}

// Whether a fixed operation works on a surface; one drill makes all bores of an end.
bool works_on(const part::Drawing& d, const OperationPlan& o,
              const std::string& surface) {
  const auto *own = bore(d, o.on.front()), *other = bore(d, surface);
  return o.on.front() == surface || (own && other && own->from == other->from);
}

bool cuts(const PreparedPart& p, const OperationRequest& o, const FixedWork& fixed) {
  if (o.kind != OperationKind::fixed)
    return std::ranges::all_of(o.on, [&](const std::string& surface) {
      return setup_of(p, surface) == o.setup && !is_hole(p.drawing, surface);
    });
  return fixed.refused ||
         std::ranges::any_of(fixed.operations, [&](const OperationPlan& made) {
           return made.id == o.id || made.id.starts_with(o.id + ":");
         });
}

// Why an operation does not cut a surface.
std::string why_not(const PreparedPart& p, const OperationRequest& o,
                    const std::string& surface, const FixedWork& fixed) {
  const auto setup = setup_of(p, surface);
  if (!setup) return tr("no setup cuts that by itself");
  if (*setup != o.setup) return say("that is made in {}", setup_label(*setup));
  std::string others;
  for (const auto& made : fixed.operations)
    if (works_on(p.drawing, made, surface) && others.find(made.id) == std::string::npos)
      others += (others.empty() ? "" : ", ") + made.id;
  return others.empty() ? tr("nothing of this kind is left to do there")
                        : say("that is made by {}", others);
}

}  // namespace

void add_left_out(const PreparedPart& p, ProcessPlan& result) {
  if (!p.operations) return;
  const auto fixed = fixed_work(p);
  for (const auto& o : *p.operations) {
    const auto& in_setup = fixed.at(o.setup);
    if (cuts(p, o, in_setup)) continue;
    const auto surface = std::ranges::find_if(o.on, [&](const std::string& each) {
      return setup_of(p, each) != o.setup || is_hole(p.drawing, each);
    });
    const auto& named = surface == o.on.end() ? o.on.front() : *surface;
    result.conflicts.push_back(
        {to_translate("operations"), setup_label(o.setup) + ", " + o.id, 0, 0, "",
         say("{} does not cut {} in {}: {}", o.id, named, setup_label(o.setup),
             why_not(p, o, named, in_setup))});
  }
}

}  // namespace turnwright::planning
