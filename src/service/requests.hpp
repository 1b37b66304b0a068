#pragma once
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"
#include "report/sheet/setup_sheet.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/nc/text.hpp"

/// The table of capabilities, each a pure function from a request document to a result
/// document.  Command line, HTTP and batches are generated from this table, so a new
/// capability is one new row.
namespace turnwright::service {

/// Everything that the answer to a request depends on or needs, apart from the request.
struct Context {
  const document::Catalogue& catalogue;
  std::stop_token stop = {};  ///< requested when nobody waits for the result any more
  /// Called by long sweeps after each of their parts, from their thread.
  std::function<void(std::size_t done, std::size_t all)> tell = {};
  nc::Settings settings = {};  ///< of the programs that plans have with their pictures
};

using Picture = report::Figure;

/// A result with its pictures.
struct Drawn {
  nlohmann::ordered_json result;
  std::vector<Picture> drawings;
  nc::Programs programs = {};                   ///< for plans, with the shop's numbers
  std::vector<report::SetupSheet> sheets = {};  ///< of the programs
};

struct Request {
  std::string name;     ///< as in `turnwright NAME` and `POST /v1/NAME`
  std::string summary;  ///< one line for the user
  std::string example;  ///< a complete request document
  nlohmann::ordered_json (*result)(const nlohmann::json& request, const Context& context);
  std::string (*text)(const nlohmann::ordered_json& result) =
      nullptr;  ///< for a terminal
  /// The result with pictures, for capabilities that have any.
  Drawn (*drawn)(const nlohmann::json& request, const Context& context) = nullptr;
  /// The report for a browser or a printer, for capabilities that have one.
  std::string (*html)(std::string_view name, const Drawn& drawn) = nullptr;
};

std::span<const Request> requests();

/// The row of this name; null if there is none.
const Request* find_request(std::string_view name);

/// File names under schemas/ of the row's request and result.
std::string request_schema(const Request& row);
std::string result_schema(const Request& row);

/// The program's version, "0.1.0".
std::string_view version();

/// The row's result for a request document, with `format`, `turnwright_version` and
/// `request_digest` (SHA-256 of the request's dump: sorted keys, no spaces), so that a
/// stored result can be traced.
/// @throws InputError, ModelRangeError as the row does; ModelRangeError if a number of
///   the result is not finite.
nlohmann::ordered_json answer(const Request& row, const nlohmann::json& request,
                              const Context& context);

/// The same with the row's pictures.
/// @throws std::domain_error if the row has none.
Drawn drawn_answer(const Request& row, const nlohmann::json& request,
                   const Context& context);

/// The row's report as one HTML file.
/// @throws std::domain_error if the row has none.
std::string html_report(const Request& row, const nlohmann::json& request,
                        const Drawn& drawn);

/// Whether the result says that no plan can meet the request.
bool infeasible(const nlohmann::ordered_json& result);

/// Whether the result says that there is a plan, and no NC program of it.
bool not_programmed(const nlohmann::ordered_json& result);

}  // namespace turnwright::service
