#include "turnwright/document/nc.hpp"

#include "document/json/fields.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const Choices<nc::Control> kControls{{"linuxcnc", nc::Control::linuxcnc},
                                     {"fanuc", nc::Control::fanuc}};

}  // namespace

NcRequest load_nc_request(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "nc"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-nc/1");
  const auto part = r.object("part");
  NcRequest out{.control = r.choice_or("control", kControls, nc::Control::linuxcnc)};
  r.finish();
  try {
    if (!part.broken()) out.part = prepared_part(part.json(), catalogue, "nc");
  } catch (const InputError& e) {
    for (auto problem : e.problems()) {
      problem.pointer = part.pointer() + problem.pointer;
      problems.add(std::move(problem));
    }
  }
  problems.throw_if_any();
  return out;
}

std::string file_name(const nc::SetupProgram& program, nc::Control control) {
  return "setup-" + std::to_string(program.setup) +
         (control == nc::Control::linuxcnc ? ".ngc" : ".nc");
}

ordered_json to_json(const nc::Programs& all, const planning::ProcessPlan& plan,
                     nc::Control control) {
  const bool planned = plan.status == planning::PlanStatus::ok;
  ordered_json out{{"status", !planned             ? "infeasible"
                              : all.cannot.empty() ? "ok"
                                                   : "not-programmed"},
                   {"programs", ordered_json::array()},
                   {"cannot", all.cannot}};
  for (const auto& p : all.setups)
    out["programs"].push_back({{"setup", p.setup},
                               {"name", file_name(p, control)},
                               {"minutes",
                                {{"cutting", p.minutes.cutting},
                                 {"air", p.minutes.air},
                                 {"tool_changes", p.minutes.tool_changes},
                                 {"operator_stops", p.minutes.operator_stops}}},
                               {"text", nc::text(p, control)}});
  out["tool_table"] = nc::tool_table(all.setups);
  return out;
}

}  // namespace turnwright::document
