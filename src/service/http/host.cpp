#include "host.hpp"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/asio/ip/address.hpp>
#include <optional>
#include <string>

namespace turnwright::service {
namespace {

bool is_address(std::string_view name) {
  boost::system::error_code ec;
  boost::asio::ip::make_address(std::string(name), ec);
  return !ec;
}

bool is_port(std::string_view text) {
  return text.empty() ||
         (text[0] == ':' && text.find_first_not_of("0123456789", 1) == text.npos);
}

/// The name or address without its port; none if it is no host.
std::optional<std::string_view> name_of(std::string_view host) {
  const bool literal = host.starts_with('[');
  const auto end = std::min(host.find(literal ? ']' : ':'), host.size());
  const auto name = literal ? host.substr(1, end - 1) : host.substr(0, end);
  const auto port = host.substr(std::min(end + (literal ? 1 : 0), host.size()));
  const bool good = literal ? end < host.size() && is_address(name)
                            : std::all_of(name.begin(), name.end(), is_of_name);
  return good && is_port(port) ? std::optional(name) : std::nullopt;
}

}  // namespace

bool is_of_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
         c == '-' || c == '.' || c == '_';
}

bool is_host(std::string_view host) { return name_of(host).has_value(); }

bool is_local(std::string_view host) {
  const auto name = name_of(host);
  return name && (name->find('.') == name->npos || is_address(*name));
}

bool origin_is(std::string_view origin, std::string_view host) {
  const auto scheme = origin.find("://");
  return scheme != std::string_view::npos &&
         boost::algorithm::iequals(origin.substr(scheme + 3), host);
}

}  // namespace turnwright::service
