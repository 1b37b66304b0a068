#pragma once
#include <string>
#include <string_view>

namespace turnwright::service {

/// What a request's first line asks for (RFC 9112, 3.2).
struct Target {
  std::string path;  ///< with its query: "/v1/parts?x=1"; "*" of all paths
  std::string host;  ///< where the target names one, as of proxies: its authority
};

/// Reads origin-form, absolute-form ("http://host/path") and asterisk-form.  What is none
/// of these is left as it is, in `path`.
Target read_target(std::string_view method, std::string_view target);

}  // namespace turnwright::service
