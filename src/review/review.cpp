#include "turnwright/review/review.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "loads.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "review/cut/engagement.hpp"
#include "review/cut/workpiece.hpp"
#include "review/program/nose_path.hpp"

namespace turnwright::review {
namespace {

constexpr double kEnds = 0.15;  // of an element, at each end: corners and chamfers

// The last cut of an element finishes it.
void tell_finishing(Review& review) {
  using planning::OperationKind;
  std::map<std::string, Cut*> last;
  for (auto& setup : review.setups)
    for (auto& c : setup.cuts)
      if ((c.kind == OperationKind::rough || c.kind == OperationKind::bore_rough) &&
          !std::ranges::all_of(c.passes, &PassCut::beside))
        last[c.on] = &c;
  for (auto& [on, c] : last)
    c->kind = c->kind == OperationKind::rough ? OperationKind::finish
                                              : OperationKind::bore_finish;
}

// Edges worn by the setup's cuts.
void add_edges(ReviewedSetup& setup, const std::vector<MountedTool>& tools) {
  for (const auto& c : setup.cuts) {
    const auto& t = *std::ranges::find(tools, c.tool, &MountedTool::number);
    setup.edge_cost += c.edges * (t.turning ? t.turning->edge_cost : t.fixed->edge_cost);
    setup.edge_min += c.edges * (t.turning ? t.turning->change_min : t.fixed->change_min);
  }
}

// The nose of a tool by its number.
std::optional<Nose> nose_of(const std::vector<MountedTool>& tools, int number) {
  const auto t = std::ranges::find(tools, number, &MountedTool::number);
  if (t == tools.end()) return std::nullopt;
  if (t->turning) return Nose{t->turning->re_mm, t->turning->bar.has_value()};
  if (catalogue::on_axis(t->fixed->use)) return std::nullopt;
  return Nose{t->fixed->re_mm, t->fixed->inner};
}

// The difference between the surface on an element's columns and its drawn line that
// prevails, on the radius.
std::optional<double> off_mm(const Workpiece& w, double z, double length, double left_mm,
                             double right_mm, bool inner) {
  std::vector<double> all;
  for (std::size_t i = 0; i < w.section.columns.size(); ++i) {
    const double u = (w.section.columns.at(i) - z) / length;
    if (u < kEnds || u > 1 - kEnds) continue;
    if (const auto surface = w.surface_mm(i, inner))
      all.push_back(*surface - std::lerp(left_mm, right_mm, u) / 2);
  }
  if (all.empty()) return std::nullopt;
  const auto middle = all.begin() + std::ssize(all) / 2;
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

std::vector<MadeSize> sizes(const planning::PreparedPart& part, const Review& review,
                            const Workpiece& w) {
  std::map<std::string, std::size_t> cut_in;
  for (const auto& setup : review.setups)
    for (const auto& c : setup.cuts) cut_in[c.on] = setup.setup;
  std::vector<MadeSize> all;
  const auto add = [&](const auto& e, double z, bool inner) {
    const auto setup = cut_in.find(e.id);
    if (setup == cut_in.end() || e.cut) return;
    const auto off = off_mm(w, z, e.length_mm, e.left_mm, e.right_mm, inner);
    if (!off) return;
    const double nominal = (e.left_mm + e.right_mm) / 2;
    all.push_back({e.id, setup->second, nominal + 2 * *off, nominal, e.limits});
  };
  const auto& d = part.drawing;
  for (std::size_t i = 0; i < d.outer.size(); ++i)
    add(d.outer[i], part::left_z_mm(d, i), false);
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    add(d.inner[i], part::inner_left_z_mm(d, i), true);
  return all;
}

}  // namespace

Review review(const planning::PreparedPart& part,
              const std::vector<ReviewedProgram>& programs,
              const std::vector<MountedTool>& tools) {
  Review all;
  Workpiece workpiece(part);
  std::size_t next = 0;
  for (const auto& p : programs) {
    if (p.setup < next || p.setup >= part.setups.size())
      throw std::domain_error("review: the programs must be in the order of the setups");
    for (; next < p.setup; ++next) workpiece.make_as_drawn(next);
    ++next;
    const auto nose = [&](int number) { return nose_of(tools, number); };
    auto setup = follow(part, {p.setup, with_nose_paths(p.program, nose), p.zero_mm},
                        tools, workpiece);
    std::set<std::string> cut_before;
    for (auto& c : setup.cuts)
      add_loads(part, p.setup, *std::ranges::find(tools, c.tool, &MountedTool::number),
                cut_before.insert(c.on).second ? CutOrder::first : CutOrder::later, c);
    add_edges(setup, tools);
    all.setups.push_back(std::move(setup));
  }
  tell_finishing(all);
  all.sizes = sizes(part, all, workpiece);
  return all;
}

}  // namespace turnwright::review
