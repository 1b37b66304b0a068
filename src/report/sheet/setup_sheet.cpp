#include "setup_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "report/picture/program_steps.hpp"
#include "report/picture/svg.hpp"
#include "report/text/amounts.hpp"
#include "report/text/result_words.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using part::End;
using planning::Clamping;
using planning::PreparedPart;
using planning::SetupPlan;

std::string word(End end) { return end == End::left ? tr("left end") : tr("right end"); }

void add(Entries& all, const std::string& name, const std::string& value) {
  if (!value.empty()) all.emplace_back(name, value);
}

Entries title(const PreparedPart& p) {
  const auto& d = p.drawing;
  const auto& m = p.material;
  Entries all;
  add(all, tr("Part"), d.name);
  add(all, tr("Drawing"), d.title.drawing_number);
  add(all, tr("Revision"), d.title.revision);
  add(all, tr("Customer"), d.title.customer);
  add(all, tr("Material"),
      fmt::format("{}, {}, {:.0f} HB", m.name, m.condition, m.hardness_HB));
  add(all, tr("Machine"), p.machine.name);
  return all;
}

/// Material [mm] in front of the finished face of the free end before a setup.
double front_mm(const PreparedPart& p, std::size_t setup) {
  const End free = part::opposite(p.setups[setup].hold);
  return setup == 0 ? planning::face_stock_mm(p, free)
                    : planning::face_stock_after_mm(p, setup - 1, free);
}

std::string stock(const PreparedPart& p, std::size_t setup) {
  const auto& s = p.drawing.stock;
  if (setup > 0)
    return p.setups[setup].hold == p.setups[setup - 1].hold
               ? say("the part from setup {}", setup)
               : say("the part from setup {}, turned round", setup);
  auto text = (s.kind == part::StockKind::tube      ? tr("tube \u00d8")
               : s.kind == part::StockKind::hexagon ? tr("hexagon bar ")
               : s.kind == part::StockKind::square  ? tr("square bar ")
               : s.kind == part::StockKind::casting ? tr("casting \u00d8")
               : s.kind == part::StockKind::forging ? tr("forging \u00d8")
                                                    : tr("bar \u00d8")) +
              plain(part::across_mm(s));
  if (s.inner_mm > 0) text += "/\u00d8" + plain(s.inner_mm);
  return text + " \u00d7 " + plain(s.length_mm) + " mm";
}

std::string stick_out(const PreparedPart& p, std::size_t setup, Clamping clamping) {
  if (clamping == Clamping::between_centres) return "";
  const double length =
      std::abs(planning::free_z_mm(p, setup) - planning::root_z_mm(p, setup, clamping));
  const double front = front_mm(p, setup);
  auto text = say("{:.1f} mm from the jaws to Z0", length);
  if (front > 0) text += say(", {:.1f} mm with what is faced off", length + front);
  return text;
}

std::string kN(double N) { return fmt::format("{:.1f} kN", N / 1000); }

std::string jaws(const PreparedPart& p, const SetupPlan& s, std::size_t setup) {
  if (!(s.grip_force_N > 0)) return "";
  auto text = say("{}, hold the {} at \u00d8{} over {} mm, {}",
                  spoken(name(p.setups[setup].jaws)), word(s.hold),
                  plain(planning::grip_diameter_mm(p, setup, s.clamping), 2),
                  plain(p.grips_mm[setup], 1), kN(s.grip_force_N));
  if (s.finishing_grip_force_N < s.grip_force_N)
    text += say("; eased to {} to finish, so that the part stays round",
                kN(s.finishing_grip_force_N));
  return text;
}

std::string tailstock(const PreparedPart& p) {
  const double thrust_N = p.machine.tail_thrust_N;
  return thrust_N > 0 ? say("tailstock centre, {}", kN(thrust_N))
                      : tr("tailstock centre");
}

std::string support(const PreparedPart& p, const SetupPlan& s, std::size_t setup) {
  const auto sign = s.hold == End::left ? 1 : -1;
  switch (s.clamping) {
    case Clamping::chuck:
      return "";
    case Clamping::chuck_tailstock:
      return tailstock(p);
    case Clamping::between_centres:
      return say("between centres, {} at the headstock, {}", word(s.hold), tailstock(p));
    case Clamping::chuck_steady:
      return say("steady rest at Z{:.1f}",
                 sign * (p.setups[setup].steady_z_mm - planning::free_z_mm(p, setup)));
    case Clamping::tailstock_follow:
      break;
  }
  return say("{}, follow rest at the tool", tailstock(p));
}

Entries clamping(const PreparedPart& p, const SetupPlan& s, std::size_t setup) {
  Entries all;
  add(all, tr("Stock"), stock(p, setup));
  add(all, tr("Stick-out"), stick_out(p, setup, s.clamping));
  add(all, tr("Jaws"), jaws(p, s, setup));
  add(all, tr("Support"), support(p, s, setup));
  return all;
}

std::string zero(const ShopPrograms& shop) {
  return (shop.work_offset.empty() ? "" : shop.work_offset + ": ") +
         tr("X on the spindle's axis, Z in the finished face of the free end");
}

Entries times(const PreparedPart& p, const planning::ProcessPlan& plan,
              const SetupPlan& s, const toolpath::Minutes& m) {
  Entries all;
  add(all, tr("Program"),
      say("{}, of it {} in the cut", duration(m.total()), duration(m.cutting)));
  add(all, tr("Loading"), duration(s.breakdown.loading.time_min));
  if (p.batch)
    add(all, tr("Batch"),
        say("{:.0f} parts, {} to prepare the machine", *p.batch,
            duration(p.machine.setup_min)));
  add(all, tr("Part"), say("{} in all setups", duration(plan.time_per_part_min)));
  return all;
}

/// How comments of stops begin, a longer beginning before the shorter; the programs have them
/// in English.
constexpr const char* kAsked[] = {
    to_translate("bring up the tailstock, set the follow rest"),
    to_translate("bring up the tailstock"),
    to_translate("from the chuck to between centres"),
    to_translate("set the steady rest at "),
    to_translate("jaws to "),
    to_translate("not in this program: ")};

std::string spoken_comment(std::string_view comment) {
  constexpr std::string_view kStop = "stop: ";
  if (comment.starts_with(kStop)) comment.remove_prefix(kStop.size());
  for (const std::string_view begin : kAsked)
    if (comment.starts_with(begin)) return tr(begin).append(comment.substr(begin.size()));
  return std::string(comment);
}

/// What a stop of the program asks for, without the word "stop".
std::string asked(const toolpath::Step& stop) {
  std::string text;
  for (const auto& c : stop.comments) text += text.empty() ? spoken_comment(c) : "; " + c;
  return text;
}

std::vector<StopRow> stops(const SetupPlan& s, const toolpath::SetupProgram& program) {
  std::vector<StopRow> all;
  for (const auto& [step, operation] : planned_steps(s, program))
    if (step->stop) all.push_back({operation->id, asked(*step), step->stop_min});
  return all;
}

}  // namespace

std::vector<SetupSheet> setup_sheets(const PreparedPart& part,
                                     const planning::ProcessPlan& plan,
                                     const nc::Programs& programs,
                                     const ShopPrograms& shop) {
  if (shop.files.size() != programs.setups.size())
    throw std::domain_error("setup_sheets: every program has a file");
  std::vector<SetupSheet> all;
  for (const auto& program : programs.setups) {
    const std::size_t i = program.setup;
    const auto& s = plan.setups.at(i);
    SetupSheet sheet;
    sheet.setup = i + 1;
    sheet.setups = plan.setups.size();
    sheet.program = shop.files[all.size()];
    sheet.title = title(part);
    sheet.clamping = clamping(part, s, i);
    sheet.clamping.emplace_back(tr("Zero"), zero(shop));
    sheet.times = times(part, plan, s, program.minutes);
    sheet.tools = tool_rows(part, s, program);
    sheet.stops = stops(s, program);
    sheet.checks = inspection(part, plan, i, sheet.tools);
    all.push_back(std::move(sheet));
  }
  return all;
}

}  // namespace turnwright::report
