#include "target.hpp"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>

namespace turnwright::service {

Target read_target(std::string_view method, std::string_view target) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!boost::algorithm::istarts_with(target, scheme)) continue;
    const auto rest = target.substr(scheme.size());
    const auto end = std::min(rest.find_first_of("/?#"), rest.size());
    const auto host = rest.substr(0, end);
    // No host and a user's name are to be refused (RFC 9110, 4.2.1 and 4.2.4).
    if (host.empty() || host.front() == ':' || host.find('@') != host.npos) break;
    std::string path(rest.substr(end));
    if (path.empty() && method == "OPTIONS") return {"*", std::string(host)};
    return {path.starts_with('/') ? path : '/' + path, std::string(host)};
  }
  return {std::string(target), ""};
}

}  // namespace turnwright::service
