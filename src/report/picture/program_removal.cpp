#include "program_removal.hpp"

#include <algorithm>
#include <stdexcept>

#include "contour.hpp"
#include "planning/clamping/positions.hpp"
#include "program_steps.hpp"
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

std::vector<CutPass> passes(const PreparedPart& part, const planning::SetupPlan& setup,
                            const toolpath::SetupProgram& program) {
  std::vector<CutPass> all;
  Work work = work_before(part, program.setup);
  toolpath::Point at{program.change_x_mm, program.change_z_mm};
  for (const auto& [step, operation] : planned_steps(setup, program)) {
    if (step->stop || step->milling) continue;
    const auto tool = cutter(part, *operation, listed(program, step->tool));
    bool cutting = false;
    for (const auto& move : step->moves) {
      const bool feeds = move.kind != toolpath::Move::Kind::rapid;
      if (feeds && !cutting)
        all.push_back({step->tool, operation->id, {at}, work.rings, {}});
      if (feeds) {
        take_off(work, tool, at, move);
        const auto points = way(at, move);
        all.back().way.insert(all.back().way.end(), points.begin(), points.end());
        all.back().after = work.rings;
      }
      cutting = feeds;
      at = {move.x_mm, move.z_mm};
    }
  }
  return all;
}

}  // namespace turnwright::report
