#pragma once
#include "notation_words.hpp"
#include "turnwright/part/inch_thread.hpp"

/// Threads as texts name them.
namespace turnwright::exchange::notated {

struct Thread {
  double d_mm = 0, pitch_mm = 0;  ///< 0: the coarse pitch of ISO 261
  std::string tolerance_class = {};
};

/// "6g", "4g6g", "6H"; "2A", "3B" of inch threads.
bool is_thread_class(Word word);

/// The whole text as a thread: "M24x1.5-6g", "M24 6g", "1/2-13 UNC-2A".
std::optional<Thread> thread(Word text);

/// The inch thread that begins with word `next`, as many words as belong to it; `next` is
/// then behind it.
std::optional<part::InchThread> take_inch_thread(const std::vector<Word>& words,
                                                 std::size_t& next);

}  // namespace turnwright::exchange::notated
