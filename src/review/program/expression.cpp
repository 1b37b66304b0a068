#include "expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "letters.hpp"

namespace turnwright::review {
namespace {

constexpr int kDeepestBrackets = 50;     // brackets in brackets
constexpr double kAlike = 1e-4;          // of LinuxCNC's EQ
constexpr double kLargestResult = 1e12;  // of a result
constexpr double kDeg = std::numbers::pi / 180;

constexpr double kAlikeSiemens = 1e-12;  // of its comparisons, of the larger value

struct Operator {
  std::string_view name;
  std::array<int, 4> rank;  // of each language, 0: it has none
};
// Longer names before those that they begin with.
constexpr Operator kOperators[] = {
    {"**", {5, 0, 0, 0}},   {"*", {4, 4, 9, 4}},     {"/", {4, 4, 9, 4}},
    {"DIV", {0, 0, 9, 0}},  {"MOD", {4, 4, 9, 0}},   {"+", {3, 3, 8, 3}},
    {"-", {3, 3, 8, 3}},    {"B_AND", {0, 0, 7, 0}}, {"B_XOR", {0, 0, 6, 0}},
    {"B_OR", {0, 0, 5, 0}}, {"AND", {1, 4, 4, 1}},   {"XOR", {1, 3, 3, 0}},
    {"OR", {1, 3, 2, 1}},   {"EQ", {2, 1, 0, 2}},    {"NE", {2, 1, 0, 2}},
    {"GT", {2, 1, 0, 2}},   {"GE", {2, 1, 0, 2}},    {"LT", {2, 1, 0, 2}},
    {"LE", {2, 1, 0, 2}},   {"==", {0, 0, 1, 0}},    {"<>", {0, 0, 1, 0}},
    {">=", {0, 0, 1, 0}},   {"<=", {0, 0, 1, 0}},    {">", {0, 0, 1, 0}},
    {"<", {0, 0, 1, 0}},    {"EOR", {0, 0, 0, 1}}};
constexpr int kLowest = 1;
constexpr std::string_view kBits = "BITS ";  // before an operator on them

// What an operator does, whatever its name.
std::string_view meaning_of(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kSame[] = {
      {"==", "EQ"},        {"<>", "NE"},         {">=", "GE"},   {"<=", "LE"},
      {">", "GT"},         {"<", "LT"},          {"EOR", "XOR"}, {"B_AND", "BITS AND"},
      {"B_OR", "BITS OR"}, {"B_XOR", "BITS XOR"}};
  for (const auto& [own, meaning] : kSame)
    if (own == name) return meaning;
  return name;
}

// Functions of one value and the languages that have them.
struct Function {
  std::string_view name;
  bool linuxcnc, macro_b, siemens, okuma;
  double (*value)(double);
};
double degrees(double rad) { return rad / kDeg; }
constexpr Function kFunctions[] = {
    {"ABS", true, true, true, true, [](double a) { return std::abs(a); }},
    {"ACOS", true, true, true, true, [](double a) { return degrees(std::acos(a)); }},
    {"ASIN", true, true, true, true, [](double a) { return degrees(std::asin(a)); }},
    {"COS", true, true, true, true, [](double a) { return std::cos(a * kDeg); }},
    {"SIN", true, true, true, true, [](double a) { return std::sin(a * kDeg); }},
    {"TAN", true, true, true, true, [](double a) { return std::tan(a * kDeg); }},
    {"EXP", true, true, true, false, [](double a) { return std::exp(a); }},
    {"LN", true, true, true, false, [](double a) { return std::log(a); }},
    {"SQRT", true, true, true, true, [](double a) { return std::sqrt(a); }},
    {"ATAN", false, false, false, true, [](double a) { return degrees(std::atan(a)); }},
    {"SQR", false, true, false, false, [](double a) { return std::sqrt(a); }},
    {"POT", false, false, true, false, [](double a) { return a * a; }},
    {"ROUND", true, true, true, true, [](double a) { return std::round(a); }},
    {"RND", false, true, false, false, [](double a) { return std::round(a); }},
    {"FIX", true, false, false, false, [](double a) { return std::floor(a); }},
    {"FUP", true, false, false, false, [](double a) { return std::ceil(a); }},
    {"FIX", false, true, false, true, [](double a) { return std::trunc(a); }},
    {"FUP", false, true, false, true,
     [](double a) { return a < 0 ? std::floor(a) : std::ceil(a); }},
    {"TRUNC", false, false, true, false, [](double a) { return std::trunc(a); }}};

double whole_pair(double a, double b, std::string_view name) {
  const auto x = std::llround(a), y = std::llround(b);
  return static_cast<double>(name == "AND" ? x & y : name == "OR" ? x | y : x ^ y);
}

// The letter before the number of a variable without a name.
char letter_of(Language l) { return l == Language::okuma ? 'v' : 'r'; }

// Of "r12".
std::optional<double> number_behind(char letter, std::string_view name) {
  unsigned n = 0;
  if (!name.starts_with(letter)) return std::nullopt;
  const auto [end, error] =
      std::from_chars(name.data() + 1, name.data() + name.size(), n);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return n;
}

double truth(bool x) { return x ? 1 : 0; }

class Expression {
 public:
  Expression(std::string_view text, const Parameters& parameters)
      : text_(text),
        parameters_(parameters),
        language_(parameters.language()),
        linuxcnc_(language_ == Language::linuxcnc),
        opening_(language_ == Language::siemens ? '(' : '['),
        closing_(language_ == Language::siemens ? ')' : ']'),
        letter_(letter_of(language_)) {}

  Value whole() {
    const auto value = sum(kLowest);
    skip_blanks();
    if (at_ < text_.size()) broken();
    return value;
  }
  double brackets() { return brackets(opening_, closing_); }
  std::size_t at() const { return at_; }

 private:
  [[noreturn]] void broken() const {
    throw NotFollowed(say("{} is no expression.", text_));
  }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  char next() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool takes(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }
  double brackets(char opening, char closing) {
    if (!takes(opening) || ++depth_ > kDeepestBrackets) broken();
    const auto value = sum(kLowest);
    if (!takes(closing)) broken();
    --depth_;
    return value.value_or(0);
  }

  // The operator here if its rank is at least the given one.
  const Operator* operator_from(int rank) {
    skip_blanks();
    for (const auto& o : kOperators) {
      if (rank_of(o) == 0) continue;
      const auto here = text_.substr(std::min(at_, text_.size()), o.name.size());
      if (!std::ranges::equal(here, o.name, {}, capital)) continue;
      return rank_of(o) >= rank ? &o : nullptr;
    }
    return nullptr;
  }
  int rank_of(const Operator& o) const {
    return o.rank[static_cast<std::size_t>(language_)];
  }

  // Operators of this rank and above, from left to right.
  Value sum(int rank) {
    auto left = value();
    while (const auto* o = operator_from(rank)) {
      at_ += o->name.size();
      left = applied(meaning_of(o->name), left, sum(rank_of(*o) + 1));
    }
    return left;
  }

  bool alike(const Value& left, const Value& right) const {
    const double a = left.value_or(0), b = right.value_or(0);
    const double off = linuxcnc_ ? kAlike
                       : language_ == Language::siemens
                           ? kAlikeSiemens * std::max(std::abs(a), std::abs(b))
                           : 0;
    return left.has_value() == right.has_value() &&
           (linuxcnc_ ? std::abs(a - b) < off : std::abs(a - b) <= off);
  }

  double applied(std::string_view name, const Value& left, const Value& right) const {
    const double a = left.value_or(0), b = right.value_or(0);
    if (name == "+") return checked(a + b);
    if (name == "-") return checked(a - b);
    if (name == "*") return checked(a * b);
    if (name == "/") return checked(a / b);
    if (name == "**") return checked(std::pow(a, b));
    if (name == "MOD") return remainder(a, b);
    if (name == "DIV") return std::trunc(checked(whole(a) / whole(b)));
    if (name == "EQ") return truth(alike(left, right));
    if (name == "NE") return truth(!alike(left, right));
    if (name == "GT") return truth(a > b);
    if (name == "GE") return truth(a >= b);
    if (name == "LT") return truth(a < b);
    if (name == "LE") return truth(a <= b);
    if (name.starts_with(kBits)) return whole_pair(a, b, name.substr(kBits.size()));
    if (language_ == Language::macro_b) return whole_pair(a, b, name);
    const bool x = a != 0, y = b != 0;
    return truth(name == "AND" ? x && y : name == "OR" ? x || y : x != y);
  }
  double whole(double a) const {
    if (a == std::round(a)) return a;
    throw NotFollowed(tr("DIV is followed between whole numbers."));
  }
  double remainder(double a, double b) const {
    const double r = checked(std::fmod(a, b));
    return linuxcnc_ && r < 0 ? r + std::abs(b) : r;
  }
  double checked(double x) const {
    if (std::abs(x) <= kLargestResult) return x;
    throw NotFollowed(say("{} has no value that a control can hold.", text_));
  }

  Value value() {
    if (++depth_ > kDeepestBrackets) broken();
    const auto result = value_here();
    --depth_;
    return result;
  }
  Value value_here() {
    const char c = next();
    if (takes('-')) return -value().value_or(0);
    if (takes('+')) return value();
    if (c == opening_) return brackets();
    if (has_names(language_)) return is_name(c) ? named() : number();
    if (takes('#')) return parameter();
    return is_letter(c) ? function() : number();
  }
  double number() {
    double x = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + std::min(at_, text_.size()),
                        text_.data() + text_.size(), x, std::chars_format::fixed);
    if (error != std::errc()) broken();
    at_ = static_cast<std::size_t>(end - text_.data());
    return checked(x * power_of_ten());
  }
  // "EX-5" behind a number of Siemens.
  double power_of_ten() {
    const auto here = text_.substr(at_);
    if (language_ != Language::siemens || here.size() < 3 || capital(here[0]) != 'E' ||
        capital(here[1]) != 'X')
      return 1;
    int exponent = 0;
    const auto [end, error] =
        std::from_chars(here.data() + 2, here.data() + here.size(), exponent);
    if (error != std::errc() || std::abs(exponent) > 20) broken();
    at_ = static_cast<std::size_t>(end - text_.data());
    return std::pow(10, exponent);
  }

  static bool is_name(char c) { return is_letter(c) || c == '_' || c == '$'; }
  std::string name_here() {
    std::string all;
    const auto numbered = [&] { return all.size() > 1 && is_digit(all[1]); };
    while (at_ < text_.size() &&
           (is_digit(text_[at_]) || (is_name(text_[at_]) && !numbered())))
      all += small(text_[at_++]);
    return all;
  }
  // A variable, a function, or NOT before a value.
  Value named() {
    const auto name = name_here();
    if (name == "not") return truth(value().value_or(0) == 0);
    if (name == "b_not")
      return -1 - static_cast<double>(std::llround(value().value_or(0)));
    if (name == "true" || name == "false") return truth(name == "true");
    if (name == "$pi") return std::numbers::pi;
    const bool indexed = name.size() == 1 && name.front() == letter_;
    if (next() == opening_ && !indexed) return function_of(name);
    if (const auto n = number_behind(letter_, name)) return parameters_.at(*n);
    if (next() != '[') return parameters_.at(name);
    const double index = brackets('[', ']');
    return indexed ? parameters_.at(index)
                   : parameters_.at(fmt::format("{}[{:.0f}]", name, index));
  }
  double function_of(const std::string& small_name) {
    std::string name;
    for (const char c : small_name) name += capital(c);
    const auto all = arguments();
    if (all.size() == 1) return checked(of_one(name, all[0]));
    if (language_ == Language::okuma && name == "MOD" && all.size() == 2)
      return remainder(all[0], all[1]);
    if (name == "ATAN2" && all.size() == 2) return std::atan2(all[0], all[1]) / kDeg;
    if (language_ == Language::okuma)
      throw NotFollowed(say("The function {} is not known.", name));
    if (name == "MINVAL" && all.size() == 2) return std::min(all[0], all[1]);
    if (name == "MAXVAL" && all.size() == 2) return std::max(all[0], all[1]);
    if (name == "BOUND" && all.size() == 3 && all[0] <= all[1])
      return std::clamp(all[2], all[0], all[1]);
    throw NotFollowed(say("The function {} is not known.", name));
  }
  std::vector<double> arguments() {
    if (!takes(opening_) || ++depth_ > kDeepestBrackets) broken();
    std::vector<double> all;
    do all.push_back(sum(kLowest).value_or(0));
    while (takes(','));
    if (!takes(closing_)) broken();
    --depth_;
    return all;
  }

  Value parameter() {
    if (next() == '<') return parameters_.at(name());
    return parameters_.at(value().value_or(0));
  }
  // Names have neither capitals nor blanks.
  std::string name() {
    std::string all;
    if (!takes('<')) broken();
    for (; at_ < text_.size() && text_[at_] != '>'; ++at_)
      if (!is_blank(text_[at_])) all += small(text_[at_]);
    if (!takes('>')) broken();
    return all;
  }

  double function() {
    std::string name;
    while (at_ < text_.size() && is_letter(text_[at_])) name += capital(text_[at_++]);
    if (name == "EXISTS" && linuxcnc_) return exists();
    if (name == "POW" && !linuxcnc_) return power();
    const double a = brackets();
    if (name == "ATAN") return std::atan2(a, run()) / kDeg;
    return checked(of_one(name, a));
  }
  // The second brackets of ATAN[y]/[x]; 1 without them.
  double run() {
    const auto here = at_;
    if (takes('/') && next() == '[') return brackets();
    at_ = here;
    return 1;
  }
  double exists() {
    if (!takes('[') || !takes('#')) broken();
    const bool is = parameters_.exists(name());
    if (!takes(']')) broken();
    return truth(is);
  }
  double power() {
    const auto all = arguments();
    if (all.size() != 2) broken();
    return checked(std::pow(all[0], all[1]));
  }
  double of_one(const std::string& name, double a) const {
    for (const auto& f : kFunctions)
      if (f.name == name && (linuxcnc_                        ? f.linuxcnc
                             : language_ == Language::siemens ? f.siemens
                             : language_ == Language::okuma   ? f.okuma
                                                              : f.macro_b))
        return f.value(a);
    throw NotFollowed(say("The function {} is not known.", name));
  }

  std::string_view text_;
  const Parameters& parameters_;
  Language language_;
  bool linuxcnc_;
  char opening_, closing_, letter_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// What a variable's place in a text names: a number, or a name.
void set_hash(Parameters& parameters, std::string_view parameter, const Value& value) {
  const auto at = parameter.substr(1);
  const auto first = at.find_first_not_of(" \t");
  if (first != at.npos && at[first] == '<') {
    std::string name;
    for (const char c : at.substr(first + 1, at.find('>') - first - 1))
      if (!is_blank(c)) name += small(c);
    return parameters.set(name, value.value_or(0));
  }
  parameters.set(value_of(at, parameters).value_or(0), value);
}

// "R1", "R[R2]", "depth", "depth[3]".
void set_named(Parameters& parameters, std::string_view parameter, double value) {
  const auto bracket = std::min(parameter.find('['), parameter.size());
  std::string name;
  for (const char c : parameter.substr(0, bracket))
    if (!is_blank(c)) name += small(c);
  const auto index = parameter.substr(bracket);
  std::optional<double> number;
  if (!index.empty())
    number = value_of(index.substr(1, index.size() - 2), parameters).value_or(0);
  const char letter = letter_of(parameters.language());
  if (name.size() == 1 && name.front() == letter && number)
    return parameters.set(*number, value);
  if (const auto n = number_behind(letter, name)) return parameters.set(*n, value);
  if (parameters.language() == Language::siemens && !parameters.declared(name))
    throw NotFollowed(say("{} is not declared in the program.", parameter));
  parameters.set(number ? fmt::format("{}[{:.0f}]", name, *number) : name, value);
}

// Words of declared names set them; of Okuma those in blocks without other words.
void names_become_assignments(Block& block, const Parameters& parameters) {
  const auto equals = [](const Word& w) {
    return w.name.size() > 1 && w.text.find('=') != w.text.npos;
  };
  const bool okuma = parameters.language() == Language::okuma;
  const auto other = [&](const Word& w) { return w.name != "N" && !equals(w); };
  if (okuma && std::ranges::any_of(block.words, other)) return;
  std::erase_if(block.words, [&](const Word& w) {
    std::string name;
    for (const char c : w.name) name += small(c);
    if (!equals(w) || (!okuma && !parameters.declared(name))) return false;
    block.assignments.push_back({name, w.text.substr(w.text.find('=') + 1)});
    return true;
  });
}

}  // namespace

Value value_of(std::string_view expression, const Parameters& parameters) {
  return Expression(expression, parameters).whole();
}

void set_variable(Parameters& parameters, std::string_view variable, const Value& value) {
  has_names(parameters.language()) ? set_named(parameters, variable, value.value_or(0))
                                   : set_hash(parameters, variable, value);
}

double bracketed_value(std::string_view text, const Parameters& parameters,
                       std::size_t& end) {
  Expression expression(text, parameters);
  const double value = expression.brackets();
  end = expression.at();
  return value;
}

void evaluate(Block& block, Parameters& parameters) {
  if (has_names(parameters.language())) names_become_assignments(block, parameters);
  for (auto& w : block.words) {
    if (w.expression.empty()) continue;
    w.value = value_of(w.expression, parameters);
    if (!(std::abs(w.value.value_or(0)) <= kLargestWord))
      throw NotFollowed(say("{} is larger than words may be.", w.text));
    w.point = true;
  }
  std::erase_if(block.words,
                [](const Word& w) { return !w.expression.empty() && !w.value; });
  std::vector<Value> values;
  for (const auto& a : block.assignments)
    values.push_back(value_of(a.expression, parameters));
  for (std::size_t i = 0; i < values.size(); ++i)
    set_variable(parameters, block.assignments[i].parameter, values[i]);
}

}  // namespace turnwright::review
