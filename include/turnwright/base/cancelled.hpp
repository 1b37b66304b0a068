#pragma once
#include <exception>
#include <stop_token>
#include <utility>

namespace turnwright {

/// Thrown to end a computation whose answer nobody waits for any more.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// Cancellation point, to be called between pieces of long work.
/// @throws Cancelled if a stop was requested.
inline void leave_if(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Cancelled();
}

/// While an object of this class lives, long work of its thread can be stopped by `stop`,
/// which must outlive the object.  The loops of a search call leave_if_asked(), so the
/// token need not be passed through every function.  No computed value depends on it.
class Listening {
 public:
  explicit Listening(const std::stop_token& stop)
      : before_(std::exchange(heard(), &stop)) {}
  ~Listening() { heard() = before_; }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  /// The token of this thread; null if it has none.
  static const std::stop_token*& heard() {
    thread_local const std::stop_token* stop = nullptr;
    return stop;
  }

 private:
  const std::stop_token* before_;
};

/// Cancellation point for a thread that has a Listening object.
/// @throws Cancelled if its stop was requested.
inline void leave_if_asked() {
  if (const auto* stop = Listening::heard()) leave_if(*stop);
}

}  // namespace turnwright
