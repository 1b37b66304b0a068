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
  std::string digest;  ///< SHA-256 over version, name and document: equal, equal answer
};

/// What the line asks for.
/// @throws InputError if it is no JSON, or names no row, or holds other members.
BatchRequest read_batch_line(const std::string& line);

enum class BatchStatus { ok, infeasible, error };

struct BatchRecord {
  std::string text;  ///< one line of JSON
  BatchStatus status = BatchStatus::ok;
};

/// The record of a line without its number: "status" is "ok", "infeasible" or "error";
/// with "name" and "result" or with the problem's "title", "detail" and "errors".  Bad
/// input is a record, never the end of a batch.
/// @throws Cancelled if `stop` is asked for; std::bad_alloc, which says nothing about the
///   line.
BatchRecord batch_record(const BatchRequest& request, const Context& context);

/// The record of a line that read_batch_line refused.
BatchRecord batch_record(const InputError& error);

/// The record of a line that there was no memory for.
BatchRecord batch_record(const std::bad_alloc& error);

/// The record of a line that ended the process.
BatchRecord fatal_record();

/// A record's text as the results show it: {"line": number, ..}.
std::string numbered(std::int64_t number, const std::string& text);

}  // namespace turnwright::service
