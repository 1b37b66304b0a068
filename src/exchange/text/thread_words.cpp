#include "thread_words.hpp"

namespace turnwright::exchange::notated {
namespace {

bool is_one_of(char c, std::string_view set) {
  return set.find(c) != std::string_view::npos;
}

}  // namespace

bool is_thread_class(Word word) {
  const bool inch =
      word.size() == 2 && is_one_of(word[0], "123") && is_one_of(word[1], "AB");
  if (inch) return true;
  if (word.size() != 2 && word.size() != 4) return false;
  for (std::size_t i = 0; i < word.size(); i += 2)
    if (!is_one_of(word[i], "3456789") || !is_one_of(word[i + 1], "abcdefghABCDEFGH"))
      return false;
  return true;
}

std::optional<Thread> thread(Word text) {
  if (const auto inch = part::inch_thread(text))
    return Thread{inch->d_mm, inch->pitch_mm, inch->tolerance_class};
  if (!take(text, {"m"})) return std::nullopt;
  const auto d = take_number(text);
  if (!d || !(*d > 0)) return std::nullopt;
  Thread t{.d_mm = *d};
  text = trimmed(text);
  if (take(text, {"x", "×"})) {
    const auto pitch = take_number(text);
    if (!pitch || !(*pitch > 0)) return std::nullopt;
    t.pitch_mm = *pitch;
  }
  text = trimmed(text);
  take(text, {"-"});
  if (!text.empty() && !is_thread_class(text)) return std::nullopt;
  t.tolerance_class = std::string(text);
  return t;
}

std::optional<part::InchThread> take_inch_thread(const std::vector<Word>& words,
                                                 std::size_t& next) {
  constexpr std::size_t kMost = 3;  // size, series, class
  for (std::size_t n = std::min(kMost, words.size() - next); n > 0; --n) {
    const Word first = words[next], last = words[next + n - 1];
    const auto length =
        static_cast<std::size_t>(last.data() - first.data()) + last.size();
    if (const auto found = part::inch_thread({first.data(), length})) {
      next += n;
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace turnwright::exchange::notated
