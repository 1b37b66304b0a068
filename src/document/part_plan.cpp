#include "turnwright/document/part_plan.hpp"

#include "fields.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

using planning::Objective;

void read_name(Draft& draft) {
  auto& part_name = draft.drawing().name;
  if (draft.root.has("name")) {
    part_name = draft.root.text("name");
  } else {
    part_name = "part";
    draft.assume("/name", part_name, "no name given");
  }
}

void read_rates(Draft& draft) {
  auto& plan = draft.plan();
  auto rates = draft.root.optional_object("rates");
  if (rates) {
    if (const auto rate = rates->optional_number("machine_per_min", within(1e-6, 1e4)))
      plan.machine_per_min = *rate;
    plan.price = rates->optional_number("price", above_up_to(0, 1e9));
    rates->finish();
  }
  if (!rates || !rates->has("machine_per_min")) {
    plan.machine_per_min = plan.machine.cost_per_min;
    draft.assume("/rates/machine_per_min", plan.machine_per_min,
                 "the machine's own rate");
  }
  if (plan.objective == Objective::profit && !plan.price && !(rates && rates->broken()))
    draft.root.problems().add({"/rates/price", "nothing",
                               "the price of a part: the objective is profit",
                               "missing"});
}

template <class T>
T or_assumed(Draft& draft, const char* key, const std::optional<T>& value, T fallback,
             const nlohmann::json& echoed) {
  if (value) return *value;
  draft.assume(std::string("/") + key, echoed, "default");
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
  plan.batch = static_cast<double>(
      or_assumed(draft, "batch", r.optional_integer("batch", 1, 1'000'000), 1L, 1));
  read_rates(draft);
  plan.machine_share_um =
      or_assumed(draft, "machine_share_um",
                 r.optional_number("machine_share_um", within(0, 1000, "um")),
                 plan.machine_share_um, plan.machine_share_um);
  plan.conformance = or_assumed(draft, "conformance",
                                r.optional_number("conformance", at_least_below(0.5, 1)),
                                plan.conformance, plan.conformance);
}

}  // namespace

LoadedPart load_part_plan(const nlohmann::json& json, const Catalogue& catalogue,
                          const std::string& document, Purpose purpose) {
  Problems problems{.document = document};
  Reader root = Reader(json, problems).as_object();
  Draft draft{.root = root, .catalogue = catalogue, .purpose = purpose};
  if (!root.broken()) {
    read_format(root, "turnwright-part/1");
    read_name(draft);
    read_catalogue_choices(draft);
    read_elements(draft);
    read_stock(draft);
    check_bores(draft);
    read_tolerances(draft);
    read_setups(draft);
    read_operations(draft);
    read_economics(draft);
    root.optional_items("milling", 0, 100);
    refuse_unsupported(root);
    root.finish();
  }
  problems.throw_if_any();
  return std::move(draft.loaded);
}

}  // namespace turnwright::document
