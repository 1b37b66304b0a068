#pragma once
#include <string_view>

/// Who is asked, and on whose behalf.
namespace turnwright::service {

/// A letter or digit of ASCII, "-", "." or "_".
bool is_of_name(char c);

/// Whether this is a host, with or without a port, or nothing: a name of letters, digits,
/// "-", "." and "_", an IPv4 address, an IPv6 address in brackets.
bool is_host(std::string_view host);

/// Whether the value of a Host header is an IP address or a name without a dot, with or
/// without a port.  What a page of some site has a browser send to this machine, by a
/// name made to lead here (DNS rebinding), has a dotted one.
bool is_local(std::string_view host);

/// Whether an Origin header's value, "http://name:port", has this Host.
bool origin_is(std::string_view origin, std::string_view host);

}  // namespace turnwright::service
