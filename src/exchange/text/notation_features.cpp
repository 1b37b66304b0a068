#include "notation_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "turnwright/base/language.hpp"

namespace turnwright::exchange::notated {
namespace {

using part::ToleranceKind;

const part::ToleranceFacts* kind_of_tolerance(Word word) {
  for (const auto& row : part::tolerance_kinds())
    if (same(word, row.name)) return &row;
  return nullptr;
}

std::optional<Milled::Kind> kind_of_milled(Word word) {
  using enum Milled::Kind;
  if (same(word, "keyway")) return keyway;
  if (same(word, "slot")) return slot;
  if (same(word, "flat")) return flat;
  if (same(word, "cross-hole")) return cross_hole;
  return std::nullopt;
}

// The words of a statement with a place that is told where one is missing.
class Rest {
 public:
  Rest(const std::vector<Word>& words, Mistakes& mistakes)
      : words_(words), mistakes_(mistakes) {}

  bool done() const { return next_ == words_.size(); }
  Word here() const { return done() ? words_.back() : words_[next_]; }
  Word take() { return words_[next_++]; }
  bool take(std::string_view word) {
    const bool found = !done() && same(words_[next_], word);
    if (found) ++next_;
    return found;
  }
  /// Always false.
  bool mistake(const std::string& expected) {
    mistakes_.add(here(), expected, done() ? tr("nothing more after it") : "");
    return false;
  }
  /// Likewise, of a word already taken.
  bool mistake(const std::string& expected, Word at) {
    mistakes_.add(at, expected);
    return false;
  }
  bool end() { return done() || mistake(tr("nothing more here")); }

 private:
  const std::vector<Word>& words_;
  Mistakes& mistakes_;
  std::size_t next_ = 1;
};

bool take_id(Rest& rest, Features& out, std::string& id, Named named) {
  if (rest.done())
    return rest.mistake(named.face_too ? tr("an element or a face: d2, left, d1|d2")
                                       : tr("an element like d2"));
  named.word = rest.take();
  id = std::string(named.word);
  out.named.push_back(named);
  return true;
}

bool take_value(Rest& rest, const std::string& expected, double& value) {
  Word word = rest.done() ? Word() : rest.here();
  const auto x = take_signed_number(word);
  take(word, {"°"});
  if (!x || !word.empty()) return rest.mistake(expected);
  rest.take();
  value = *x;
  return true;
}

void read_face(Rest rest, Features& out, Mistakes& mistakes) {
  FaceOf face;
  if (!take_id(rest, out, face.id, {.word = {}, .face_too = true})) return;
  if (rest.done()) {
    rest.mistake(tr("a roughness like Ra1.6"));
    return;
  }
  while (!rest.done())
    if (take_roughness(rest.here(), face.demands, mistakes))
      rest.take();
    else if (!rest.mistake(tr("a roughness like Ra1.6")))
      return;
  out.faces.push_back(std::move(face));
}

// "d2" or "left", or "d2-d6" for the common axis of two elements.
bool take_datum(Rest& rest, Features& out, part::Tolerance& t) {
  const auto dash = rest.done() ? Word::npos : rest.here().find('-');
  if (dash == Word::npos)
    return take_id(rest, out, t.datum, {.word = {}, .face_too = true});
  const Word word = rest.take(), a = word.substr(0, dash), b = word.substr(dash + 1);
  if (a == b)
    return rest.mistake(tr("two different elements on either side of '-'"), word);
  t.datum = std::string(a);
  t.common_datum = std::string(b);
  out.named.push_back({a, false});
  out.named.push_back({b, false});
  return true;
}

// "d3 to d2 0.04": what it is of, its datum, its width.
bool read_zone(Rest& rest, Features& out, part::Tolerance& t, Mistakes& mistakes) {
  if (!take_id(rest, out, t.of, {.word = {}, .face_too = true})) return false;
  if (rest.take("to") && !take_datum(rest, out, t)) return false;
  const Word width = rest.here();
  constexpr double kWidest_mm = 10;
  return take_value(rest, tr("the width of the tolerance zone like 0.02"), t.value_mm) &&
         in_range(width, t.value_mm, kWidest_mm, "mm", mistakes);
}

// "left to right ±0.15", "d2 +0.1/0": sizes have limits.
bool read_size(Rest& rest, Features& out, part::Tolerance& t) {
  if (t.kind == ToleranceKind::length) {
    if (!take_id(rest, out, t.between[0], {.word = {}, .face_too = true})) return false;
    if (!rest.take("to")) return rest.mistake(tr("to and the second face"));
    if (!take_id(rest, out, t.between[1], {.word = {}, .face_too = true})) return false;
  } else if (!take_id(rest, out, t.of, {})) {
    return false;
  }
  t.limits = rest.done() ? std::nullopt : limits(rest.here());
  if (!t.limits || !(t.limits->lower_mm < t.limits->upper_mm))
    return rest.mistake(tr("limits like +0.05/-0.02 or ±0.05"));
  rest.take();
  t.value_mm = t.limits->upper_mm - t.limits->lower_mm;
  return true;
}

void read_tolerance(Rest rest, ToleranceKind kind, Features& out, Mistakes& mistakes) {
  part::Tolerance t{.id = {}, .kind = kind, .of = {}, .datum = {}, .between = {}};
  const bool size = kind == ToleranceKind::length || kind == ToleranceKind::diameter;
  if (!(size ? read_size(rest, out, t) : read_zone(rest, out, t, mistakes))) return;
  if (!rest.end()) return;
  t.id = fmt::format("t{}", out.tolerances.size() + 1);
  out.tolerances.push_back(std::move(t));
}

bool take_count(Rest& rest, int& count) {
  double value = 0;
  if (!take_value(rest, tr("how often like times 6"), value)) return false;
  count = value >= 2 && value <= 100 && value == std::floor(value)
              ? static_cast<int>(value)
              : 0;
  return count > 0 || rest.mistake(tr("a whole number from 2 to 100 before this"));
}

// "2x25" of a flat, "10x5x40" of a keyway or slot.
bool take_sizes(Rest& rest, Milled& m) {
  const bool flat = m.kind == Milled::Kind::flat;
  const auto sizes = rest.done() ? std::nullopt : product(rest.here());
  const bool all = sizes && sizes->size() == (flat ? 2 : 3) &&
                   *std::min_element(sizes->begin(), sizes->end()) > 0;
  if (!all)
    return rest.mistake(flat ? tr("depth and length like 2x25, each > 0")
                             : tr("width, depth and length like 10x5x40, each > 0"));
  rest.take();
  m.width_mm = flat ? 0 : sizes->front();
  m.depth_mm = (*sizes)[sizes->size() - 2];
  m.length_mm = sizes->back();
  return true;
}

// A positive number behind one of the beginnings, to the end of the word.
std::optional<double> positive_after(Rest& rest,
                                     std::initializer_list<std::string_view> beginnings) {
  Word word = rest.done() ? Word() : rest.here();
  if (!take(word, beginnings)) return std::nullopt;
  const auto x = number(word);
  if (!x || !(*x > 0)) return std::nullopt;
  rest.take();
  return x;
}

// "d6 H13 x 8", "d6 through wall" of a cross hole.
bool take_hole(Rest& rest, Milled& m) {
  const auto D = positive_after(rest, {"d", "Ø", "ø", "⌀"});
  if (!D) return rest.mistake(tr("the diameter of the hole like d6, > 0"));
  m.width_mm = *D;
  if (!rest.done() && is_fit(rest.here()))
    m.demands.fit = std::string(rest.take());
  else if (const auto l = rest.done() ? std::nullopt : limits(rest.here())) {
    m.demands.limits = l;
    rest.take();
  }
  if (rest.take("through")) {
    m.through = rest.take("wall") ? Milled::Through::wall : Milled::Through::part;
    rest.take("part");
    return true;
  }
  const auto depth = positive_after(rest, {"x", "×"});
  if (!depth)
    return rest.mistake(tr("its depth like x 8, > 0, or through wall, or through part"));
  m.depth_mm = *depth;
  return true;
}

void read_milled(Rest rest, Milled::Kind kind, Features& out) {
  Milled m{.id = fmt::format("m{}", out.milled.size() + 1), .kind = kind, .on = {}};
  const bool hole = kind == Milled::Kind::cross_hole;
  if (!(hole ? take_hole(rest, m) : take_sizes(rest, m))) return;
  bool read = rest.take("on") ? take_id(rest, out, m.on, {})
                              : rest.mistake(tr("on and an element, like on d2"));
  const auto wanted = hole ? tr("at and its middle along the part, like at 12")
                           : tr("at and its left end along the part, like at 12");
  read = read && (rest.take("at")
                      ? take_value(rest, tr("a place along the part like at 12"), m.z_mm)
                      : rest.mistake(wanted));
  if (read && rest.take("angle"))
    read = take_value(rest, tr("an angle like 90"), m.angle_deg);
  if (read && rest.take("times")) read = take_count(rest, m.count);
  if (read && rest.end()) out.milled.push_back(std::move(m));
}

}  // namespace

bool read_feature(const std::vector<Word>& words, Features& features,
                  Mistakes& mistakes) {
  const Rest rest(words, mistakes);
  if (same(words[0], "face"))
    read_face(rest, features, mistakes);
  else if (const auto* row = kind_of_tolerance(words[0]))
    read_tolerance(rest, row->kind, features, mistakes);
  else if (const auto kind = kind_of_milled(words[0]))
    read_milled(rest, *kind, features);
  else
    return false;
  return true;
}

}  // namespace turnwright::exchange::notated
