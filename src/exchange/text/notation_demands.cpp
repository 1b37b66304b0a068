#include "notation_demands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/say.hpp"

namespace turnwright::exchange::notated {
namespace {

constexpr double kLargestRa_um = 100, kLargestRz_um = 400;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

bool begins_with_digit(Word word) { return !word.empty() && is_digit(word[0]); }

// "AxANGLE", the angle 45 if there is none.
bool take_chamfer(Word at, Word word, Edge& edge, Mistakes& mistakes) {
  const auto axial = take_number(word);
  double angle = 45;
  if (axial && take(word, {"x", "×"})) {
    const auto read = take_number(word);
    take(word, {"°"});
    angle = read.value_or(0);
  }
  if (!axial || !word.empty() || !(angle >= 1 && angle <= 89)) {
    mistakes.add(at,
                 tr("a chamfer like 1x45, its length along the axis and its angle of 1 "
                    "to 89 deg from it"));
    return false;
  }
  edge.chamfer_mm = axial;
  edge.angle_deg = angle;
  return in_range(at, *axial, kLargest_mm, "mm", mistakes);
}

// The designation that "DIN76-A" stands for, written as one word.
std::optional<std::string> thread_undercut(Word word) {
  if (same(word, "din76-a")) return "DIN 76-A";
  if (same(word, "din76-b")) return "DIN 76-B";
  return std::nullopt;
}

// The form of DIN 509 that a word begins with, which is taken off it.
std::optional<char> undercut_form(Word& word) {
  constexpr std::string_view kForms = "efgh";
  for (std::size_t i = 0; i < kForms.size(); ++i)
    if (take(word, {kForms.substr(i, 1)})) return static_cast<char>('E' + i);
  return std::nullopt;
}

bool begins_undercut(Word word) { return undercut_form(word) && begins_with_digit(word); }

bool take_undercut(Word word, Edge& edge, Mistakes& mistakes) {
  if ((edge.undercut = thread_undercut(word))) return true;
  Word rest = word;
  const auto form = undercut_form(rest);
  const auto sizes = product(rest);
  if (!form || !sizes || sizes->size() != 2) {
    mistakes.add(word,
                 tr("an undercut of DIN 509 by form, radius and depth, like E0.8x0.3, or "
                    "DIN76-A behind a thread"));
    return false;
  }
  edge.undercut = fmt::format("{}{}x{}", *form, (*sizes)[0], (*sizes)[1]);
  return true;
}

bool take_radius(Word word, Word rest, std::optional<double>& radius_mm,
                 const std::string& example, Mistakes& mistakes) {
  radius_mm = number(rest);
  if (!radius_mm) {
    mistakes.add(word, example);
    return false;
  }
  return in_range(word, *radius_mm, kLargest_mm, "mm", mistakes);
}

}  // namespace

bool is_fit(Word word) {
  std::size_t n = 0;
  while (n < word.size() && n < 2 && is_letter(word[n])) ++n;
  const std::size_t digits = word.size() - n;
  if (n == 0 || digits < 1 || digits > 2) return false;
  for (; n < word.size(); ++n)
    if (!is_digit(word[n])) return false;
  return true;
}

bool in_range(Word at, double x, double most, const char* unit, Mistakes& mistakes) {
  const auto& u = mistakes.units;
  const bool length = std::string_view(unit) == "mm";
  const double limit = most / (length ? u.mm : u.um);
  if (x > 0 && x <= limit) return true;
  mistakes.add(
      at, say("a number > 0 and <= {:.6g} {}", limit, length ? u.length : u.roughness));
  return false;
}

std::optional<part::Limits> limits(Word word) {
  if (take(word, {"±", "+-", "+/-"})) {
    const auto x = number(word);
    if (!x) return std::nullopt;
    return part::Limits{-*x, *x};
  }
  const auto a = take_signed_number(word);
  if (!a || !take(word, {"/"})) return std::nullopt;
  const auto b = take_signed_number(word);
  if (!b || !word.empty()) return std::nullopt;
  return part::Limits{std::min(*a, *b), std::max(*a, *b)};
}

bool take_roughness(Word word, Demands& demands, Mistakes& mistakes) {
  Word rest = word;
  const bool Ra = take(rest, {"ra"});
  if (!Ra && !take(rest, {"rz"})) return false;
  auto& value = Ra ? demands.Ra_um : demands.Rz_um;
  if (value) {
    mistakes.add(word, Ra ? tr("one Ra") : tr("one Rz"));
  } else if (const auto x = number(rest)) {
    if (in_range(word, *x, Ra ? kLargestRa_um : kLargestRz_um, "um", mistakes)) value = x;
  } else {
    mistakes.add(word, Ra ? tr("a roughness like Ra1.6") : tr("a roughness like Rz6.3"));
  }
  return true;
}

bool begins_corner(Word word) {
  if (same(word, "chamfer") || same(word, "round") || begins_with_digit(word) ||
      thread_undercut(word) || begins_undercut(word))
    return true;
  if (Word rest = word; take(rest, {"round"}) && begins_with_digit(rest)) return true;
  return take(word, {"r"}) && begins_with_digit(word);
}

std::vector<Edge> corner(const std::vector<Word>& words, Mistakes& mistakes) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < words.size(); ++i) {
    Edge edge;
    Word first = words[i];
    bool read = false;
    if (same(words[i], "chamfer") && i + 1 < words.size()) {
      ++i;
      read = take_chamfer(words[i], words[i], edge, mistakes);
    } else if (take(first, {"round"})) {
      if (first.empty() && i + 1 < words.size()) first = words[++i];
      read = take_radius(words[i], first, edge.radius_mm,
                         tr("a rounded edge like round2"), mistakes);
    } else if (begins_with_digit(first)) {
      read = take_chamfer(first, first, edge, mistakes);
    } else if (thread_undercut(first) || begins_undercut(first)) {
      read = take_undercut(words[i], edge, mistakes);
    } else if (take(first, {"r"}) && begins_with_digit(first)) {
      read = take_radius(words[i], first, edge.fillet_mm, tr("a fillet like R0.8"),
                         mistakes);
    } else {
      mistakes.add(
          words[i],
          tr("a chamfer like 1x45, a rounded edge like round2, a fillet like R0.8 or "
             "an undercut like E0.8x0.3 or DIN76-A"));
    }
    if (read) edges.push_back(std::move(edge));
  }
  return edges;
}

}  // namespace turnwright::exchange::notated
