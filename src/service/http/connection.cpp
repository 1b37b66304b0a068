#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <ctime>
#include <optional>

#include "alarm.hpp"
#include "arrival.hpp"
#include "base/say.hpp"
#include "call_log.hpp"
#include "refusal.hpp"
#include "service/log.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::service {
namespace {

using beast::error_code;
using Clock = std::chrono::steady_clock;

/// Date header's form (RFC 9110, 5.6.7), English in any locale.
std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  static constexpr std::array kDays = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr std::array kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                         "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return fmt::format("{}, {:02} {} {:04} {:02}:{:02}:{:02} GMT",
                     kDays[static_cast<std::size_t>(utc.tm_wday)], utc.tm_mday,
                     kMonths[static_cast<std::size_t>(utc.tm_mon)], utc.tm_year + 1900,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

asio::awaitable<bool> write(ServerState& state, Connection& connection, const Call& call,
                            Reply reply, bool keep_alive) {
  http::response<http::string_body> message;
  message.version(11);
  message.result(static_cast<unsigned>(reply.status));
  message.reason(
      beast::string_view(reason(reply.status).data(), reason(reply.status).size()));
  message.set(http::field::date, date());
  message.set("X-Request-Id", call.request_id);
  message.set("X-Content-Type-Options", "nosniff");
  if (!reply.content_type.empty())
    message.set(http::field::content_type, reply.content_type);
  for (const auto& [name, value] : reply.headers) message.set(name, value);
  message.keep_alive(keep_alive);
  if (reply.status != 204) message.content_length(reply.body.size());
  if (call.method != "HEAD") message.body() = std::move(reply.body);
  http::response_serializer<http::string_body> serializer(message);
  const Alarm alarm(connection.socket, state.options.writing);
  error_code ec;
  co_await http::async_write(connection.socket, serializer, into(ec));
  co_return !ec;
}

/// Lets the client read the last answer before the connection is reset: bytes that it
/// still sends are read and dropped for a limited time.
asio::awaitable<void> close(Connection& connection) {
  constexpr auto kPatience = std::chrono::seconds(2);
  constexpr std::size_t kDropped = 4'000'000;
  error_code ec;
  connection.socket.shutdown(tcp::socket::shutdown_send, ec);
  const Alarm alarm(connection.socket, kPatience);
  std::vector<char> sink(65'536);
  for (std::size_t dropped = 0; !ec && dropped < kDropped;)
    dropped += co_await connection.socket.async_read_some(asio::buffer(sink), into(ec));
  connection.socket.close(ec);
}

/// A call on its way through the pool.
struct Pending {
  Pending(ServerState& state, Call given, std::unique_ptr<Intake> arrived)
      : done(state.io),
        call(std::move(given)),
        body(std::move(arrived)),
        share(state.memory) {}
  asio::steady_timer done;  ///< cancelled when the answer is ready or the client has gone
  Call call;
  std::unique_ptr<Intake> body;
  Reply reply;          ///< of the pool until it is ready
  Budget::Share share;  ///< of the answer, until it is written
  std::stop_source stop;
  bool ready = false;
  bool gone = false;  ///< the client left
};

/// The answer to a fault of this program, which must be possible without free memory.
Reply fault(const Call& call, const char* what) {
  try {
    log_fault(call, what);
    return problem(500, "fault", tr("a fault of this program; the log has more"), call);
  } catch (const std::exception&) {
    return {500, "", "", {}};
  }
}

/// Does not throw, because nothing catches exceptions of the pool's threads.
Reply answer(const HttpApi& api, const Call& call, const std::stop_token& stop) {
  try {
    leave_if(stop);
    Reply reply = api.reply(call, stop);
    compress_for(call, reply);
    return reply;
  } catch (const Cancelled&) {
    return {};  // nobody reads it
  } catch (const std::exception& error) {
    return fault(call, error.what());
  }
}

/// Answers a call in the pool.  Its body is freed, and the answer counted in its place.
void compute(const HttpApi& api, Pending& pending) {
  auto& reply = pending.reply;
  reply = answer(api, pending.call, pending.stop.get_token());
  pending.call.body = {};
  pending.call.lines.reset();
  pending.body.reset();
  if (pending.share.resize(reply.body.size())) return;
  reply = {503, "", "", {}};
  try {
    reply = busy(to_translate("other answers fill the memory for them (--body-memory)"),
                 pending.call);
  } catch (const std::bad_alloc&) {  // the short answer will do
  }
}

/// Posts to the thread that reads and writes, from the pool, whose threads must not end:
/// waits for memory if there is none.
template <class Work>
void post_surely(asio::io_context& io, const Work& work) {
  for (;;) try {
      return asio::post(io, work);
    } catch (const std::bad_alloc&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

void watch(tcp::socket& socket, const std::shared_ptr<Pending>& pending) {
  socket.async_wait(tcp::socket::wait_read,
                    [pending, fd = socket.native_handle()](error_code ec) {
                      char byte = 0;
                      if (ec || ::recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0) return;
                      pending->gone = true;
                      pending->stop.request_stop();
                      pending->done.cancel();
                    });
}

void count_waiting(ServerState& state, int change) {
  state.waiting += static_cast<std::size_t>(change);
  state.metrics.waiting.Increment(change);
}

void start(ServerState& state, const std::shared_ptr<Pending>& pending) {
  count_waiting(state, 1);
  try {
    asio::post(state.pool, [&state, pending] {
      compute(state.api, *pending);
      post_surely(state.io, [&state, pending] {
        count_waiting(state, -1);
        pending->ready = true;
        pending->done.cancel();
      });
    });
  } catch (...) {
    count_waiting(state, -1);
    throw;
  }
}

/// The answer from the pool; none if the client left.
asio::awaitable<std::optional<Reply>> computed(ServerState& state, Connection& connection,
                                               std::shared_ptr<Pending> pending) {
  start(state, pending);
  watch(connection.socket, pending);
  pending->done.expires_after(state.options.deadline);
  error_code ec;
  if (!pending->ready) co_await pending->done.async_wait(into(ec));
  connection.socket.cancel(ec);
  if (pending->gone) co_return std::nullopt;
  if (pending->ready) co_return std::move(pending->reply);
  pending->stop.request_stop();
  co_return problem(
      504, "deadline",
      say("not done within {} ms; send it as a batch", state.options.deadline.count()),
      pending->call);
}

/// The call as it is computed, with its body.
std::shared_ptr<Pending> pending_of(ServerState& state, Arrived& arrived) {
  auto pending = std::make_shared<Pending>(state, arrived.call, std::move(arrived.body));
  pending->call.body = std::move(pending->body->text);
  pending->call.lines = pending->body->spool();
  return pending;
}

/// One call.  @return whether the connection may carry another.
asio::awaitable<bool> serve_call(ServerState& state, Connection& connection) {
  auto arrived = co_await read_call(state, connection);
  const auto& call = arrived.call;
  const auto begin = Clock::now();
  std::shared_ptr<Pending> pending;  // counts its answer until that is written
  std::optional<Reply> reply =
      arrived.ec ? refusal(arrived.ec, call) : std::move(arrived.refused);
  if (arrived.ec && !reply) co_return false;
  if (!reply && !(reply = at_once(state, call))) {
    pending = pending_of(state, arrived);
    reply = co_await computed(state, connection, pending);
  }
  arrived.body.reset();
  const bool keep_alive =
      arrived.keep_alive && (!state.draining || has_arrived(connection));
  const int status = reply ? reply->status : 499;
  const std::size_t bytes = reply ? reply->body.size() : 0;
  bool written = false;
  if (reply)
    written = co_await write(state, connection, call, std::move(*reply), keep_alive);
  const std::chrono::duration<double> took = Clock::now() - begin;
  state.metrics.answered(state.api.route(call), status, took.count());
  log_call(call, status, bytes, took.count());
  const bool again = written && keep_alive;
  if (written && !again) co_await close(connection);
  co_return again;
}

/// A connection among those of the server, as long as it lives.
class Listed {
 public:
  Listed(ServerState& state, Connection& connection)
      : state_(state), connection_(connection) {
    state_.connections.insert(&connection_);
    state_.metrics.connections.Increment();
  }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;
  ~Listed() {
    state_.connections.erase(&connection_);
    state_.metrics.connections.Decrement();
    if (state_.draining && state_.connections.empty()) state_.drain.cancel();
  }

 private:
  ServerState& state_;
  Connection& connection_;
};

/// Nothing that happens to a connection may end the thread that serves all of them.
void note_lost(const std::exception& error) {
  try {
    log_event("connection lost", error.what());
  } catch (const std::exception&) {  // no memory even for this
  }
}

}  // namespace

asio::awaitable<void> serve(ServerState& state, tcp::socket socket) {
  try {
    Connection connection(std::move(socket));
    const Listed listed(state, connection);
    error_code ec;
    connection.socket.set_option(tcp::no_delay(true), ec);
    bool more = true;
    while (more) {
      more = co_await next_call(state, connection);
      if (more) more = co_await serve_call(state, connection);
    }
  } catch (const std::exception& error) {
    note_lost(error);
  }
}

asio::awaitable<void> turn_away(ServerState& state, tcp::socket socket) {
  try {
    Connection connection(std::move(socket));
    const Call nobody;
    if (co_await write(state, connection, nobody,
                       busy(to_translate("too many connections"), nobody), false))
      co_await close(connection);
  } catch (const std::exception& error) {
    note_lost(error);
  }
}

}  // namespace turnwright::service
