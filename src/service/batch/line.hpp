#pragma once
#include <cstdint>
#include <new>
#include <string>

#include "service/requests.hpp"
#include "turnwright/base/errors.hpp"

/// One line of a batch: {"name": "plan", "document": {..}}.
namespace turnwright::service {

/// A line that can be answered.
struct BatchRequest {
  const Request* row = nullptr;
  nlohmann::json document;
  std::string digest;  ///< SHA-256 over version, name and document; determines the answer
};

/// The request of a line.
/// @throws InputError if it is not JSON, names no capability, or has other members.
BatchRequest read_batch_line(const std::string& line);

enum class BatchStatus { ok, infeasible, error };

struct BatchRecord {
  std::string text;  ///< one line of JSON
  BatchStatus status = BatchStatus::ok;
};

/// The record of a line without its number: "status" is "ok", "infeasible" or "error",
/// with "name" and "result" or with the problem's "title", "detail" and "errors".  Wrong
/// input gives an error record and never ends a batch.
/// @throws Cancelled if a stop is requested; std::bad_alloc, which need not be the fault
///   of the line.
BatchRecord batch_record(const BatchRequest& request, const Context& context);

/// The record of a line that read_batch_line refused.
BatchRecord batch_record(const InputError& error);

/// The record of a line for which there was not enough memory.
BatchRecord batch_record(const std::bad_alloc& error);

/// The record of a line that ended the process.
BatchRecord fatal_record();

/// The text of a record in the results: {"line": number, ..}.
std::string numbered(std::int64_t number, const std::string& text);

}  // namespace turnwright::service
