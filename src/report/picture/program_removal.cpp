#include "program_removal.hpp"

#include <algorithm>
#include <stdexcept>

#include "contour.hpp"
#include "planning/clamping/positions.hpp"
#include "program_steps.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using catalogue::FixedUse;
using part::End;
using planning::OperationKind;
using planning::OperationPlan;
using planning::PreparedPart;

constexpr std::size_t kColumns = 1200;  // finer than the lines of a picture
constexpr int kInBore = 2;              // orientation of a tip in a bore

const catalogue::FixedTool& fixed_tool(const PreparedPart& part, const OperationPlan& o) {
  const auto found =
      std::ranges::find(part.fixed_tools, o.tool, &catalogue::FixedTool::id);
  if (found == part.fixed_tools.end())
    throw std::domain_error("program_removal: no fixed tool " + o.tool);
  return *found;
}

Cutter fixed_cutter(const PreparedPart& part, const OperationPlan& o, bool bore) {
  using Shape = Cutter::Shape;
  const auto& tool = fixed_tool(part, o);
  const double size = o.passes[0].ap_mm;
  switch (tool.use) {
    case FixedUse::centring:
      return {Shape::drill, size,
              std::atan2(size, catalogue::tip_depth_mm(tool, 2 * size))};
    case FixedUse::drilling:
      return {Shape::drill, size, units::rad_from_deg(tool.point_deg) / 2};
    case FixedUse::countersinking:
      return {Shape::drill, tool.sizes_mm.back() / 2,
              units::rad_from_deg(tool.point_deg) / 2};
    case FixedUse::counterboring:
    case FixedUse::reaming: {
      const double radius = part::extent(part.drawing, o.on[0])->left_mm / 2;
      return {Shape::drill, radius, std::atan2(radius, tool.lead)};
    }
    case FixedUse::grooving:
    case FixedUse::parting:
      return {bore ? Shape::bore_blade : Shape::blade, size};
    case FixedUse::profiling:
      return {bore ? Shape::bore : Shape::corner, tool.re_mm};
    case FixedUse::threading:
    case FixedUse::tapping:
    case FixedUse::knurling:
      break;
  }
  return {};
}

Cutter cutter(const PreparedPart& part, const OperationPlan& o,
              const toolpath::TableTool& t) {
  using Shape = Cutter::Shape;
  const bool bore = t.orientation == kInBore;
  if (o.kind == OperationKind::fixed) return fixed_cutter(part, o, bore);
  const bool end_face =
      o.kind == OperationKind::face && (o.on[0] == "left" || o.on[0] == "right");
  return {end_face ? Shape::face : bore ? Shape::bore : Shape::corner, t.re_mm};
}

const toolpath::TableTool& listed(const toolpath::SetupProgram& program, int number) {
  const auto found =
      std::ranges::find(program.tools, number, &toolpath::TableTool::number);
  if (found == program.tools.end())
    throw std::domain_error("program_removal: a tool that the program does not list");
  return *found;
}

/// The radius of runs at a position; 0 beyond them.
double radius_at(const Runs& runs, double z) {
  for (const auto& run : runs)
    if (z >= run.z0 && z <= run.z1) return radius_mm(run, z);
  return 0;
}

/// Keeps of the rings before and after a pass those between the first and the last that
/// it changes: passes may be many thousands.
void keep_changes(const std::vector<Ring>& before, const std::vector<Ring>& after,
                  CutPass& pass) {
  std::size_t from = 0, to = before.size();
  while (from < to && before[from] == after[from]) ++from;
  while (to > from && before[to - 1] == after[to - 1]) --to;
  const auto changed = [&](const std::vector<Ring>& rings) {
    return std::vector<Ring>(rings.begin() + static_cast<std::ptrdiff_t>(from),
                             rings.begin() + static_cast<std::ptrdiff_t>(to));
  };
  pass.from = from;
  pass.before = changed(before);
  pass.after = changed(after);
}

Contour contour_before(const PreparedPart& part, std::size_t setup) {
  if (setup > 0) return contour_after(part, setup - 1);
  const auto& s = part.drawing.stock;
  const double z0 = -s.left_allowance_mm, z1 = z0 + s.length_mm;
  return {stock_runs(s), {{z0, z1, s.inner_mm / 2, s.inner_mm / 2}}};
}

}  // namespace

Work work_before(const PreparedPart& part, std::size_t setup) {
  const auto contour = contour_before(part, setup);
  const double sign = part.setups[setup].hold == End::left ? 1 : -1;
  const double free_z = planning::free_z_mm(part, setup);
  const auto [low, high] = std::minmax({sign * (contour.outer.front().z0 - free_z),
                                        sign * (contour.outer.back().z1 - free_z)});
  Work work{low, (high - low) / static_cast<double>(kColumns - 1), {}};
  for (std::size_t i = 0; i < kColumns; ++i) {
    const double z = std::clamp(free_z + sign * work.z(i), contour.outer.front().z0,
                                contour.outer.back().z1);
    work.rings.push_back({radius_at(contour.inner, z), radius_at(contour.outer, z)});
  }
  return work;
}

Removal removal(const PreparedPart& part, const planning::SetupPlan& setup,
                const toolpath::SetupProgram& program) {
  Removal all{{}, work_before(part, program.setup)};
  auto& rings = all.left.rings;
  toolpath::Point at{program.change_x_mm, program.change_z_mm};
  for (const auto& [step, operation] : planned_steps(setup, program)) {
    if (step->stop || step->milling) continue;
    const auto tool = cutter(part, *operation, listed(program, step->tool));
    std::vector<Ring> before;  // of a pass that has not ended
    const auto end_pass = [&] {
      if (!before.empty()) keep_changes(before, rings, all.passes.back());
      before.clear();
    };
    for (const auto& move : step->moves) {
      leave_if_asked();
      if (move.kind == toolpath::Move::Kind::rapid) {
        end_pass();
      } else {
        if (before.empty()) {
          before = rings;
          all.passes.push_back({step->tool, operation->id, {at}, 0, {}, {}});
        }
        take_off(all.left, tool, at, move);
        const auto points = way(at, move);
        auto& whole = all.passes.back().way;
        whole.insert(whole.end(), points.begin(), points.end());
      }
      at = {move.x_mm, move.z_mm};
    }
    end_pass();
  }
  return all;
}

}  // namespace turnwright::report
