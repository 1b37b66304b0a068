#include "arrival.hpp"

#include "alarm.hpp"
#include "framing.hpp"
#include "refusal.hpp"
#include "reserve.hpp"
#include "service/log.hpp"
#include "service/output.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

using beast::error_code;

/// Reads some bytes more.
asio::awaitable<error_code> fill(Connection& connection) {
  constexpr std::size_t kPiece = 16'384;
  const auto room = connection.buffer.prepare(kPiece);
  error_code ec;
  const auto bytes = co_await connection.socket.async_read_some(room, into(ec));
  connection.buffer.commit(bytes);
  co_return ec;
}

std::string_view seen(const Connection& connection) {
  const auto bytes = connection.buffer.data();
  return {static_cast<const char*>(bytes.data()), bytes.size()};
}

Framing framing_of(const ServerState& state, const HeaderParser& parser,
                   const Call& call) {
  if (parser.chunked())
    return Framing::of_chunks(HttpApi::body_limit(call), state.options.header_bytes);
  const auto length = parser.content_length();
  return Framing::of_length(length ? *length : 0);
}

error_code error_of(Framing::State state) {
  switch (state) {
    case Framing::State::wrong:
      return http::error::bad_chunk;
    case Framing::State::too_large:
      return http::error::body_limit;
    case Framing::State::too_long:
      return http::error::header_limit;
    case Framing::State::more:
    case Framing::State::done:
      break;
  }
  return {};
}

asio::awaitable<error_code> allow_body(Connection& connection) {
  constexpr char kGo[] = "HTTP/1.1 100 Continue\r\n\r\n";
  error_code ec;
  co_await asio::async_write(connection.socket, asio::buffer(kGo, sizeof kGo - 1),
                             into(ec));
  co_return ec;
}

asio::awaitable<error_code> read_pieces(Connection& connection, Framing framing,
                                        Intake& body) {
  error_code ec;
  for (;;) {
    const auto piece = framing.next(seen(connection));
    ec = body.take(piece.content);
    connection.buffer.consume(piece.taken);
    if (!ec) ec = error_of(framing.state());
    if (ec || framing.state() == Framing::State::done) co_return ec;
    if (connection.buffer.size() == 0) ec = co_await fill(connection);
    if (ec) co_return ec;
  }
}

/// Reads the rest of a call whose header has been read.
asio::awaitable<error_code> read_call_body(ServerState& state, Connection& connection,
                                           const HeaderParser& parser, const Call& call,
                                           Intake& body) {
  const Alarm alarm(connection.socket, state.options.body);
  const auto length = parser.content_length();
  error_code ec;
  if (!body.spool() && length && !state.memory.has_room(*length))
    co_return boost::system::errc::make_error_code(
        boost::system::errc::not_enough_memory);
  if (parser.get().version() >= 11 &&
      beast::iequals(parser.get()[http::field::expect], "100-continue"))
    ec = co_await allow_body(connection);
  if (!ec) ec = co_await read_pieces(connection, framing_of(state, parser, call), body);
  co_return alarm.rang() ? error_code(beast::error::timeout) : ec;
}

asio::awaitable<error_code> read_call_header(const ServerState& state,
                                             Connection& connection,
                                             HeaderParser& parser) {
  parser.header_limit(static_cast<std::uint32_t>(state.options.header_bytes));
  parser.body_limit(UINT64_MAX);  // the path decides, which is not known yet
  const Alarm alarm(connection.socket, state.options.header);
  error_code ec;
  while (!ec && !parser.is_header_done()) {
    connection.buffer.consume(parser.put(connection.buffer.data(), ec));
    if (ec == http::error::need_more) ec = co_await fill(connection);
  }
  co_return alarm.rang() ? error_code(beast::error::timeout) : ec;
}

/// Where the body of a call is kept; null, with a note in the log, if no file can be
/// made.
std::unique_ptr<Intake> intake_of(ServerState& state, const Call& call) {
  try {
    auto spool = state.api.spool(call);
    auto& budget = spool ? state.disk : state.memory;
    return std::make_unique<Intake>(budget, std::move(spool));
  } catch (const OutputError& error) {
    log_event("batch refused", error.what());
    return nullptr;
  }
}

/// Drops empty lines before a call (RFC 9112, 2.2).  @return whether a byte of it is
/// there.
bool has_begun(Connection& connection) {
  while (seen(connection).starts_with("\r\n")) connection.buffer.consume(2);
  return !seen(connection).empty() && seen(connection) != "\r";
}

}  // namespace

asio::awaitable<Arrived> read_call(ServerState& state, Connection& connection) {
  HeaderParser parser;
  Arrived all;
  all.ec = co_await read_call_header(state, connection, parser);
  const Call& call = all.call = call_of(parser, state);
  if (!all.ec && parser.content_length() &&
      *parser.content_length() > HttpApi::body_limit(call))
    all.ec = http::error::body_limit;
  if (!all.ec && !MemoryReserve::refill())
    all.refused = busy(to_translate("too little memory"), call);
  if (!all.ec && !all.refused) all.refused = objection(state, parser, call);
  if (!all.ec && !all.refused) all.refused = refused_unread(state, parser, call);
  if (all.ec || all.refused) co_return all;
  if (!(all.body = intake_of(state, call)))
    all.ec =
        boost::system::errc::make_error_code(boost::system::errc::no_space_on_device);
  else
    all.ec = co_await read_call_body(state, connection, parser, call, *all.body);
  // A client of HTTP/1.0 would need a header that allows it to send more.
  all.keep_alive = !all.ec && parser.get().version() >= 11 && parser.get().keep_alive();
  co_return all;
}

bool has_arrived(const Connection& connection) {
  error_code ec;
  return connection.buffer.size() > 0 || connection.socket.available(ec) > 0;
}

asio::awaitable<bool> next_call(const ServerState& state, Connection& connection) {
  const Alarm alarm(connection.socket, state.options.idle);
  error_code ec;
  while (!has_begun(connection) && !state.draining && !ec && !alarm.rang()) {
    connection.idle = true;
    ec = co_await fill(connection);
    connection.idle = false;
  }
  co_return has_begun(connection) || (state.draining && has_arrived(connection));
}

}  // namespace turnwright::service
