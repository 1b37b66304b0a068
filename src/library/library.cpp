#include <cxxabi.h>
#include <turnwright/turnwright.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "data_beside.hpp"
#include "document/json/parse.hpp"
#include "service/problem_list.hpp"
#include "service/requests.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/document/catalogue.hpp"

struct turnwright_catalogue {
  std::string folder;
  turnwright::document::Catalogue documents;
};

struct turnwright_stop {
  std::stop_source source;
};

namespace turnwright::library {
namespace {

using nlohmann::ordered_json;

/// A status with the document that goes with it.
struct Outcome {
  int status = TURNWRIGHT_OK;
  ordered_json document;
};

Outcome failed(int status, const char* title, const std::string& detail) {
  return {status, {{"title", title}, {"detail", detail}}};
}

/// The one catch-all of the library: whatever is thrown is told as a document.
Outcome told(const std::function<ordered_json()>& work) {
  try {
    return {TURNWRIGHT_OK, work()};
  } catch (const InputError& e) {
    auto outcome = failed(TURNWRIGHT_WRONG_INPUT, "wrong input", e.what());
    outcome.document["errors"] = service::problem_list(e.problems());
    return outcome;
  } catch (const ModelRangeError& e) {
    return failed(TURNWRIGHT_OUTSIDE_RANGE, "outside a model's range", visible(e.what()));
  } catch (const Cancelled&) {
    return failed(TURNWRIGHT_CANCELLED, "cancelled", "a stop was requested");
  } catch (const std::bad_alloc&) {
    throw;  // there is no memory for a document either
  } catch (const std::exception& e) {
    return failed(TURNWRIGHT_INTERNAL, "internal error", visible(e.what()));
  }
}

/// Text for a caller of C, or null.
char* given(const ordered_json& document) {
  const auto text = document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  auto* copy = static_cast<char*>(std::malloc(text.size() + 1));
  return copy ? std::strcpy(copy, text.c_str()) : nullptr;
}

/// Fills `place` with what `work` comes to, and lets no exception pass.
template <class Work>
int hand_out(char** place, const Work& work) {
  *place = nullptr;
  try {
    const auto outcome = told(work);
    if (!outcome.document.is_null() && !(*place = given(outcome.document)))
      return TURNWRIGHT_INTERNAL;
    return outcome.status;
  } catch (const abi::__forced_unwind&) {
    throw;  // no exception: the thread is being cancelled, by pthread_exit() in `progress`
  } catch (...) {
    return TURNWRIGHT_INTERNAL;
  }
}

/// @throws InputError for arguments that are NULL.
void require(std::initializer_list<std::pair<const char*, const void*>> arguments) {
  std::vector<Problem> problems;
  for (const auto& [name, value] : arguments)
    if (!value) problems.push_back({name, "NULL", "a pointer", "type"});
  if (!problems.empty()) throw InputError("arguments", std::move(problems));
}

const service::Request& row_of(const char* name) {
  if (const auto* row = service::find_request(name)) return *row;
  std::string names;
  for (const auto& row : service::requests())
    names += (names.empty() ? "" : ", ") + row.name;
  throw InputError("arguments", {{"name", '"' + std::string(name) + '"',
                                  "one of " + names, "choice"}});
}

// Options of a program that was compiled with this header or an earlier one, which knew
// fewer of them.
turnwright_options whole(const turnwright_options* options) {
  turnwright_options all{};
  if (!options) return all;
  if (options->size < sizeof options->size || options->size > sizeof all)
    throw InputError("arguments", {{"options/size", std::to_string(options->size),
                                    "at most " + std::to_string(sizeof all), "range"}});
  std::memcpy(&all, options, options->size);
  return all;
}

service::Context context_of(const turnwright_catalogue& catalogue,
                            const turnwright_options& options) {
  service::Context context{catalogue.documents};
  if (options.stop) context.stop = options.stop->source.get_token();
  if (options.progress)
    context.tell = [call = options.progress, user = options.user](
                       std::size_t done, std::size_t all) { call(done, all, user); };
  return context;
}

ordered_json with_drawings(const service::Request& row, const nlohmann::json& request,
                           const service::Context& context) {
  if (!row.drawn)
    return {{"result", service::answer(row, request, context)},
            {"drawings", ordered_json::array()}};
  const auto drawn = service::drawn_answer(row, request, context);
  ordered_json all{{"result", drawn.result}, {"drawings", ordered_json::array()}};
  for (const auto& picture : drawn.drawings)
    all["drawings"].push_back({{"name", picture.file}, {"svg", picture.svg}});
  if (row.html) all["report"] = service::html_report(row, request, drawn);
  return all;
}

ordered_json answered(const turnwright_catalogue* catalogue, const char* name,
                      const char* request, const turnwright_options* given) {
  require({{"catalogue", catalogue}, {"name", name}, {"request", request}});
  const auto& row = row_of(name);
  const auto options = whole(given);
  const auto context = context_of(*catalogue, options);
  leave_if(context.stop);
  const auto document = document::parse(request, row.name);
  return options.drawings ? with_drawings(row, document, context)
                          : service::answer(row, document, context);
}

ordered_json capabilities() {
  auto list = ordered_json::array();
  for (const auto& row : service::requests())
    list.push_back({{"name", row.name},
                    {"summary", row.summary},
                    {"example", ordered_json::parse(row.example)},
                    {"request_schema", service::request_schema(row)},
                    {"result_schema", service::result_schema(row)},
                    {"drawings", row.drawn != nullptr}});
  return list;
}

std::unique_ptr<turnwright_catalogue> opened(const char* folder) {
  auto place = folder ? std::optional<std::filesystem::path>(folder) : data_beside();
  place = document::data_folder(place);
  return std::make_unique<turnwright_catalogue>(
      turnwright_catalogue{place->string(), document::load_catalogue(*place)});
}

}  // namespace
}  // namespace turnwright::library

using namespace turnwright;

const char* turnwright_version(void) { return service::version().data(); }

char* turnwright_capabilities(void) {
  char* text = nullptr;
  library::hand_out(&text, library::capabilities);
  return text;
}

int turnwright_open(const char* folder, turnwright_catalogue** catalogue,
                    char** problem) {
  if (!catalogue || !problem) return TURNWRIGHT_WRONG_INPUT;
  *catalogue = nullptr;
  return library::hand_out(problem, [&]() -> nlohmann::ordered_json {
    *catalogue = library::opened(folder).release();
    return nullptr;
  });
}

void turnwright_close(turnwright_catalogue* catalogue) { delete catalogue; }

const char* turnwright_folder(const turnwright_catalogue* catalogue) {
  return catalogue ? catalogue->folder.c_str() : nullptr;
}

int turnwright_answer(const turnwright_catalogue* catalogue, const char* name,
                      const char* request, const turnwright_options* options,
                      char** answer) {
  if (!answer) return TURNWRIGHT_WRONG_INPUT;
  return library::hand_out(
      answer, [&] { return library::answered(catalogue, name, request, options); });
}

void turnwright_free(char* text) { std::free(text); }

turnwright_stop* turnwright_stop_new(void) {
  try {
    return new turnwright_stop;
  } catch (...) {
    return nullptr;
  }
}

void turnwright_stop_request(turnwright_stop* stop) {
  if (stop) stop->source.request_stop();
}

void turnwright_stop_free(turnwright_stop* stop) { delete stop; }
