#pragma once
#include <exception>
#include <stop_token>
#include <utility>

namespace turnwright {

/// Nobody waits for the answer any more.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// To be called between pieces of long work.  @throws Cancelled if `stop` was asked for.
inline void leave_if(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

/// While it lives, long work of this thread listens to `stop`, which must outlive it: the
/// loops of a search look there by leave_if_asked() and need not be handed the token.
/// Nothing that is computed depends on it.
class Listening {
 public:
  explicit Listening(const std::stop_token& stop)
      : before_(std::exchange(heard(), &stop)) {}
  ~Listening() { heard() = before_; }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  /// What this thread listens to, if anything.
  static const std::stop_token*& heard() {
    thread_local const std::stop_token* stop = nullptr;
    return stop;
  }

 private:
  const std::stop_token* before_;
};

/// @throws Cancelled if this thread listens to a stop that was asked for.
inline void leave_if_asked() {
  if (const auto* stop = Listening::heard()) leave_if(*stop);
}

}  // namespace turnwright
