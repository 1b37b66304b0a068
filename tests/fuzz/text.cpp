// libFuzzer target of the readers of text, --kind=: program and program-lathe, that of
// `compensate`; csv-NAME, the table of a door; batch, a line of a batch; json, any text.
#include <cstdint>

#include "answered.hpp"
#include "option.hpp"
#include "turnwright/document/file.hpp"
#include "turnwright/service/batch_line.hpp"

namespace turnwright::fuzz {
namespace {

using nlohmann::json;

std::string kind;
json request;
json::json_pointer place;
const service::Request* door = nullptr;

/// The first "csv" of the door's examples.
bool find_csv(const json& value, const json::json_pointer& at) {
  if (!value.is_structured()) return false;
  for (const auto& [key, member] : value.items()) {
    const auto pointer = value.is_array() ? at / std::stoul(key) : at / key;
    if (key == "csv") place = pointer;
    if (key == "csv" || find_csv(member, pointer)) return true;
  }
  return false;
}

/// As a document can hold it: in UTF-8.
json readable(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

void choose() {
  if (kind == "json" || kind == "batch") return;
  const bool csv = kind.starts_with("csv-"), lathe = kind == "program-lathe";
  door = &door_named(csv ? kind.substr(4) : "compensate");
  if (csv) {
    const auto schema =
        document::parse_file(std::string(TURNWRIGHT_SOURCE_DIR) + "/schemas/" +
                             service::request_schema(*door));
    for (const auto& example : schema["examples"])
      if (find_csv(example, json::json_pointer())) {
        request = example;
        return;
      }
    std::cerr << "no table in the examples of " << door->name << '\n';
    std::exit(2);
  }
  request = {{"chain", lathe ? "wCfZXt" : "wfXYZt"}, {"axes", json::array()}};
  for (const char* axis : {"C", "Z", "X", "Y"})
    if (request["chain"].get<std::string>().find(axis) != std::string::npos)
      request["axes"].push_back({{"name", axis}});
  for (json& axis : request["axes"])
    if (axis["name"] == "X")
      axis["err"] = {{"EXX", {{"c", {0, 1e-3, 2e-3, 0}}, {"b", -2e-3}}}};
  request["tool_offsets_mm"] = {{"1", {0, 0, 50}}};
  request["work_offsets_mm"] = {{"G55", {1, 0, 2}}};
  place = json::json_pointer("/program");
}

}  // namespace
}  // namespace turnwright::fuzz

using namespace turnwright;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  fuzz::kind = fuzz::option(*argc, *argv, "kind");
  fuzz::choose();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (fuzz::door) {
    fuzz::request[fuzz::place] = fuzz::readable(text);
    fuzz::answered(*fuzz::door, fuzz::request);
    return 0;
  }
  try {
    if (fuzz::kind == "batch")
      (void)service::read_batch_line(text);
    else
      (void)document::parse(text, "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}
