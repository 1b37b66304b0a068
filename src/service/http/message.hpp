#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "turnwright/base/errors.hpp"

/// Requests and replies of HTTP, without the network.
namespace turnwright::service {

class Spool;

struct Call {
  std::string method;           ///< "GET"
  std::string target;           ///< "/v1/parts/pump-shaft?x=1"
  std::string content_type;     ///< "" if absent
  std::string accept_encoding;  ///< "" if absent
  std::string authorization;    ///< the header's value
  std::string request_id;       ///< names this call in the log and in errors
  std::string body;
  std::string host = {};  ///< of an absolute target, otherwise of the Host header
  std::shared_ptr<const Spool> lines = {};  ///< the body of a batch, if kept in a file

  /// The target without its query; "" if it is not a path ("*").
  std::string_view path() const;
  /// Names and values of the query's parameters, not percent-decoded, which no parameter
  /// of this service needs.
  std::vector<std::pair<std::string_view, std::string_view>> query() const;
};

/// Whether a Content-Type (RFC 9110, 8.3) is `type`, with UTF-8 as charset if it names
/// one.
bool is_type(std::string_view content_type, std::string_view type);

struct Reply {
  int status = 200;
  std::string content_type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// A problem document (RFC 9457) with the problems of a document as `errors`.
/// @param kind  last part of its `type`, "urn:turnwright:problem:" + kind.
Reply problem(int status, const std::string& kind, const std::string& detail,
              const Call& call, const std::vector<Problem>& errors = {});

/// The reason phrase of a status this service uses.
std::string_view reason(int status);

/// Compresses the body by gzip (RFC 1952) if the client accepts that and the body is long
/// enough.
void compress_for(const Call& call, Reply& reply);

}  // namespace turnwright::service
