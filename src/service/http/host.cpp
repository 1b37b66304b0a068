#include "host.hpp"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/asio/ip/address.hpp>
#include <string>

namespace turnwright::service {
namespace {

/// The host without its port; of an IPv6 address without its brackets.
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

}  // namespace

bool is_local(std::string_view host) {
  const auto name = without_port(host);
  if (name.find('.') == std::string_view::npos) return true;
  boost::system::error_code ec;
  boost::asio::ip::make_address(std::string(name), ec);
  return !ec;
}

bool origin_is(std::string_view origin, std::string_view host) {
  const auto scheme = origin.find("://");
  return scheme != std::string_view::npos &&
         boost::algorithm::iequals(origin.substr(scheme + 3), host);
}

}  // namespace turnwright::service
