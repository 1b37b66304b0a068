#pragma once
#include <string_view>

/// Checks of the headers Host and Origin.
namespace turnwright::service {

/// Whether c is an ASCII letter or digit, "-", "." or "_".
bool is_of_name(char c);

/// Whether the text is empty or a host, with or without a port: a name of letters,
/// digits, "-", "." and "_", an IPv4 address, or an IPv6 address in brackets.
bool is_host(std::string_view host);

/// Whether the value of a Host header is an IP address or a name without a dot, with or
/// without a port.  A page of another site that makes a browser call this machine by DNS
/// rebinding needs a name with a dot.
bool is_local(std::string_view host);

/// Whether the value of an Origin header, "http://name:port", names this host.
bool origin_is(std::string_view origin, std::string_view host);

}  // namespace turnwright::service
