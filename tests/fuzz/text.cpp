#include <optional>

#include "answered.hpp"
#include "document/json/file.hpp"
#include "document/response/measured_file.hpp"
#include "service/batch/line.hpp"
#include "targets.hpp"
#include "turnwright/document/import.hpp"
#include "turnwright/document/listen.hpp"

namespace turnwright::fuzz {
namespace {

using nlohmann::json;

/// A request with a text at some place.
struct Text {
  json request;
  json::json_pointer place;
};

/// The place of the first "csv", if there is one.
std::optional<json::json_pointer> find_csv(const json& value,
                                           const json::json_pointer& at) {
  if (!value.is_structured()) return {};
  for (const auto& [key, member] : value.items()) {
    const auto pointer = value.is_array() ? at / std::stoul(key) : at / key;
    if (key == "csv") return pointer;
    if (const auto inside = find_csv(member, pointer)) return inside;
  }
  return {};
}

/// As a document can hold it: in UTF-8.
json readable(std::string_view text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

Text table_of(const service::Request& door) {
  const auto schema = document::parse_file(std::string(TURNWRIGHT_SOURCE_DIR) +
                                           "/schemas/" + service::request_schema(door));
  for (const auto& example : schema["examples"])
    if (const auto place = find_csv(example, json::json_pointer()))
      return {example, *place};
  std::cerr << "no table in the examples of " << door.name << '\n';
  std::exit(2);
}

Text program(const std::string& chain) {
  json request{{"chain", chain}, {"axes", json::array()}};
  for (const char* axis : {"C", "Z", "X", "Y"})
    if (chain.find(axis) != std::string::npos)
      request["axes"].push_back({{"name", axis}});
  for (json& axis : request["axes"])
    if (axis["name"] == "X")
      axis["err"] = {{"EXX", {{"c", {0, 1e-3, 2e-3, 0}}, {"b", -2e-3}}}};
  request["tool_offsets_mm"] = {{"1", {0, 0, 50}}};
  request["work_offsets_mm"] = {{"G55", {1, 0, 2}}};
  return {request, json::json_pointer("/program")};
}

// The program of `review`'s example, in a control's words.
Text reviewed(const std::string& control) {
  auto request = document::parse(door_named("review").example, "example");
  request["control"] = control;
  return {request, json::json_pointer("/programs/0/text")};
}

// A response of `stability` in one of its forms, all else of which its text tells.
Text response(const std::string& form) {
  const json request{{"model", "turning"},
                     {"kappa_deg", 75},
                     {"kp_MPa", 900},
                     {"points", {{{"n_rpm", 900}, {"ap_mm", 0.01}}}},
                     {"frf", json::array({json::object()})}};
  return {request, json::json_pointer("/frf/0" + form)};
}

using Bytes = std::function<json(std::string_view)>;

Target in_request(const std::string& door, Text text, Bytes value = readable) {
  return [&row = door_named(door), text, value](std::string_view input) {
    auto request = text.request;
    request[text.place] = value(input);
    answered(row, request);
  };
}

// The bytes of a file as the command line puts them into a request.
json response_file(std::string_view bytes) {
  return document::measured_file(std::string(bytes));
}
json sound_file(std::string_view bytes) {
  return document::sound_base64(std::string(bytes));
}

// A file of an import, and what its request has beside it.
Target file_of(const std::string& door, const json& beside) {
  return [&row = door_named(door), beside](std::string_view bytes) {
    auto request = document::import_request(std::string(bytes));
    request.update(beside);
    answered(row, request);
  };
}

template <class Read>
Target refused_or_read(const Read& read) {
  return [read](std::string_view input) {
    try {
      read(input);
    } catch (const InputError&) {
    }
  };
}

}  // namespace

Target text_target(const std::string& name) {
  if (name == "batch")
    return refused_or_read(
        [](std::string_view line) { (void)service::read_batch_line(std::string(line)); });
  if (name == "json")
    return refused_or_read(
        [](std::string_view text) { (void)document::parse(text, "fuzz"); });
  if (name == "program") return in_request("compensate", program("wfXYZt"));
  if (name == "program-lathe") return in_request("compensate", program("wCfZXt"));
  if (name.starts_with("review-")) return in_request("review", reviewed(name.substr(7)));
  if (name.starts_with("drawing-"))
    return in_request("import", {{{"material", "C45"}, {"source", name.substr(8)}},
                                 json::json_pointer("/text")});
  if (name == "qif")
    return in_request("learn", {{{"qif", {{"files", json::array({""})}}}},
                                json::json_pointer("/qif/files/0")});
  if (name == "frf-file") return in_request("stability", response(""), response_file);
  if (name == "sound")
    return in_request("listen",
                      {{{"n_rpm", 900}, {"teeth", 3}}, json::json_pointer("/wav")},
                      sound_file);
  if (name == "comp-file")
    return in_request("positioning", {{{"axis", "X"},
                                       {"comp_file", {{"type", 0}, {"unit", "mm"}}},
                                       {"write_comp_file", json::object()}},
                                      json::json_pointer("/comp_file/text")});
  if (name == "frf-csv") return in_request("stability", response("/csv"));
  if (name == "frf-uff") return in_request("stability", response("/uff/text"));
  if (name == "frf-taps") return in_request("stability", response("/taps/csv"));
  if (name == "library") return file_of("import-tools", json::object());
  if (name == "drawing-file") return file_of("import", {{"material", "C45"}});
  if (!name.starts_with("csv-")) return {};
  return in_request(name.substr(4), table_of(door_named(name.substr(4))));
}

}  // namespace turnwright::fuzz
