#include "line.hpp"

#include <algorithm>

#include "document/json/parse.hpp"
#include "document/json/reader.hpp"
#include "service/digest.hpp"
#include "service/problem_list.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> row_names() {
  std::vector<std::string> names;
  for (const auto& row : requests()) names.push_back(row.name);
  return names;
}

// What came may hold bytes that are no UTF-8; they are shown as U+FFFD.
std::string one_line(const ordered_json& record) {
  return record.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

BatchRecord failed(const std::string& name, const std::string& title,
                   const std::string& detail) {
  return {
      one_line(
          {{"name", name}, {"status", "error"}, {"title", title}, {"detail", detail}}),
      BatchStatus::error};
}

BatchRecord internal_error(const std::string& detail) {
  return {one_line(
              {{"status", "error"}, {"title", tr("internal error")}, {"detail", detail}}),
          BatchStatus::error};
}

}  // namespace

BatchRequest read_batch_line(const std::string& line) {
  const auto json = document::parse(line, "line");
  document::Problems problems{.document = "line"};
  document::Reader r = document::Reader(json, problems).as_object();
  const auto names = row_names();
  const auto row = r.at("name", tr("the name of a request")).as_choice(names);
  BatchRequest request{&requests()[row], r.object("document").json(), {}};
  r.finish();
  problems.throw_if_any();
  request.digest = sha256_hex(std::string(version()) + '\n' + request.row->name + '\n' +
                              request.document.dump());
  return request;
}

BatchRecord batch_record(const BatchRequest& request, const Context& context) {
  const auto& name = request.row->name;
  try {
    const auto result = answer(*request.row, request.document, context);
    const bool none = infeasible(result);
    return {
        one_line(
            {{"name", name}, {"status", none ? "infeasible" : "ok"}, {"result", result}}),
        none ? BatchStatus::infeasible : BatchStatus::ok};
  } catch (const InputError& error) {
    return {one_line({{"name", name},
                      {"status", "error"},
                      {"title", tr("wrong input")},
                      {"errors", problem_list(error.problems())}}),
            BatchStatus::error};
  } catch (const ModelRangeError& error) {
    return failed(name, tr("outside a model's range"), error.what());
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return failed(name, tr("internal error"), error.what());
  }
}

BatchRecord batch_record(const InputError& error) {
  return {one_line({{"status", "error"},
                    {"title", tr("wrong line")},
                    {"errors", problem_list(error.problems())}}),
          BatchStatus::error};
}

BatchRecord batch_record(const std::bad_alloc&) {
  return internal_error(tr("not enough memory"));
}

BatchRecord fatal_record() {
  return internal_error(tr("the process ended while this line was computed"));
}

std::string numbered(std::int64_t number, const std::string& text) {
  return "{\"line\":" + std::to_string(number) + ',' + text.substr(1);
}

}  // namespace turnwright::service
