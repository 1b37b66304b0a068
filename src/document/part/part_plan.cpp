#include "turnwright/document/part_plan.hpp"

#include <string>
#include <utility>

#include "base/say.hpp"
#include "choices.hpp"
#include "document/json/fields.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

using planning::Objective;

// Lengths that fit on a line of a set-up sheet.
constexpr std::size_t kTitleBytes = 64, kRevisionBytes = 16;

void read_name(Draft& draft) {
  auto& part_name = draft.drawing().name;
  if (draft.root.has("name")) {
    part_name = draft.root.text("name");
  } else {
    part_name = "part";
    draft.assume("/name", part_name, tr("no name given"));
  }
}

void read_title_block(Draft& draft) {
  auto& title = draft.drawing().title;
  Reader& r = draft.root;
  title.drawing_number = r.text_or("drawing_number", "", kTitleBytes);
  title.revision = r.text_or("revision", "", kRevisionBytes);
  title.customer = r.text_or("customer", "", kTitleBytes);
}

void read_rates(Draft& draft) {
  auto& plan = draft.plan();
  auto rates = draft.root.optional_object("rates");
  if (rates) {
    if (const auto rate = rates->optional_number("machine_per_min", within(1e-6, 1e4)))
      plan.machine_per_min = *rate;
    plan.price = rates->optional_number("price", above_up_to(0, 1e9));
    plan.currency = read_currency(*rates);
    rates->finish();
  }
  if (plan.currency.empty()) plan.currency = plan.machine.currency;
  if (!rates || !rates->has("machine_per_min")) {
    plan.machine_per_min = plan.machine.cost_per_min;
    draft.assume("/rates/machine_per_min", plan.machine_per_min,
                 tr("the machine's own rate"));
  }
  if (plan.objective == Objective::profit && !plan.price && !(rates && rates->broken()))
    draft.root.problems().add({"/rates/price", tr("nothing"),
                               tr("the price of a part: the objective is profit"),
                               "missing"});
}

template <class T>
T or_assumed(Draft& draft, const char* key, const std::optional<T>& value, T fallback,
             const nlohmann::json& echoed) {
  if (value) return *value;
  draft.assume(std::string("/") + key, echoed, tr("default"));
  return fallback;
}

void read_economics(Draft& draft) {
  auto& plan = draft.plan();
  Reader& r = draft.root;
  plan.objective = or_assumed(
      draft, "objective",
      r.optional_choice<Objective>("objective", {{"cost", Objective::cost},
                                                 {"time", Objective::time},
                                                 {"profit", Objective::profit}}),
      Objective::cost, "cost");
  const bool no_batch = r.has("batch") && r.at("batch").json().is_null();
  if (r.has("batch") && !no_batch)
    plan.batch = static_cast<double>(r.integer("batch", 1, 1'000'000));
  else if (!no_batch)
    draft.assume("/batch", nullptr,
                 tr("none: time and cost per part do not include preparing the machine"));
  read_rates(draft);
  plan.machine_share_um =
      or_assumed(draft, "machine_share_um",
                 r.optional_number("machine_share_um", within(0, 1000, "um")),
                 plan.machine_share_um, plan.machine_share_um);
  plan.window_percent =
      or_assumed(draft, "window_percent",
                 r.optional_number("window_percent", above_up_to(0, 100, "%")),
                 plan.window_percent, plan.window_percent);
  plan.pareto =
      static_cast<std::size_t>(draft.root.optional_integer("pareto", 2, 50).value_or(0));
  if (draft.root.has("robust"))
    plan.robust = draft.root.boolean("robust");
  else
    draft.assume("/robust", plan.robust,
                 tr("every tolerance is kept with the probability conformance"));
  const auto probability = at_least_below(0.5, 1);
  plan.conformance =
      or_assumed(draft, "conformance", r.optional_number("conformance", probability),
                 plan.conformance, plan.conformance);
  plan.roughness_conformance = r.optional_number("roughness_conformance", probability);
}

void read_damping(Draft& draft) {
  auto& plan = draft.plan();
  plan.damping_uncertainty_pct =
      draft.root.number_or("damping_uncertainty_pct", within(0, 100, "%"), 0);
  if (const auto given = draft.root.optional_number("damping_ratio", kDamping)) {
    plan.damping_ratio = plan.machine_damping_ratio = *given;
    return;
  }
  const auto& machines = plan.machine.damping_ratio;
  plan.damping_ratio = machines.value_or(plan.damping_ratio);
  plan.machine_damping_ratio = machines.value_or(plan.machine_damping_ratio);
  std::string why = machines ? tr("the machine's own")
                             : tr("parts that bend, on the safe side; 0.03 for chuck, "
                                  "centres, toolpost and bars");
  if (!plan.machine.tool_zz_mm_N)
    why +=
        tr("; the toolpost is taken as rigid along the feed (no tool_zz_mm_N), which for "
           "deep cuts is not the safe side");
  draft.assume("/damping_ratio", plan.damping_ratio, std::move(why));
}

// One number for whatever holds the part, or one for each.
catalogue::Rechucking read_rechucking(const Reader& given) {
  if (given.is_object()) return read_rechucking_by_jaws(given);
  const double um = given.as_number(within(0, 1000, "um"));
  return {um, um, um, um};
}

nlohmann::json json_of(const planning::ShopErrors& shop) {
  const auto& r = shop.rechucking;
  return {{"drift_um", shop.drift_um},
          {"drift_axial_um", shop.drift_axial_um},
          {"repeatability_um", shop.repeatability_um},
          {"part_warm_K", shop.part_warm_K},
          {"life_between_offsets", shop.life_between_offsets},
          {"wear_land_mm", shop.wear_land_mm},
          {"edge_wear_mm", shop.edge_wear_mm},
          {"wear_noticed_times", shop.wear_noticed_times},
          {"rechucking_um",
           {{"hard_jaws", r.hard_jaws_um},
            {"soft_jaws", r.soft_jaws_um},
            {"collet", r.collet_um},
            {"centres", r.centres_um}}},
          {"measurement_U_um", shop.measurement_U_um},
          {"first_part_gauged", shop.first_part_gauged}};
}

// What the request leaves open is the machine's own.
void read_budget(Draft& draft) {
  auto& shop = draft.plan().shop;
  const auto& machine = draft.plan().machine;
  const auto& own = machine.budget;
  shop.drift_um = own.drift_um;
  shop.drift_axial_um = own.drift_axial_um;
  shop.repeatability_um = own.repeatability_um;
  shop.part_warm_K = own.part_warm_K;
  shop.life_between_offsets = own.life_between_offsets;
  shop.rechucking = own.rechucking;
  auto given = draft.root.optional_object("budget");
  bool all = given.has_value();
  const auto has = [&](const char* key) {
    const bool is = given && given->has(key);
    all = all && is;
    return is;
  };
  const auto read = [&](const char* key, double& value, const Bounds& bounds) {
    if (has(key)) value = given->number(key, bounds);
  };
  const auto error = within(0, 1000, "um");
  read("drift_um", shop.drift_um, error);
  read("drift_axial_um", shop.drift_axial_um, error);
  read("repeatability_um", shop.repeatability_um, error);
  read("part_warm_K", shop.part_warm_K, within(0, 200, "K"));
  read("life_between_offsets", shop.life_between_offsets, within(0, 1));
  read("wear_land_mm", shop.wear_land_mm, within(0, 2, "mm"));
  if (has("edge_wear_mm")) {
    const Bounds land = within(0, 2, "mm");
    shop.edge_wear_mm = given->number("edge_wear_mm", land);
    if (contains(land, shop.edge_wear_mm) && shop.edge_wear_mm > shop.wear_land_mm)
      given->problem_at(
          "edge_wear_mm",
          say("at most wear_land_mm, {} mm", number_text(shop.wear_land_mm)),
          number_text(shop.edge_wear_mm));
    if (shop.edge_wear_mm > 0 && !(draft.plan().material.land_Ra_um_mm > 0))
      draft.assume("/material/worn_roughness", nullptr,
                   tr("the material does not tell it: surfaces are as smooth as new "
                      "edges leave them"));
  }
  read("wear_noticed_times", shop.wear_noticed_times, within(1, 10));
  if (has("rechucking_um")) shop.rechucking = read_rechucking(given->at("rechucking_um"));
  read("measurement_U_um", shop.measurement_U_um, error);
  if (has("first_part_gauged"))
    shop.first_part_gauged = given->boolean("first_part_gauged");
  if (given) given->finish();
  if (!all)
    draft.assume("/budget", json_of(shop),
                 say("where the part does not say: {} in ordinary production, no "
                     "measurement counted, offsets set by the first part",
                     machine.id));
}

LoadedPart load(const nlohmann::json& request, const Catalogue& catalogue,
                const std::string& document, Purpose purpose) {
  Problems problems{.document = document};
  Reader root = Reader(request, problems).as_object();
  Draft draft{.root = root, .catalogue = catalogue, .purpose = purpose};
  draft.loaded.json = request;
  draft.loaded.document = document;
  if (!root.broken()) {
    read_format(root, "turnwright-part/1");
    read_name(draft);
    read_title_block(draft);
    read_catalogue_choices(draft);
    read_elements(draft);
    read_stock(draft);
    check_bores(draft);
    read_edges(draft);
    add_tools_for_undercuts(draft);
    read_centre_holes(draft);
    read_drilled_holes(draft);
    read_general_edges(draft);
    read_tolerances(draft);
    give_grooves_their_limits(draft);
    read_setups(draft);
    read_operations(draft);
    read_economics(draft);
    read_damping(draft);
    read_budget(draft);
    read_what_if(draft);
    read_milling(draft);
    root.finish();
  }
  problems.throw_if_any();
  return std::move(draft.loaded);
}

}  // namespace

LoadedPart load_variant(const Variant& variant, const Catalogue& catalogue,
                        const std::string& document, Purpose purpose) {
  try {
    return load(variant.document, catalogue, document, purpose);
  } catch (const InputError& error) {
    auto problems = error.problems();
    for (auto& problem : problems)
      for (const auto& [place, in_request] : variant.places)
        if (problem.pointer.starts_with(place))
          problem.pointer.replace(0, place.size(), in_request);
    throw InputError(document, std::move(problems));
  }
}

LoadedPart load_part_plan(const nlohmann::json& request, const Catalogue& catalogue,
                          const std::string& document, Purpose purpose) {
  Problems problems{.document = document};
  if (purpose == Purpose::predict && request.is_object() && request.contains("choose"))
    problems.add(
        {"/choose", tr("a choice"), tr("nothing: only plan chooses"), "unsupported"});
  const auto all = variants(request, problems);
  problems.throw_if_any();
  return load_variant(all.front(), catalogue, document, purpose);
}

}  // namespace turnwright::document
