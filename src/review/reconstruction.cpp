#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planning/clamping/made_surfaces.hpp"
#include "turnwright/review/review.hpp"

namespace turnwright::review {
namespace {

using planning::OperationKind;
using planning::OperationRequest;

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
        refuse(fmt::format("{} has no program", planning::setup_label(s)));
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
    if (!faced) return refuse(fmt::format("no program faces {}", face));
    const auto passes = static_cast<int>(faced->passes.size());
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

  template <class Element>
  void add_element(const ReviewedSetup& setup, const Element& e, bool inner) {
    const auto cuts = cuts_on(setup, e.id);
    if (cuts.empty() && part::is_groove(e)) return add_blank(setup, e);
    if (cuts.empty()) return refuse(fmt::format("no program turns {}", e.id));
    const auto& last = *cuts.back();
    for (std::size_t k = 1; k + 1 < cuts.size(); ++k)
      if (!alike(*cuts[0], *cuts[k]))
        return refuse(
            fmt::format("{} is roughed with more than one tool, speed or feed", e.id));
    if (cuts.size() > 1) {
      int passes = 0;
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        passes += static_cast<int>(cuts[k]->passes.size());
      const double depth =
          std::abs(begun_mm(*cuts[0], e) - reached_mm(cuts[cuts.size() - 2]->passes,
                                                      inner, e.left_mm != e.right_mm));
      out_.operations.push_back(
          operation(setup.setup, inner ? OperationKind::bore_rough : OperationKind::rough,
                    e.id, *cuts[0], passes, depth / passes));
    }
    out_.operations.push_back(
        operation(setup.setup, inner ? OperationKind::bore_finish : OperationKind::finish,
                  e.id, last, static_cast<int>(last.passes.size()), std::nullopt));
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
    if (copies.empty()) refuse(fmt::format("no program turns {}", groove.id));
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
