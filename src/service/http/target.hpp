#pragma once
#include <string>
#include <string_view>

namespace turnwright::service {

/// The target of a request line (RFC 9112, 3.2).
struct Target {
  std::string path;  ///< with its query: "/v1/parts?x=1"; "*" for all paths
  std::string host;  ///< authority of an absolute target, as proxies send it; or ""
};

/// Reads origin-form, absolute-form ("http://host/path") and asterisk-form.  Any other
/// target is returned unchanged in `path`.
Target read_target(std::string_view method, std::string_view target);

}  // namespace turnwright::service
