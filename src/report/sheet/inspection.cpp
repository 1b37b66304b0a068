#include "inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/say.hpp"
#include "gauge.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/setup/edge_schedule.hpp"
#include "report/picture/svg.hpp"
#include "report/picture/thread_label.hpp"
#include "report/text/plan_words.hpp"
#include "report/text/result_words.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using part::ToleranceRule;
using planning::PreparedPart;
using planning::ToleranceResult;

constexpr int kMicrometre = 3;  // decimals of mm

/// The setup after which a tolerance can be measured; none if no setup makes any of its
/// surfaces.
std::optional<std::size_t> measured_after(const PreparedPart& p,
                                          const part::Tolerance& t) {
  std::optional<std::size_t> last;
  for (const auto& surface : {t.of, t.datum, t.common_datum, t.between[0], t.between[1]})
    if (!surface.empty()) last = std::max(last, planning::setup_of(p, surface));
  return last;
}

/// The surface on which a tolerance is made last.
std::string made_on(const PreparedPart& p, const part::Tolerance& t, std::size_t setup) {
  for (const auto& surface : {t.of, t.between[0], t.between[1]})
    if (!surface.empty() && planning::setup_of(p, surface) == setup) return surface;
  return t.of.empty() ? t.between[0] : t.of;
}

/// What `get` takes of the element of an id; nothing of none.
template <class Get>
std::optional<std::string> of_element(const part::Drawing& d, const std::string& id,
                                      const Get& get) {
  for (const auto& e : d.outer)
    if (e.id == id) return get(e);
  for (const auto& e : d.inner)
    if (e.id == id) return get(e);
  return std::nullopt;
}

/// The nominal size that the limits of a `diameter` or `length` are about.
double nominal_mm(const part::Drawing& d, const part::Tolerance& t) {
  if (t.kind != part::ToleranceKind::length) {
    const auto at = part::extent(d, t.of);
    return at ? std::max(at->left_mm, at->right_mm) : 0;
  }
  return std::abs(planning::face_z_mm(d, t.between[0]) -
                  planning::face_z_mm(d, t.between[1]));
}

Measured measured(const part::Drawing& d, const part::Tolerance& t) {
  if (t.kind == part::ToleranceKind::length) return Measured::length;
  const auto rule = part::facts(t.kind).rule;
  if (rule == ToleranceRule::runout) return Measured::runout;
  if (rule != ToleranceRule::size) return Measured::form;
  const auto at = part::extent(d, t.of);
  return at && at->inner ? Measured::inside : Measured::outside;
}

std::string micrometres(const std::vector<double>& mm, bool signed_) {
  std::string text;
  for (const double x : mm) {
    const double um = units::um_from_mm(x);
    text += text.empty() ? "" : " .. ";
    text += signed_ ? fmt::format("{:+.1f}", um) : fmt::format("{:.1f}", um);
  }
  return text + " \u00b5m";
}

/// The tool that finishes a surface in this setup.
const ToolRow* finishing_tool(const std::vector<ToolRow>& tools,
                              const planning::SetupPlan& setup,
                              const std::string& surface) {
  const ToolRow* last = nullptr;
  for (const auto& o : setup.operations) {
    if (std::ranges::find(o.on, surface) == o.on.end()) continue;
    for (const auto& row : tools)
      if (std::ranges::find(row.operations, o.id) != row.operations.end()) last = &row;
  }
  return last;
}

/// "first, then 1 in 12"; without a number where the batch is over before.
std::string every(const PreparedPart& p, long parts, bool new_edge) {
  if (p.batch && static_cast<double>(parts) >= *p.batch) return tr("first part");
  if (parts <= 1) return tr("every part");
  return new_edge ? say("first of each edge ({} parts)", parts)
                  : say("first, then 1 in {}", parts);
}

std::string when(const PreparedPart& p, const ToolRow* tool, bool size) {
  if (!tool || !tool->edge) return tr("first part");
  const auto& edge = *tool->edge;
  const auto corrected =
      planning::parts_until(p.shop.life_between_offsets, edge.edges_per_part);
  return size && corrected ? every(p, std::max(1L, *corrected), false)
                           : every(p, edge.parts_per_edge, true);
}

Check check(const PreparedPart& p, const planning::SetupPlan& setup,
            const part::Tolerance& t, const ToleranceResult& result,
            const std::string& surface, const std::vector<ToolRow>& tools) {
  const auto& d = p.drawing;
  const bool size = part::facts(t.kind).rule == ToleranceRule::size && t.limits;
  Check c;
  c.of = t.of.empty() ? t.between[0] + say(" to {}", t.between[1]) : t.of;
  if (size) {
    const double nominal = nominal_mm(d, t);
    const auto fit = of_element(d, t.of, [](const auto& e) { return e.fit; });
    const auto ground = of_element(d, t.of, [](const auto& e) { return e.ground_to; });
    c.what = (t.kind == part::ToleranceKind::length ? say("length {}", plain(nominal))
                                                    : "\u00d8" + plain(nominal)) +
             (fit ? ' ' + *fit : "");
    if (ground) c.what += say(", for grinding to \u00d8{}", *ground);
    c.limits = fmt::format("{:.{}f} .. {:.{}f}", nominal + t.limits->lower_mm,
                           kMicrometre, nominal + t.limits->upper_mm, kMicrometre);
  } else {
    const auto kind = kind_words(part::name(t.kind));
    c.what = t.datum.empty() ? kind : kind + say(" to {}", part::datum_words(t));
    c.limits = fmt::format("{:.{}f}", t.value_mm, kMicrometre);
  }
  c.predicted = micrometres(result.predicted_mm, size);
  c.gauge = gauge(measured(d, t), t.value_mm);
  const bool too_few = result.P_conform < p.conformance - 1e-6;
  c.when =
      too_few ? tr("every part") : when(p, finishing_tool(tools, setup, surface), size);
  return c;
}

/// The roughness that the last operation on a surface is to leave, from its constraints.
std::optional<double> predicted_um(const planning::SetupPlan& setup,
                                   const std::string& surface, const char* name) {
  std::optional<double> last;
  for (const auto& o : setup.operations)
    if (std::ranges::find(o.on, surface) != o.on.end())
      for (const auto& c : o.constraints)
        if (c.name == name) last = c.value;
  return last;
}

constexpr double kRaOfRz = 0.25;  // of a profile of triangles Ra is a quarter of Rz

void add_roughness(std::vector<Check>& all, const PreparedPart& p,
                   const planning::SetupPlan& setup, std::size_t index,
                   const std::vector<ToolRow>& tools) {
  const auto add = [&](const std::string& id, const char* what,
                       const std::optional<double>& limit_um, double as_Ra) {
    if (!limit_um || planning::setup_of(p, id) != index) return;
    const auto made_with = planning::cut_with(p.drawing, id);
    const auto predicted = predicted_um(setup, made_with, what);
    const Check one{
        spoken(what),
        id,
        plain(*limit_um) + " \u00b5m",
        predicted ? fmt::format("{:.2f} \u00b5m", *predicted) : tr("not predicted"),
        roughness_gauge(*limit_um * as_Ra),
        when(p, finishing_tool(tools, setup, made_with), false)};
    const auto like = std::ranges::find_if(all, [&](const Check& c) {
      return c.what == one.what && c.limits == one.limits &&
             c.predicted == one.predicted && c.when == one.when;
    });
    if (like == all.end())
      all.push_back(one);
    else
      like->of += ", " + one.of;
  };
  const auto of = [&](const auto& surface) {
    add(surface.id, "roughness Ra", surface.Ra_um, 1);
    add(surface.id, "roughness Rz", surface.Rz_um, kRaOfRz);
  };
  std::ranges::for_each(p.drawing.outer, of);
  std::ranges::for_each(p.drawing.inner, of);
  std::ranges::for_each(p.drawing.faces, of);
}

void add_threads(std::vector<Check>& all, const PreparedPart& p,
                 const planning::SetupPlan& setup, std::size_t index,
                 const std::vector<ToolRow>& tools) {
  const auto add = [&](const auto& e, const std::string& gauge) {
    if (!e.cut || e.cut->kind != part::CutKind::thread ||
        planning::setup_of(p, e.id) != index)
      return;
    all.push_back({thread_label(*e.cut), e.id, tr("go, no-go"), tr("not predicted"),
                   gauge, when(p, finishing_tool(tools, setup, e.id), false)});
  };
  for (const auto& e : p.drawing.outer) add(e, tr("thread rings"));
  for (const auto& e : p.drawing.inner) add(e, tr("thread plug"));
}

void add_knurls(std::vector<Check>& all, const PreparedPart& p,
                const planning::SetupPlan& setup, std::size_t index,
                const std::vector<ToolRow>& tools) {
  for (const auto& e : p.drawing.outer)
    if (part::is_knurled(e) && planning::setup_of(p, e.id) == index)
      all.push_back(
          {fmt::format("DIN 82-{} \u00d8{}",
                       part::designation(part::Knurl{e.cut->knurl, e.cut->pitch_mm}),
                       plain(e.cut->drawn.left_mm)),
           e.id, say("turned to \u00d8{} before", plain(e.left_mm)), tr("not predicted"),
           tr("caliper"), when(p, finishing_tool(tools, setup, e.id), false)});
}

void add_reamed(std::vector<Check>& all, const PreparedPart& p,
                const planning::SetupPlan& setup, std::size_t index,
                const std::vector<ToolRow>& tools) {
  for (const auto& e : p.drawing.inner)
    if (part::is_reamed(e) && planning::setup_of(p, e.id) == index)
      all.push_back({fmt::format("\u00d8{} {}", plain(e.left_mm), e.fit.value_or("")),
                     e.id, tr("go, no-go"), tr("not predicted"), tr("plug gauge"),
                     when(p, finishing_tool(tools, setup, e.id), false)});
}

}  // namespace

std::vector<Check> inspection(const PreparedPart& part, const planning::ProcessPlan& plan,
                              std::size_t setup, const std::vector<ToolRow>& tools) {
  std::vector<Check> all;
  const auto& answer = plan.setups[setup];
  for (const auto& t : part.drawing.tolerances) {
    if (measured_after(part, t) != setup) continue;
    const auto result = std::ranges::find(plan.tolerances, t.id, &ToleranceResult::id);
    if (result != plan.tolerances.end())
      all.push_back(check(part, answer, t, *result, made_on(part, t, setup), tools));
  }
  add_roughness(all, part, answer, setup, tools);
  add_threads(all, part, answer, setup, tools);
  add_knurls(all, part, answer, setup, tools);
  add_reamed(all, part, answer, setup, tools);
  return all;
}

}  // namespace turnwright::report
