#pragma once
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "turnwright/base/errors.hpp"

/// Reads a JSON document and collects all its errors, so that one run shows them all.
/// Use:
///
///     Problems problems{.document = "part.json"};
///     Reader r(json, problems);
///     part.length_mm = r.number("length_mm", above(0, "mm"));
///     r.finish();                // refuses keys that were not read
///     problems.throw_if_any();
///
/// A value that cannot be read is reported once and replaced by a harmless placeholder
/// (NaN, 0, "", the first choice); throw_if_any() prevents placeholders from leaving the
/// loader. Cross-checks are therefore written so that NaN reports nothing: `if (a >= b)
/// r.problem(...)`.
namespace turnwright::document {

/// All errors of one document in the order in which they are found.  After kListed of
/// them they are only counted, so that a hostile document does not cause an endless
/// answer.
struct Problems {
  static constexpr std::size_t kListed = 100;
  std::string document;
  std::vector<Problem> list = {};
  std::size_t more = 0;
  void add(Problem problem);
  /// @throws InputError with the whole list, if there is one.
  void throw_if_any() const;
};

/// The permitted range of a number, and its unit.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false, upper_open = false;
  std::string unit = "";
};
Bounds above(double lower, std::string unit = "");                 ///< x > lower
Bounds at_least(double lower, std::string unit = "");              ///< x >= lower
Bounds within(double lower, double upper, std::string unit = "");  ///< [lower, upper]
Bounds above_up_to(double lower, double upper,
                   std::string unit = "");  ///< (lower, upper]
Bounds at_least_below(double lower, double upper,
                      std::string unit = "");  ///< [lower, upper)
Bounds any_number(std::string unit = "");

bool contains(const Bounds& bounds, double x);      ///< false for NaN
std::string expected_number(const Bounds& bounds);  ///< "a number > 0 and <= 20 mm"

template <class E>
using Choices = std::vector<std::pair<std::string_view, E>>;

/// The word of `known` that `word` most likely misspells; "" if none is similar.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// What is expected, with such a word: "a face (did you mean "left"?)".
std::string did_you_mean(std::string_view expected, std::string_view near);

/// A number as on a drawing: 20 instead of 20.0, otherwise with all its digits.
std::string number_text(double x);
inline std::string mm_text(double mm) { return number_text(mm) + " mm"; }

/// A value as a problem shows it: numbers, short strings and short
/// lists as written, "an object", "a list of 5 entries".
std::string shown(const nlohmann::json& value);

/// One value of the document with its JSON pointer.  Does not own the JSON nor the
/// problems; both must outlive it.
class Reader {
 public:
  /// @param pointer  pointer of `value`; "" for the root.
  Reader(const nlohmann::json& value, Problems& problems, std::string pointer = "");

  // The value itself.
  double as_number(const Bounds& bounds) const;
  long as_integer(long lower, long upper, std::string_view unit = "") const;
  bool as_boolean() const;
  /// Not empty and at most `max` bytes.
  std::string as_text(std::size_t max = 200) const;
  std::size_t as_choice(const std::vector<std::string>& choices) const;
  /// Its elements, `min` to `max` of them.
  std::vector<Reader> as_items(std::size_t min, std::size_t max) const;
  std::vector<double> as_numbers(const Bounds& bounds, std::size_t min,
                                 std::size_t max) const;
  /// The same value, which must be an object.
  Reader as_object() const;

  bool is_text() const { return value_ && value_->is_string(); }
  bool is_object() const { return value_ && value_->is_object(); }
  bool is_array() const { return value_ && value_->is_array(); }
  bool is_number() const { return value_ && value_->is_number(); }
  /// Whether the value is missing or of the wrong type, which has then been reported.
  bool broken() const { return value_ == nullptr; }

  // Members; every key that is read counts as known to finish().
  bool has(std::string_view key);
  /// A required member.  If it is missing this is reported with `expected`, and the
  /// reader returned is broken.
  Reader at(std::string_view key, std::string_view expected);
  Reader at(std::string_view key);
  std::optional<Reader> find(std::string_view key);

  double number(std::string_view key, const Bounds& bounds);
  std::optional<double> optional_number(std::string_view key, const Bounds& bounds);
  double number_or(std::string_view key, const Bounds& bounds, double fallback);

  long integer(std::string_view key, long lower, long upper, std::string_view unit = "");
  std::optional<long> optional_integer(std::string_view key, long lower, long upper,
                                       std::string_view unit = "");
  long integer_or(std::string_view key, long lower, long upper, long fallback,
                  std::string_view unit = "");

  bool boolean(std::string_view key);
  bool boolean_or(std::string_view key, bool fallback);

  std::string text(std::string_view key, std::size_t max = 200);
  std::optional<std::string> optional_text(std::string_view key, std::size_t max = 200);
  std::string text_or(std::string_view key, std::string fallback, std::size_t max = 200);

  template <class E>
  E choice(std::string_view key, const Choices<E>& choices) {
    return choices[choice_index(key, words(choices))].second;
  }
  template <class E>
  std::optional<E> optional_choice(std::string_view key, const Choices<E>& choices) {
    if (!has(key)) return std::nullopt;
    return choice(key, choices);
  }
  template <class E>
  E choice_or(std::string_view key, const Choices<E>& choices, E fallback) {
    return has(key) ? choice(key, choices) : fallback;
  }

  Reader object(std::string_view key);
  std::optional<Reader> optional_object(std::string_view key);
  std::vector<Reader> items(std::string_view key, std::size_t min, std::size_t max);
  /// No elements if the key is absent.
  std::vector<Reader> optional_items(std::string_view key, std::size_t min,
                                     std::size_t max);
  std::vector<double> numbers(std::string_view key, const Bounds& bounds, std::size_t min,
                              std::size_t max);

  /// Reports every member that was not read, with the most similar known key.
  void finish() const;

  /// Reports the value itself, or its member `key`; `got` is the value as written unless
  /// given.
  void problem(std::string expected, std::string code) const;
  void problem(std::string got, std::string expected, std::string code) const;
  void problem_at(std::string_view key, std::string expected, std::string code) const;

  const std::string& pointer() const { return pointer_; }
  std::string pointer_of(std::string_view key) const;
  const nlohmann::json& json() const;  ///< null if broken
  Problems& problems() const { return *problems_; }

 private:
  Reader(const nlohmann::json* value, Problems* problems, std::string pointer)
      : value_(value), problems_(problems), pointer_(std::move(pointer)) {}
  template <class Expected>
  Reader member(std::string_view key, const Expected& expected);
  std::size_t choice_index(std::string_view key, const std::vector<std::string>& words);
  template <class E>
  static std::vector<std::string> words(const Choices<E>& choices) {
    std::vector<std::string> out;
    for (const auto& [word, value] : choices) out.emplace_back(word);
    return out;
  }

  const nlohmann::json* value_;
  Problems* problems_;
  std::string pointer_;
  std::vector<std::string> asked_;
};

}  // namespace turnwright::document
