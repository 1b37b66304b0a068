#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/say.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "turnwright/review/review.hpp"

namespace turnwright::review {
namespace {

using planning::OperationKind;
using planning::OperationRequest;

constexpr double kSame_mm = 1e-3;
constexpr double kKept = 0.01;  // of a limit, by which it may be passed

bool alike(const Cut& a, const Cut& b) {
  return a.tool == b.tool && a.at.f_mm_rev == b.at.f_mm_rev && a.at.S == b.at.S &&
         a.at.constant_surface_speed == b.at.constant_surface_speed;
}

OperationRequest operation(std::size_t setup, OperationKind kind, const std::string& on,
                           const Cut& c, int passes, std::optional<double> ap_mm) {
  OperationRequest o;
  auto surface = on;
  std::ranges::replace(surface, '|', '-');
  o.id = fmt::format("s{}-{}-{}", setup + 1, planning::name(kind), surface);
  o.setup = setup;
  o.kind = kind;
  o.on = {on};
  o.tool = c.tool_id;
  const double v = c.at.constant_surface_speed ? c.at.S : c.loads.vc_m_min;
  o.conditions = {passes, ap_mm, c.at.f_mm_rev, v};
  return o;
}

class Reconstructing {
 public:
  Reconstructing(const planning::PreparedPart& part, const Review& review)
      : part_(part), review_(review) {}

  Reconstruction result() {
    for (std::size_t s = 0; s < part_.setups.size(); ++s) {
      const auto setup = std::ranges::find(review_.setups, s, &ReviewedSetup::setup);
      if (setup == review_.setups.end()) {
        refuse(say("{} has no program", planning::setup_label(s)));
        continue;
      }
      add(*setup);
    }
    return std::move(out_);
  }

 private:
  void refuse(std::string why) { out_.cannot.push_back(std::move(why)); }

  void add(const ReviewedSetup& setup) {
    const auto& work = part_.work.setups[setup.setup];
    if (work.end_face)
      add_face(setup,
               part_.setups[setup.setup].hold == part::End::left ? "right" : "left");
    for (const std::size_t i : work.elements)
      add_element(setup, part_.drawing.outer[i], false);
    for (const std::size_t i : work.bores)
      if (!part::is_hole(part_.drawing.inner[i]))
        add_element(setup, part_.drawing.inner[i], true);
    for (const std::size_t k : work.shoulders)
      add_face(setup, planning::shoulder_id(part_.drawing, k));
    for (const std::size_t i : work.inner_shoulders)
      add_face(setup, part::shoulder_behind(part_.drawing, i)->id);
    add_fixed(setup);
  }

  // The cuts over a surface.  What other passes take off it belongs to them, unless it is
  // most of a surface or nothing else cuts it.
  std::vector<const Cut*> cuts_on(const ReviewedSetup& setup, const std::string& on) {
    const auto extent = part::extent(part_.drawing, on);
    const double most = extent ? (extent->z1_mm - extent->z0_mm) / 2 : 0;
    std::vector<const Cut*> own, beside;
    for (const auto& c : setup.cuts) {
      if (c.on != on || c.kind == OperationKind::fixed) continue;
      const bool all = std::ranges::all_of(
          c.passes, [&](const PassCut& p) { return p.beside && !(p.length_mm > most); });
      (all ? beside : own).push_back(&c);
    }
    return own.empty() ? beside : own;
  }

  void add_face(const ReviewedSetup& setup, const std::string& face) {
    const Cut* faced = nullptr;
    for (const auto* c : cuts_on(setup, face)) faced = c;
    if (!faced) return refuse(say("no program faces {}", face));
    const int passes = count(*faced);
    out_.operations.push_back(
        operation(setup.setup, OperationKind::face, face, *faced, passes, std::nullopt));
  }

  // Radius that the last pass leaves: of a cylinder the one that prevails, clear of
  // undercuts; of a cone where its end is.
  static double reached_mm(const std::vector<PassCut>& passes, bool inner, bool cone) {
    const auto& p = passes.back();
    if (!cone) return p.x_mm;
    return inner ? p.x_to_mm : p.x_from_mm;
  }
  // And that of the material before the first pass: outside the stock's.
  double begun_mm(const Cut& first, const part::InnerElement&) const {
    const auto& p = first.passes.front();
    return p.x_mm - p.ap_mm;
  }
  double begun_mm(const Cut&, const part::OuterElement& e) const {
    const auto& d = part_.drawing;
    const auto i = static_cast<std::size_t>(&e - d.outer.data());
    return part::stock_of(d, i).most_mm / 2;
  }

  // Passes of a cut over its own surface; all where it is cut beside others alone.
  static std::vector<PassCut> own_passes(const Cut& c) {
    std::vector<PassCut> own;
    std::ranges::copy_if(c.passes, std::back_inserter(own),
                         [](const PassCut& p) { return !p.beside; });
    return own.empty() ? c.passes : own;
  }
  static int count(const Cut& c) { return static_cast<int>(own_passes(c).size()); }

  // How many passes of the depth between the first and the last reach from the stock to the
  // last: before lower stock of a casting or forging some cut nothing.
  int passes_from_stock(int passes, const Cut& first, const Cut& last, double depth_mm,
                        bool cone) const {
    const auto a = own_passes(first), b = own_passes(last);
    const double way = std::abs(reached_mm({a.front()}, inner(first), cone) -
                                reached_mm(b, inner(first), cone));
    if (part_.drawing.stock.outline.empty() || passes < 2 || !(way > kSame_mm))
      return passes;
    return std::max(passes, static_cast<int>(std::lround(depth_mm * (passes - 1) / way)));
  }
  bool inner(const Cut& c) const {
    return c.kind == OperationKind::bore_rough || c.kind == OperationKind::bore_finish;
  }

  // Roughing leaves the finishing tool its least depth where the blocks' last decimal takes
  // less than a hundredth of this.
  template <class Element>
  double roughed_mm(double reached, const Cut& last, const Element& e,
                    bool in_bore) const {
    const auto t = std::ranges::find(part_.tools, last.tool_id, &catalogue::Tool::id);
    if (t == part_.tools.end() || e.left_mm != e.right_mm || count(last) != 1)
      return reached;
    const double least = catalogue::least_depth_mm(*t);
    const double made = e.left_mm / 2 + planning::to_middle_mm(part_.drawing, e.id);
    const double left = (in_bore ? -1 : 1) * (reached - made);
    if (!(left < least && left > (1 - kKept) * least)) return reached;
    return made + (in_bore ? -1 : 1) * least;
  }

  template <class Element>
  void add_element(const ReviewedSetup& setup, const Element& e, bool inner) {
    const auto cuts = cuts_on(setup, e.id);
    if (cuts.empty() && part::is_groove(e)) return add_blank(setup, e);
    if (cuts.empty()) return refuse(say("no program turns {}", e.id));
    const auto& last = *cuts.back();
    for (std::size_t k = 1; k + 1 < cuts.size(); ++k)
      if (!alike(*cuts[0], *cuts[k]))
        return refuse(say("{} is roughed with more than one tool, speed or feed", e.id));
    if (cuts.size() > 1) {
      int passes = 0;
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) passes += count(*cuts[k]);
      const auto& before = *cuts[cuts.size() - 2];
      const bool cone = e.left_mm != e.right_mm;
      const double reached =
          roughed_mm(reached_mm(own_passes(before), inner, cone), last, e, inner);
      const double depth = std::abs(begun_mm(*cuts[0], e) - reached);
      passes = passes_from_stock(passes, *cuts[0], before, depth, cone);
      out_.operations.push_back(
          operation(setup.setup, inner ? OperationKind::bore_rough : OperationKind::rough,
                    e.id, *cuts[0], passes, depth / passes));
    }
    out_.operations.push_back(
        operation(setup.setup, inner ? OperationKind::bore_finish : OperationKind::finish,
                  e.id, last, count(last), std::nullopt));
  }

  // A groove's blank is turned with an element beside it.
  template <class Element>
  void add_blank(const ReviewedSetup& setup, const Element& groove) {
    const auto blank = [&](const OperationRequest& o) {
      if (o.setup != setup.setup) return false;
      const auto e = part::extent(part_.drawing, o.on[0]);
      return e && e->left_mm == groove.left_mm && o.kind != OperationKind::fixed;
    };
    std::vector<OperationRequest> copies;
    std::ranges::copy_if(out_.operations, std::back_inserter(copies), blank);
    if (copies.empty()) refuse(say("no program turns {}", groove.id));
    for (auto& o : copies) {
      o.on = {groove.id};
      o.id += fmt::format("-{}", groove.id);
      out_.operations.push_back(std::move(o));
    }
  }

  // Drills, blades and threads run at their tools' conditions.
  void add_fixed(const ReviewedSetup& setup) {
    for (const auto& c : setup.cuts) {
      if (c.kind != OperationKind::fixed) continue;
      const auto same = [&](const OperationRequest& o) {
        return o.kind == OperationKind::fixed && o.on[0] == c.on &&
               o.setup == setup.setup;
      };
      if (std::ranges::any_of(out_.operations, same)) continue;
      OperationRequest o;
      o.id = fmt::format("s{}-fixed-{}", setup.setup + 1, c.on);
      o.setup = setup.setup;
      o.kind = OperationKind::fixed;
      o.on = {c.on};
      o.tool = c.tool_id;
      o.conditions.f_mm_rev = c.at.f_mm_rev;
      o.conditions.vc_m_min = c.loads.vc_m_min * of_largest(c);
      if (c.size_mm > 0 && !in_element(c.on)) o.conditions.ap_mm = size_as_depth(c);
      out_.operations.push_back(std::move(o));
    }
  }

  // A chamfer of its own has its speed at the largest drawn diameter; the pass that cuts it
  // may begin or end in what is left before the face.
  double of_largest(const Cut& c) const {
    const auto& d = part_.drawing;
    const auto e = std::ranges::find(d.inner, c.on, &part::InnerElement::id);
    const auto t =
        std::ranges::find(part_.fixed_tools, c.tool_id, &catalogue::FixedTool::id);
    if (e == d.inner.end() || t == part_.fixed_tools.end() ||
        t->use != catalogue::FixedUse::profiling)
      return 1;
    double largest = 0;
    for (const auto& [D, chamfer] : {std::pair{e->left_mm, e->left_chamfer},
                                     std::pair{e->right_mm, e->right_chamfer}})
      if (chamfer) largest = std::max(largest, D + 2 * chamfer->radial_mm);
    const double cut = 2 * c.passes.back().x_to_mm;
    return largest > 0 ? std::min(1.0, largest / cut) : 1;
  }

  bool in_element(const std::string& on) const {
    return part::extent(part_.drawing, on).has_value();
  }
  // Half a drill's diameter, the width of a blade that parts off.
  double size_as_depth(const Cut& c) const {
    const auto t =
        std::ranges::find(part_.fixed_tools, c.tool_id, &catalogue::FixedTool::id);
    const bool parts =
        t != part_.fixed_tools.end() && t->use == catalogue::FixedUse::parting;
    return parts ? c.size_mm : c.size_mm / 2;
  }

  const planning::PreparedPart& part_;
  const Review& review_;
  Reconstruction out_;
};

}  // namespace

Reconstruction reconstructed(const planning::PreparedPart& part, const Review& review) {
  return Reconstructing(part, review).result();
}

planning::PlanRequest with_operations(const planning::PreparedPart& part,
                                      std::vector<planning::OperationRequest> operations,
                                      const std::vector<MountedTool>& tools) {
  planning::PlanRequest q = part;
  q.operations = std::move(operations);
  for (auto& setup : q.setups) setup.clampings.resize(1);
  const auto add = [](auto& all, const auto& tool) {
    if (std::ranges::none_of(all, [&](const auto& t) { return t.id == tool.id; }))
      all.push_back(tool);
  };
  for (const auto& t : tools) {
    if (t.turning) add(q.tools, *t.turning);
    if (t.fixed) add(q.fixed_tools, *t.fixed);
  }
  return q;
}

}  // namespace turnwright::review
