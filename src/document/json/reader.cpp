#include "reader.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/say.hpp"
#include "pointer.hpp"

namespace turnwright::document {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kShownEntries = 4;  // of a list, written out up to so many
constexpr std::size_t kShown = 60;        // characters of a value that a message repeats

bool structured(const nlohmann::json& value) { return value.is_structured(); }

std::string with_unit(std::string text, std::string_view unit) {
  return unit.empty() ? text : text.append(" ").append(unit);
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto word = '"' + words[i] + '"';
    if (i == 0)
      out = word;
    else if (i + 1 == words.size())
      out = say("{} or {}", out, word);
    else
      out += ", " + word;
  }
  return out;
}

std::string expected_integer(long lower, long upper, std::string_view unit) {
  return with_unit(say("a whole number from {} to {}", lower, upper), unit);
}

std::string entries(std::size_t n) {
  return n == 1 ? tr("1 entry") : say("{} entries", n);
}

std::string expected_array(std::size_t min, std::size_t max) {
  return min == max ? say("a list of {}", entries(max))
                    : say("a list of {} to {}", min, entries(max));
}

std::string expected_text(std::size_t max) { return say("a text of 1 to {} bytes", max); }

// Levenshtein distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// What is too small for its squares and quotients to be numbers is 0, and so is a length
// that no shape has.
double size_of(double x, const Bounds& bounds) {
  constexpr double kLeast = 1e-100, kLeast_mm = 1e-9;
  if (!(bounds.lower >= 0)) return x;
  const bool length = bounds.unit == "mm" && bounds.lower_open;
  return x < (length ? kLeast_mm : kLeast) ? std::min(x, 0.0) : x;
}

}  // namespace

void Problems::add(Problem problem) {
  if (list.size() < kListed)
    list.push_back(std::move(problem));
  else
    ++more;
}

void Problems::throw_if_any() const {
  if (list.empty()) return;
  auto told = list;
  if (more > 0) told.push_back({"", say("{} more problems", more), tr("none"), "more"});
  throw InputError(document, told);
}

Bounds above(double lower, std::string unit) {
  return {.lower = lower, .lower_open = true, .unit = std::move(unit)};
}
Bounds at_least(double lower, std::string unit) {
  return {.lower = lower, .unit = std::move(unit)};
}
Bounds within(double lower, double upper, std::string unit) {
  return {.lower = lower, .upper = upper, .unit = std::move(unit)};
}
Bounds above_up_to(double lower, double upper, std::string unit) {
  return {.lower = lower, .upper = upper, .lower_open = true, .unit = std::move(unit)};
}
Bounds at_least_below(double lower, double upper, std::string unit) {
  return {.lower = lower, .upper = upper, .upper_open = true, .unit = std::move(unit)};
}
Bounds any_number(std::string unit) { return {.unit = std::move(unit)}; }

bool contains(const Bounds& b, double x) {
  return std::isfinite(x) && (b.lower_open ? x > b.lower : x >= b.lower) &&
         (b.upper_open ? x < b.upper : x <= b.upper);
}

std::string expected_number(const Bounds& b) {
  const bool low = std::isfinite(b.lower), high = std::isfinite(b.upper);
  const auto unit = translated(b.unit);
  if (!low && !high) return unit.empty() ? tr("a number") : say("a number in {}", unit);
  const auto lower = number_text(b.lower), upper = number_text(b.upper);
  const char* const above = b.lower_open ? ">" : ">=";
  const char* const below = b.upper_open ? "<" : "<=";
  if (low && high && !b.lower_open && !b.upper_open)
    return with_unit(say("a number from {} to {}", lower, upper), unit);
  if (low && high)
    return with_unit(say("a number {} {} and {} {}", above, lower, below, upper), unit);
  return with_unit(say("a number {} {}", low ? above : below, low ? lower : upper), unit);
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : known) {
    const auto [shorter, longer] = std::minmax({word.size(), candidate.size()});
    if (longer - shorter >= fewest) continue;  // as many edits at least
    const std::size_t n = edits(word, candidate);
    if (n >= fewest || n >= candidate.size()) continue;
    fewest = n;
    best = candidate;
  }
  return best;
}

std::string did_you_mean(std::string_view expected, std::string_view near) {
  return say("{} (did you mean \"{}\"?)", expected, near);
}

std::string number_text(double x) {
  const std::string s = nlohmann::json(x).dump();
  return s.ends_with(".0") ? s.substr(0, s.size() - 2) : s;
}

std::string shown(const nlohmann::json& value) {
  if (value.is_object()) return tr("an object");
  if (value.is_array() && value.empty()) return tr("an empty list");
  const bool nested =
      value.is_array() && std::any_of(value.begin(), value.end(), structured);
  if (nested || value.size() > kShownEntries)
    return say("a list of {}", entries(value.size()));
  // In ASCII, which may be cut anywhere; a text may be a part that ends within a letter.
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > kShown) text = text.substr(0, kShown) + "...";
  return text;
}

Reader::Reader(const nlohmann::json& value, Problems& problems, std::string pointer)
    : Reader(&value, &problems, std::move(pointer)) {}

const nlohmann::json& Reader::json() const {
  static const nlohmann::json null;
  return value_ ? *value_ : null;
}

void Reader::problem(std::string expected, std::string code) const {
  problem(shown(json()), std::move(expected), std::move(code));
}

void Reader::problem(std::string got, std::string expected, std::string code) const {
  problems_->add({pointer_, std::move(got), std::move(expected), std::move(code)});
}

void Reader::problem_at(std::string_view key, std::string expected,
                        std::string code) const {
  const bool there = is_object() && value_->contains(key);
  problems_->add({pointer_of(key),
                  there ? shown((*value_)[std::string(key)]) : tr("nothing"),
                  std::move(expected), std::move(code)});
}

std::string Reader::pointer_of(std::string_view key) const {
  return child_pointer(pointer_, key);
}

double Reader::as_number(const Bounds& bounds) const {
  if (broken()) return kNaN;
  if (!value_->is_number()) {
    problem(expected_number(bounds), "type");
    return kNaN;
  }
  const double x = size_of(value_->get<double>(), bounds);
  if (!contains(bounds, x)) {
    problem(expected_number(bounds), "range");
    return kNaN;
  }
  return x;
}

long Reader::as_integer(long lower, long upper, std::string_view unit) const {
  if (broken()) return lower;
  if (!value_->is_number_integer()) {
    problem(expected_integer(lower, upper, unit), "type");
    return lower;
  }
  // get<long>() would wrap an unsigned value beyond 2^63.
  const bool wraps = value_->is_number_unsigned() &&
                     value_->get<unsigned long>() >
                         static_cast<unsigned long>(std::numeric_limits<long>::max());
  const long x = wraps ? std::numeric_limits<long>::max() : value_->get<long>();
  if (wraps || x < lower || x > upper) {
    problem(expected_integer(lower, upper, unit), "range");
    return lower;
  }
  return x;
}

bool Reader::as_boolean() const {
  if (broken()) return false;
  if (!value_->is_boolean()) {
    problem(tr("true or false"), "type");
    return false;
  }
  return value_->get<bool>();
}

std::string Reader::as_text(std::size_t max) const {
  if (broken()) return "";
  if (!value_->is_string()) {
    problem(expected_text(max), "type");
    return "";
  }
  const auto& text = value_->get_ref<const std::string&>();
  if (text.empty() || text.size() > max) {
    problem(expected_text(max), "range");
    return "";
  }
  return text;
}

std::size_t Reader::as_choice(const std::vector<std::string>& choices) const {
  if (broken()) return 0;
  if (!value_->is_string()) {
    problem(quoted_list(choices), "type");
    return 0;
  }
  const auto& word = value_->get_ref<const std::string&>();
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found == choices.end()) {
    const std::string near = nearest(word, choices);
    const bool long_list = choices.size() > 3;
    const auto expected = quoted_list(choices);
    problem(!near.empty() && long_list ? did_you_mean(expected, near) : expected,
            "choice");
    return 0;
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<Reader> Reader::as_items(std::size_t min, std::size_t max) const {
  if (broken()) return {};
  if (!value_->is_array()) {
    problem(expected_array(min, max), "type");
    return {};
  }
  if (value_->size() < min || value_->size() > max) {
    problem(expected_array(min, max), "range");
    return {};
  }
  std::vector<Reader> out;
  for (std::size_t i = 0; i < value_->size(); ++i)
    out.emplace_back((*value_)[i], *problems_, pointer_of(std::to_string(i)));
  return out;
}

std::vector<double> Reader::as_numbers(const Bounds& bounds, std::size_t min,
                                       std::size_t max) const {
  std::vector<double> out;
  for (const auto& item : as_items(min, max)) out.push_back(item.as_number(bounds));
  return out;
}

Reader Reader::as_object() const {
  if (broken() || is_object()) return *this;
  problem(tr("an object"), "type");
  return {nullptr, problems_, pointer_};
}

bool Reader::has(std::string_view key) {
  asked_.emplace_back(key);
  return is_object() && value_->contains(key);
}

std::optional<Reader> Reader::find(std::string_view key) {
  if (!has(key)) return std::nullopt;
  return Reader(&(*value_)[std::string(key)], problems_, pointer_of(key));
}

template <class Expected>
Reader Reader::member(std::string_view key, const Expected& expected) {
  if (auto found = find(key)) return *found;
  if (!broken()) problem_at(key, expected(), "missing");
  return {nullptr, problems_, pointer_of(key)};
}

Reader Reader::at(std::string_view key) {
  return member(key, [] { return tr("a value"); });
}

Reader Reader::at(std::string_view key, std::string_view expected) {
  return member(key, [&] { return std::string(expected); });
}

double Reader::number(std::string_view key, const Bounds& bounds) {
  return member(key, [&] { return expected_number(bounds); }).as_number(bounds);
}

std::optional<double> Reader::optional_number(std::string_view key,
                                              const Bounds& bounds) {
  const auto found = find(key);
  return found ? std::optional(found->as_number(bounds)) : std::nullopt;
}

double Reader::number_or(std::string_view key, const Bounds& bounds, double fallback) {
  return optional_number(key, bounds).value_or(fallback);
}

long Reader::integer(std::string_view key, long lower, long upper,
                     std::string_view unit) {
  return member(key, [&] { return expected_integer(lower, upper, unit); })
      .as_integer(lower, upper, unit);
}

std::optional<long> Reader::optional_integer(std::string_view key, long lower, long upper,
                                             std::string_view unit) {
  const auto found = find(key);
  return found ? std::optional(found->as_integer(lower, upper, unit)) : std::nullopt;
}

long Reader::integer_or(std::string_view key, long lower, long upper, long fallback,
                        std::string_view unit) {
  return optional_integer(key, lower, upper, unit).value_or(fallback);
}

bool Reader::boolean(std::string_view key) {
  return member(key, [] { return tr("true or false"); }).as_boolean();
}

bool Reader::boolean_or(std::string_view key, bool fallback) {
  const auto found = find(key);
  return found ? found->as_boolean() : fallback;
}

std::string Reader::text(std::string_view key, std::size_t max) {
  return member(key, [&] { return expected_text(max); }).as_text(max);
}

std::optional<std::string> Reader::optional_text(std::string_view key, std::size_t max) {
  const auto found = find(key);
  return found ? std::optional(found->as_text(max)) : std::nullopt;
}

std::string Reader::text_or(std::string_view key, std::string fallback, std::size_t max) {
  return optional_text(key, max).value_or(std::move(fallback));
}

std::size_t Reader::choice_index(std::string_view key,
                                 const std::vector<std::string>& choices) {
  return member(key, [&] { return quoted_list(choices); }).as_choice(choices);
}

Reader Reader::object(std::string_view key) {
  return member(key, [] { return tr("an object"); }).as_object();
}

std::optional<Reader> Reader::optional_object(std::string_view key) {
  const auto found = find(key);
  return found ? std::optional(found->as_object()) : std::nullopt;
}

std::vector<Reader> Reader::items(std::string_view key, std::size_t min,
                                  std::size_t max) {
  return member(key, [&] { return expected_array(min, max); }).as_items(min, max);
}

std::vector<Reader> Reader::optional_items(std::string_view key, std::size_t min,
                                           std::size_t max) {
  const auto found = find(key);
  return found ? found->as_items(min, max) : std::vector<Reader>{};
}

std::vector<double> Reader::numbers(std::string_view key, const Bounds& bounds,
                                    std::size_t min, std::size_t max) {
  return member(key, [&] { return expected_array(min, max); })
      .as_numbers(bounds, min, max);
}

void Reader::finish() const {
  if (!is_object()) return;
  for (const auto& [key, value] : value_->items()) {
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    const bool listed = problems_->list.size() < Problems::kListed;
    const std::string near = listed ? nearest(key, asked_) : "";
    const auto expected = tr("no such key");
    problem_at(key, near.empty() ? expected : did_you_mean(expected, near),
               "unknown-key");
  }
}

}  // namespace turnwright::document
