#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "turnwright/base/errors.hpp"

/// HTTP without the network: what came in, what goes out.
namespace turnwright::service {

struct Call {
  std::string method;           ///< "GET"
  std::string target;           ///< "/v1/parts/pump-shaft?x=1"
  std::string content_type;     ///< "" where the client gave none
  std::string accept_encoding;  ///< "" where the client gave none
  std::string authorization;    ///< the header's value
  std::string request_id;       ///< names this call in the log and in errors
  std::string body;
  std::string host = {};  ///< who is asked: of the target, else of the header

  /// The target without its query; "" if it is no path ("*").
  std::string_view path() const;
  /// Names and values of the query's parameters.  Not percent-decoded: no parameter of
  /// this service needs it.
  std::vector<std::pair<std::string_view, std::string_view>> query() const;
};

/// Whether a Content-Type (RFC 9110, 8.3) is `type`, and UTF-8 where it names a charset.
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

/// The body gzipped (RFC 1952) where the client takes gzip and it is long enough to gain.
void compress_for(const Call& call, Reply& reply);

}  // namespace turnwright::service
