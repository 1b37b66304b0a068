#pragma once
#include <optional>

#include "state.hpp"

/// What the header of a call says about it, before anything is computed.
namespace turnwright::service {

/// The body is read apart, by Framing.
using HeaderParser = http::request_parser<http::empty_body>;

/// The call as far as its header determines it, with the caller's own id if it has one.
Call call_of(const HeaderParser& parser, ServerState& state);

/// The refusal of an ambiguous request (RFC 9112, 3.2 and 6.1), of one with too many
/// fields or of one that a page of another origin made a browser send; none for other
/// requests.
std::optional<Reply> objection(const ServerState& state, const HeaderParser& parser,
                               const Call& call);

/// Answers a refused call without reading a large body.  Only its header has been read,
/// so a client without a key cannot fill the memory.
std::optional<Reply> refused_unread(const ServerState& state, const HeaderParser& parser,
                                    const Call& call);

/// The answer to a call that could not be read; none if the client has gone.
std::optional<Reply> refusal(const beast::error_code& ec, const Call& call);

/// The answer to calls that need no computing and must be answered while the pool is
/// busy.
std::optional<Reply> at_once(const ServerState& state, const Call& call);

/// 503 with Retry-After.
Reply busy(const char* detail, const Call& call);

}  // namespace turnwright::service
