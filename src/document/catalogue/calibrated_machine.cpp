#include "calibrated_machine.hpp"

#include "base/say.hpp"
#include "catalogue_readers.hpp"

namespace turnwright::document {

std::optional<MachineDocument> read_machine_document(Reader& r, const std::string& chain,
                                                     const std::string& axes) {
  if (!r.has("machine")) return {};
  const Reader machine = r.at("machine");
  const auto problems = r.problems().list.size();
  const auto lathe = read_lathe(machine);
  if (r.problems().list.size() != problems) return {};
  MachineDocument m{machine.json(), lathe.errors ? *lathe.errors : blank_errors(chain)};
  for (const char axis : axes)
    if (m.errors.chain.chain.find(axis) == std::string::npos) {
      r.problem_at("machine", say("a machine whose chain has the axis {}", axis),
                   "conflict");
      return {};
    }
  return m;
}

nlohmann::json with_errors(MachineDocument m, const std::vector<Calibrated>& found,
                           const std::string& source) {
  for (const Calibrated& one : found) put(one, m.errors);
  nlohmann::json errors = errors_json(m.errors);
  const auto before = m.document.find("errors");
  if (before != m.document.end() && before->contains("note"))
    errors["note"] = (*before)["note"];
  const bool more = before != m.document.end() && before->contains("source");
  errors["source"] =
      more ? source + "; " + (*before)["source"].get<std::string>() : source;
  m.document["errors"] = std::move(errors);
  return std::move(m.document);
}

}  // namespace turnwright::document
