#include "expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "letters.hpp"

namespace turnwright::review {
namespace {

constexpr int kDeepestBrackets = 50;     // brackets in brackets
constexpr double kAlike = 1e-4;          // of LinuxCNC's EQ
constexpr double kLargestResult = 1e12;  // of a result
constexpr double kDeg = std::numbers::pi / 180;

struct Operator {
  std::string_view name;
  int linuxcnc, fanuc;  // rank, 0: the control has none
};
// Longer names before those that they begin with.
constexpr Operator kOperators[] = {
    {"**", 5, 0}, {"*", 4, 4},  {"/", 4, 4},   {"MOD", 4, 4}, {"AND", 1, 4},
    {"+", 3, 3},  {"-", 3, 3},  {"XOR", 1, 3}, {"OR", 1, 3},  {"EQ", 2, 1},
    {"NE", 2, 1}, {"GT", 2, 1}, {"GE", 2, 1},  {"LT", 2, 1},  {"LE", 2, 1}};
constexpr int kLowest = 1;

double whole_pair(double a, double b, std::string_view name) {
  const auto x = std::llround(a), y = std::llround(b);
  return static_cast<double>(name == "AND" ? x & y : name == "OR" ? x | y : x ^ y);
}

double truth(bool x) { return x ? 1 : 0; }

class Expression {
 public:
  Expression(std::string_view text, const Parameters& parameters)
      : text_(text), parameters_(parameters), linuxcnc_(parameters.linuxcnc()) {}

  Value whole() {
    const auto value = sum(kLowest);
    skip_blanks();
    if (at_ < text_.size()) broken();
    return value;
  }
  double brackets() {
    if (!takes('[') || ++depth_ > kDeepestBrackets) broken();
    const auto value = sum(kLowest);
    if (!takes(']')) broken();
    --depth_;
    return value.value_or(0);
  }
  std::size_t at() const { return at_; }

 private:
  [[noreturn]] void broken() const {
    throw NotFollowed(fmt::format("{} is no expression.", text_));
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

  // The operator here if its rank is at least the given one.
  const Operator* operator_from(int rank) {
    skip_blanks();
    for (const auto& o : kOperators) {
      const auto here = text_.substr(std::min(at_, text_.size()), o.name.size());
      if (!std::ranges::equal(here, o.name, {}, capital)) continue;
      return rank_of(o) >= rank ? &o : nullptr;
    }
    return nullptr;
  }
  int rank_of(const Operator& o) const { return linuxcnc_ ? o.linuxcnc : o.fanuc; }

  // Operators of this rank and above, from left to right.
  Value sum(int rank) {
    auto left = value();
    while (const auto* o = operator_from(rank)) {
      at_ += o->name.size();
      const auto right = rank_of(*o) < 5 ? sum(rank_of(*o) + 1) : value();
      left = applied(o->name, left, right);
    }
    return left;
  }

  double applied(std::string_view name, const Value& left, const Value& right) const {
    const double a = left.value_or(0), b = right.value_or(0);
    const bool same = left.has_value() == right.has_value() &&
                      (linuxcnc_ ? std::abs(a - b) < kAlike : a == b);
    if (name == "+") return a + b;
    if (name == "-") return a - b;
    if (name == "*") return checked(a * b);
    if (name == "/") return checked(a / b);
    if (name == "**") return checked(std::pow(a, b));
    if (name == "MOD") return remainder(a, b);
    if (name == "EQ") return truth(same);
    if (name == "NE") return truth(!same);
    if (name == "GT") return truth(a > b);
    if (name == "GE") return truth(a >= b);
    if (name == "LT") return truth(a < b);
    if (name == "LE") return truth(a <= b);
    if (!linuxcnc_) return whole_pair(a, b, name);
    const bool x = a != 0, y = b != 0;
    return truth(name == "AND" ? x && y : name == "OR" ? x || y : x != y);
  }
  double remainder(double a, double b) const {
    const double r = checked(std::fmod(a, b));
    return linuxcnc_ && r < 0 ? r + std::abs(b) : r;
  }
  double checked(double x) const {
    if (std::abs(x) <= kLargestResult) return x;
    throw NotFollowed(fmt::format("{} has no value that a control can hold.", text_));
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
    if (takes('#')) return parameter();
    if (c == '[') return brackets();
    return is_letter(c) ? function() : number();
  }
  double number() {
    double x = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + std::min(at_, text_.size()),
                        text_.data() + text_.size(), x, std::chars_format::fixed);
    if (error != std::errc()) broken();
    at_ = static_cast<std::size_t>(end - text_.data());
    return checked(x);
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
    return checked(function_of(name, a));
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
    if (!takes('[')) broken();
    const double a = sum(kLowest).value_or(0);
    if (!takes(',')) broken();
    const double b = sum(kLowest).value_or(0);
    if (!takes(']')) broken();
    return checked(std::pow(a, b));
  }
  double function_of(const std::string& name, double a) const {
    if (name == "ABS") return std::abs(a);
    if (name == "ACOS") return std::acos(a) / kDeg;
    if (name == "ASIN") return std::asin(a) / kDeg;
    if (name == "COS") return std::cos(a * kDeg);
    if (name == "SIN") return std::sin(a * kDeg);
    if (name == "TAN") return std::tan(a * kDeg);
    if (name == "EXP") return std::exp(a);
    if (name == "LN") return std::log(a);
    if (name == "SQRT" || (name == "SQR" && !linuxcnc_)) return std::sqrt(a);
    if (name == "ROUND" || (name == "RND" && !linuxcnc_)) return std::round(a);
    const bool down = linuxcnc_ || a >= 0;
    if (name == "FIX") return down ? std::floor(a) : std::ceil(a);
    if (name == "FUP") return down ? std::ceil(a) : std::floor(a);
    throw NotFollowed(fmt::format("The function {} is not known.", name));
  }

  std::string_view text_;
  const Parameters& parameters_;
  bool linuxcnc_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

void set(Parameters& parameters, std::string_view parameter, const Value& value) {
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

}  // namespace

Value value_of(std::string_view expression, const Parameters& parameters) {
  return Expression(expression, parameters).whole();
}

double bracketed_value(std::string_view text, const Parameters& parameters,
                       std::size_t& end) {
  Expression expression(text, parameters);
  const double value = expression.brackets();
  end = expression.at();
  return value;
}

void evaluate(Block& block, Parameters& parameters) {
  for (auto& w : block.words) {
    if (w.expression.empty()) continue;
    w.value = value_of(w.expression, parameters);
    w.point = true;
  }
  std::erase_if(block.words,
                [](const Word& w) { return !w.expression.empty() && !w.value; });
  std::vector<Value> values;
  for (const auto& a : block.assignments)
    values.push_back(value_of(a.expression, parameters));
  for (std::size_t i = 0; i < values.size(); ++i)
    set(parameters, block.assignments[i].parameter, values[i]);
}

}  // namespace turnwright::review
