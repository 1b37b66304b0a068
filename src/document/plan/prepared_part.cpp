#include "turnwright/document/prepared_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "default_setups.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "document/part/choices.hpp"
#include "document/part/part_sections.hpp"
#include "document/part/what_if.hpp"
#include "planning/auxiliary/milled_ways.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "turnwright/planning/limit.hpp"
#include "turnwright/planning/prepare.hpp"
#include "turnwright/planning/rules.hpp"

namespace turnwright::document {
namespace {

constexpr double kNotedBelow = 0.9;  // of a section's stiffness
constexpr double kRounding_mm = 1e-9;

using Assumed = std::vector<Assumption>;

void add_grips(const planning::PreparedPart& p, Assumed& assumed) {
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (!p.setups[s].grip_mm)
      assumed.push_back({"/setups/" + std::to_string(s) + "/grip_mm", p.grips_mm[s],
                         tr("half the held diameter, at least 15 mm and at most half of "
                            "what is held; less where a surface could not be cut else")});
}

void add_drilled_holes(const planning::PreparedPart& p, Assumed& assumed) {
  for (std::size_t i = 0; i < p.drilled_mm.size(); ++i)
    if (p.drilled_mm[i] > 0)
      assumed.push_back({"/inner/" + std::to_string(i),
                         {{"drilled_mm", p.drilled_mm[i]}},
                         part::is_hole(p.drawing.inner[i])
                             ? tr("the hole's own drill")
                             : tr("the drill that leaves at least 0.5 mm on the radius "
                                  "for boring and spares what lies behind the hole")});
}

// The reason why the place cannot be milled in any clamping of the setup that the request
// gives; empty if it can.
std::string obstacle(const planning::PreparedPart& p, const planning::MilledPlace& m) {
  std::string why;
  for (const auto clamping : p.setups[*m.setup].clampings)
    if (why = planning::milled_obstacle(p, m, *m.setup, clamping); why.empty()) break;
  return why;
}

void add_milled_place(const planning::PreparedPart& p, const planning::MilledPlace& m,
                      const Reader& r, Assumed& assumed) {
  const auto assume = [&](const std::string& pointer, nlohmann::json value,
                          std::string why) {
    assumed.push_back({pointer, std::move(value), std::move(why)});
  };
  if (!m.setup)
    return r.problem(say("a place that some setup leaves free once {} is turned",
                         p.drawing.outer[m.element].id),
                     "conflict");
  if (!m.given_setup)
    assume(r.pointer_of("setup"), *m.setup, tr("the first that leaves it free"));
  else if (const auto why = obstacle(p, m); !why.empty())
    r.problem_at("setup", say("a setup that can mill {}: in this one {}", m.id, why),
                 "conflict");
  if (const auto later = planning::gripped_later(p, m))
    assume(r.pointer_of("angle_deg"), m.angle_deg,
           say("no jaw of setup {} stands on it", *later));
  if (const double kept = planning::stiffness_kept(p, m); kept < kNotedBelow)
    assume(
        r.pointer_of("depth_mm"), m.depth_mm,
        say("the section keeps {} % of its stiffness here, which later cuts do not count",
            static_cast<int>(std::floor(100 * kept))));
  for (const auto& cutter : m.cutters)
    if (!p.machine.driven_tools->modes.count(cutter.id) && m.cutters.size() == 1)
      assume("/machine/driven_tools/measured", cutter.id,
             tr("the tool point is that of the cutter's document, not measured here"));
}

void add_milled_places(const LoadedPart& loaded, const planning::PreparedPart& p,
                       Assumed& assumed) {
  if (p.milled_places.empty()) return;
  Problems problems{.document = loaded.document};
  const auto items = Reader(loaded.json, problems).items("milling", 0, p.milled.size());
  for (std::size_t i = 0; i < p.milled_places.size(); ++i)
    if (const auto entry = p.milled[i].entry; i == 0 || p.milled[i - 1].entry != entry)
      add_milled_place(p, p.milled_places[i], items[entry], assumed);
  problems.throw_if_any();
}

void add_jaws(const planning::PreparedPart& p, Assumed& assumed) {
  for (std::size_t s = 0; s < p.jaws.size(); ++s) {
    if (p.jaws[s].spares_tube)
      assumed.push_back(
          {"/setups/" + std::to_string(s) + "/grip_force_N", p.jaws[s].roughing_N,
           say("the jaws close with less than the chuck's {} N so that they strain the "
               "hollow part to two thirds of its yield strength",
               number_text(p.machine.chuck.grip_force_N))});
    if (p.jaws[s].eased)
      assumed.push_back(
          {"/setups/" + std::to_string(s) + "/finishing_grip_force_N",
           p.jaws[s].finishing_N,
           say("the jaws are eased from {} N so that their lobes in the tube use at most "
               "a quarter of each tolerance, but not below a twentieth of that force",
               number_text(p.jaws[s].roughing_N))});
  }
}

// Tools of given operations, of which the shop's rules may leave none.
void check_given_tools(const LoadedPart& loaded) {
  if (!loaded.plan.operations) return;
  const auto ruled = planning::ruled(loaded.plan);
  const auto left = [](const auto& tools, const std::string& id) {
    return std::ranges::any_of(tools, [&](const auto& tool) { return tool.id == id; });
  };
  Problems problems{.document = loaded.document};
  for (std::size_t i = 0; i < loaded.plan.operations->size(); ++i) {
    const auto& tool = (*loaded.plan.operations)[i].tool;
    if (tool && !left(ruled.tools, *tool) && !left(ruled.fixed_tools, *tool))
      problems.add({"/operations/" + std::to_string(i) + "/tool", shown(*tool),
                    tr("a tool that the rules of the shop leave"), "conflict"});
  }
  problems.throw_if_any();
}

// Cross holes are drilled where they are drawn: they lie on their cylinder, and over the bore
// that they open into, as programs make these too.
void check_programmed_holes(const LoadedPart& loaded, const planning::MovedFaces& moved) {
  if (moved.empty()) return;
  auto made = loaded.plan.drawing;
  const auto move = [&](auto& elements, bool inner) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto by = [&](part::End end) {
        return planning::end_moved_mm(moved, loaded.plan.drawing, {inner, i}, end);
      };
      elements[i].length_mm += by(part::End::right) - by(part::End::left);
    }
  };
  move(made.outer, false);
  move(made.inner, true);
  Problems problems{.document = loaded.document};
  for (const auto& m : loaded.plan.milled) {
    if (m.kind != planning::MilledKind::cross_hole) continue;
    const auto add = [&](const std::string& wanted) {
      const auto pointer = fmt::format("/milling/{}/at_mm", m.entry);
      if (problems.list.empty() || problems.list.back().pointer != pointer)
        problems.add({pointer, fmt::format("{:.6g} mm", m.z_mm + m.length_mm / 2), wanted,
                      "conflict"});
    };
    const auto& e = made.outer[m.element];
    const double z0 = part::left_z_mm(made, m.element), z1 = z0 + e.length_mm;
    if (m.z_mm < z0 - kRounding_mm || m.z_mm + m.length_mm > z1 + kRounding_mm)
      add(
          say("a hole that lies on {} where the middles of the limits in tolerances have "
              "it, from {:.6g} mm to {:.6g} mm",
              e.id, z0, z1));
    else if (m.through == planning::Through::wall &&
             m.width_mm >= part::least_hole_mm(made, m.z_mm, m.z_mm + m.length_mm))
      add(
          tr("a hole with a bore behind all of its width where the middles of the limits "
             "in tolerances have the bore"));
  }
  problems.throw_if_any();
}

// Plans cut the elements as long as they are drawn, programs as the middles of the lengths'
// limits have them.
void check_programmed_lengths(const LoadedPart& loaded) {
  constexpr double kMost = 0.5;  // of an element's length
  const auto& d = loaded.plan.drawing;
  const auto moved = planning::faces_moved_mm(d);
  Problems problems{.document = loaded.document};
  const auto check = [&](const auto& elements, bool inner, const std::string& list) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto by = [&](part::End end) {
        return planning::end_moved_mm(moved, d, {inner, i}, end);
      };
      const double drawn_mm = elements[i].length_mm;
      const double longer_mm = by(part::End::right) - by(part::End::left);
      if (std::abs(longer_mm) > kMost * drawn_mm)
        problems.add({list + std::to_string(i) + "/length_mm",
                      number_text(drawn_mm) + " mm",
                      say("a length that the middles of the limits in tolerances change "
                          "by at most a half: they make {:.6g} mm of it",
                          drawn_mm + longer_mm),
                      "conflict"});
    }
  };
  check(d.outer, false, "/outer/");
  check(d.inner, true, "/inner/");
  problems.throw_if_any();
  check_programmed_holes(loaded, moved);
}

planning::PreparedPart with_limit(const ChangedRequest& change,
                                  const planning::PreparedPart& part,
                                  Problems& problems) {
  const auto all = planning::limits(part);
  const auto limit = std::find_if(all.begin(), all.end(),
                                  [&](const auto& l) { return l.name == change.limit; });
  if (limit != all.end()) {
    planning::PlanRequest request = part;
    limit->scale(request, change.factor);
    return planning::prepare(std::move(request), part);
  }
  std::vector<std::string> names;
  for (const auto& l : all) names.push_back(l.name);
  problems.add({change.pointer, shown(change.limit),
                expected_reference(change.limit, names, tr("a limit of this request")),
                "reference"});
  return part;
}

std::vector<Variant> variants_of(const nlohmann::json& request,
                                 const std::string& document) {
  Problems problems{.document = document};
  auto all = variants(request, problems);
  problems.throw_if_any();
  return all;
}

LoadedPart first_variant(const nlohmann::json& request, const Catalogue& catalogue,
                         const std::string& document) {
  auto first = variants_of(request, document).front();
  return with_setups(first, catalogue, document);
}

std::vector<planning::WhatIf> what_if(const LoadedPart& loaded,
                                      const planning::PreparedPart& part,
                                      const Catalogue& catalogue) {
  Problems problems{.document = loaded.document};
  std::vector<planning::WhatIf> all;
  for (const auto& change : changed_requests(loaded.json, problems)) {
    if (!change.limit.empty()) {
      all.push_back({change.name, with_limit(change, part, problems)});
      continue;
    }
    try {
      auto changed = first_variant(change.document, catalogue, loaded.document);
      changed.plan.face_edges_in_stock = loaded.plan.face_edges_in_stock;
      all.push_back({change.name, prepared(std::move(changed), catalogue).part});
    } catch (const InputError& error) {
      for (auto p : error.problems()) {
        p.pointer = change.pointer + p.pointer;
        problems.add(std::move(p));
      }
    }
  }
  problems.throw_if_any();
  return all;
}

using Usable = std::vector<Candidates::Usable>;

void add_usable_once(std::string name, LoadedPart loaded, const Catalogue& catalogue,
                     Usable& all) {
  auto without = planning::without_each_rule(loaded.plan);
  all.push_back({std::move(name), prepared(std::move(loaded), catalogue),
                 std::move(without), std::nullopt});
}

// With proven conditions twice, the second time without them.
void add_usable(const std::string& name, LoadedPart loaded, const Catalogue& catalogue,
                Usable& all) {
  constexpr double kPercent = 100;
  if (!planning::prefers_proven(loaded.plan))
    return add_usable_once(name, std::move(loaded), catalogue, all);
  const std::string prefix = name.empty() ? "" : name + "; ";
  auto any = loaded;
  any.plan.rules.proven.clear();
  add_usable_once(prefix + tr("at proven conditions"), std::move(loaded), catalogue, all);
  add_usable_once(prefix + tr("at any conditions"), std::move(any), catalogue, all);
  all.back().unless_within =
      all[all.size() - 2].document.part.rules.proven_within_pct / kPercent;
}

// With walls before edges in stock faced, and left to the tools that finish.
void add_facings(const std::string& name, LoadedPart loaded, const Catalogue& catalogue,
                 Usable& all) {
  if (!planning::has_edges_in_stock(loaded.plan))
    return add_usable(name, std::move(loaded), catalogue, all);
  const std::string prefix = name.empty() ? "" : name + "; ";
  auto left = loaded;
  left.plan.face_edges_in_stock = false;
  add_usable(prefix + tr("shoulders before edges in stock faced"), std::move(loaded),
             catalogue, all);
  add_usable(prefix + tr("edges in stock left to the tools that finish in front"),
             std::move(left), catalogue, all);
}

// A variant in every way of making those bores that tools on the axis may make instead of a
// boring bar; names tell them apart.  `bored` are those that are settled so.
void add_ways(Variant variant, LoadedPart loaded, std::vector<std::size_t> bored,
              const Catalogue& catalogue, bool window_curves, Usable& all) {
  const auto open = std::ranges::find_if(loaded.drillable, [&](const DrillableBore& b) {
    return std::ranges::find(bored, b.inner) == bored.end();
  });
  if (open == loaded.drillable.end()) {
    loaded.plan.window_curves = window_curves;
    return add_facings(variant.name, std::move(loaded), catalogue, all);
  }
  const std::string bore = (variant.name.empty() ? "" : variant.name + "; ") +
                           loaded.plan.drawing.inner[open->inner].id + " ";
  auto other = variant;
  other.name = bore + tr(open->how);
  other.document["inner"][open->inner]["kind"] = "hole";
  variant.name = bore + tr("bored");
  auto settled = bored;
  settled.push_back(open->inner);
  const std::string document = loaded.document;
  add_ways(std::move(variant), std::move(loaded), std::move(settled), catalogue,
           window_curves, all);
  auto drilled = load_variant(other, catalogue, document);
  add_ways(std::move(other), std::move(drilled), std::move(bored), catalogue,
           window_curves, all);
}

}  // namespace

PreparedDocument prepared(LoadedPart loaded, const Catalogue& catalogue) {
  check_given_tools(loaded);
  check_programmed_lengths(loaded);
  PreparedDocument out{planning::prepare(loaded.plan), std::move(loaded.assumed), {}};
  add_grips(out.part, out.assumed);
  add_drilled_holes(out.part, out.assumed);
  add_milled_places(loaded, out.part, out.assumed);
  add_jaws(out.part, out.assumed);
  out.what_if = what_if(loaded, out.part, catalogue);
  return out;
}

PreparedDocument prepared_part(const nlohmann::json& json, const Catalogue& catalogue,
                               const std::string& document, Purpose purpose) {
  if (purpose == Purpose::predict)
    return prepared(load_part_plan(json, catalogue, document, purpose), catalogue);
  return prepared(first_variant(json, catalogue, document), catalogue);
}

std::set<std::string> currencies(const Candidates& candidates) {
  std::set<std::string> all;
  for (const auto& c : candidates.usable) all.insert(c.document.part.currency);
  all.erase("");
  return all;
}

Candidates prepared_candidates(const nlohmann::json& json, const Catalogue& catalogue,
                               const std::string& document, bool window_curves) {
  Candidates out;
  std::optional<InputError> first;
  for (auto& variant : variants_of(json, document)) try {
      auto loaded = with_setups(variant, catalogue, document);
      add_ways(variant, std::move(loaded), {}, catalogue, window_curves, out.usable);
    } catch (const InputError& error) {
      if (!first) first = error;
      const auto& p = error.problems().front();
      out.refused.push_back(
          {variant.name, say("{}: got {}, expected {}", p.pointer, p.got, p.expected)});
    }
  if (out.usable.empty()) throw *first;
  if (const auto all = currencies(out); all.size() > 1)
    throw InputError(document,
                     {{"/choose/machine", say("rates in {}", fmt::join(all, ", ")),
                       tr("machines whose rates are in one currency, or a rate and a "
                          "currency in /rates"),
                       "conflict"}});
  return out;
}

}  // namespace turnwright::document
