#include "notation_element.hpp"

#include <array>
#include <cctype>

#include "thread_words.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange::notated {
namespace {

constexpr std::array<std::pair<std::string_view, Shape>, 6> kShapes{
    {{"cone", Shape::cone},
     {"arc", Shape::arc},
     {"groove", Shape::groove},
     {"thread", Shape::thread},
     {"hole", Shape::hole},
     {"stock", Shape::as_stock}}};

std::optional<Shape> shape_word(Word word) {
  for (const auto& [name, shape] : kShapes)
    if (same(word, name)) return shape;
  return std::nullopt;
}

bool take_d(Word& word) { return take(word, {"d", "Ø", "ø", "⌀"}); }

// What to write instead of a habit of the pen; "" if the word is none of these.
std::string hint(Word word) {
  if (word.ends_with(','))
    return tr("';' or a new line before the next element: a comma is a decimal comma");
  if (word == "/" || (take_signed_number(word) && word.empty()))
    return tr("limits without blanks, like +0.02/-0.01");
  return "";
}

// "h7x40": one or two letters and a digit, not a length.
bool begins_with_fit(Word word) {
  Word length = word;
  if (take(length, {"x", "×"})) return false;
  for (std::size_t n = 1; n <= 2 && n < word.size(); ++n)
    if (is_digit(word[n])) return is_fit(word.substr(0, n + 1));
  return false;
}

bool begins_with_number(Word word) {
  return !word.empty() && (is_digit(word[0]) || word[0] == '.');
}

// Reads the words of one element, one after the other.
class ElementWords {
 public:
  ElementWords(const std::vector<Word>& words, Mistakes& mistakes)
      : words_(words), mistakes_(mistakes) {}

  ReadElement read() {
    read_place();
    if (read_head()) {
      while (next_ < words_.size()) read_demand(words_[next_++]);
      finish();
    }
    return std::move(out_);
  }

 private:
  Element& e() { return out_.element; }

  // "bore", "bore left", and the word of the shape.
  void read_place() {
    if (same(words_[0], "bore")) {
      out_.inner = true;
      ++next_;
      const bool left = next_ < words_.size() && same(words_[next_], "left");
      if (left || (next_ < words_.size() && same(words_[next_], "right"))) ++next_;
      e().from = left ? part::End::left : part::End::right;
    }
    if (next_ == words_.size()) return;
    const auto shape = shape_word(words_[next_]);
    if (!shape || (out_.inner && *shape == Shape::as_stock)) return;
    if (!out_.inner && *shape == Shape::hole)
      mistakes_.add(words_[next_], tr("a hole in a bore, like bore hole d8 x 30"));
    e().shape = *shape;
    ++next_;
  }

  bool read_head() {
    const bool ends = next_ == words_.size();
    if (!ends && (e().shape == Shape::cylinder || e().shape == Shape::thread))
      if (const auto inch = take_inch_thread(words_, next_)) return read_inch(*inch);
    const Word word = ends ? words_.back() : words_[next_++];
    Word rest = word;
    const bool cylinder = e().shape == Shape::cylinder;
    if (!ends && (cylinder || e().shape == Shape::thread) && take(rest, {"m"}))
      return read_thread(word, rest);
    if (!ends && e().shape == Shape::as_stock && take_flats(rest))
      return read_across(word, rest);
    if (!ends && e().shape != Shape::thread && take_d(rest))
      return read_diameters(word, rest);
    return head_mistake(word);
  }

  bool head_mistake(Word word) {
    auto wanted =
        tr("a diameter like d50, two of a cone like d30-d40, or a thread "
           "like M24x1.5 or 1/2-13 UNC");
    if (e().shape == Shape::thread) wanted = tr("a thread like M24x1.5 or 1/2-13 UNC");
    if (e().shape == Shape::groove)
      wanted = tr("the diameter of the groove's floor like d26");
    if (e().shape == Shape::as_stock)
      wanted = tr("the bar that stays like d50, hex27 or square20");
    if (e().shape == Shape::hole) wanted = tr("the diameter of the hole like d8");
    if (e().shape == Shape::cone || e().shape == Shape::arc)
      wanted = tr("the diameters at both ends like d30-d40");
    mistakes_.add(word, wanted);
    return false;
  }

  bool take_flats(Word& rest) {
    e().flats = take(rest, {"hex"}) ? 6 : take(rest, {"square"}) ? 4 : 0;
    return e().flats > 0;
  }

  bool read_across(Word word, Word rest) {
    if (rest.empty() && next_ < words_.size()) rest = words_[next_++];
    const auto across = take_number(rest);
    if (!across) return head_mistake(word);
    e().left_mm = e().right_mm = *across;
    return in_range(word, *across, kLargest_mm, "mm", mistakes_) &&
           read_glued(word, rest);
  }

  bool read_inch(const part::InchThread& inch) {
    e().shape = Shape::thread;
    e().left_mm = e().right_mm = inch.d_mm;
    e().pitch_mm = inch.pitch_mm;
    pitch_given_ = true;
    if (!inch.tolerance_class.empty()) e().demands.fit = inch.tolerance_class;
    return true;
  }

  bool read_thread(Word word, Word rest) {
    e().shape = Shape::thread;
    const auto d = take_number(rest);
    if (!d) return head_mistake(word);
    if (take(rest, {"x", "×"})) {
      const auto pitch = take_number(rest);
      if (!pitch) return head_mistake(word);
      pitch_given_ = in_range(word, *pitch, kLargest_mm, "mm", mistakes_);
      e().pitch_mm = *pitch;
    }
    e().left_mm = e().right_mm = *d;
    return in_range(word, *d, kLargest_mm, "mm", mistakes_) && read_glued(word, rest);
  }

  bool read_diameters(Word word, Word rest) {
    const auto left = take_number(rest);
    if (!left) return head_mistake(word);
    auto right = left;
    const bool two = take(rest, {"-", "/"});
    if (two) {
      take_d(rest);
      right = take_number(rest);
      if (e().shape == Shape::cylinder) e().shape = Shape::cone;
    }
    const bool wants_two = e().shape == Shape::cone || e().shape == Shape::arc;
    if (!right || two != wants_two) return head_mistake(word);
    e().left_mm = *left;
    e().right_mm = *right;
    return in_range(word, std::min(*left, *right), kLargest_mm, "mm", mistakes_) &&
           in_range(word, std::max(*left, *right), kLargest_mm, "mm", mistakes_) &&
           read_glued(word, rest);
  }

  // A length without a blank before it: d50x40.
  bool read_glued(Word word, Word rest) {
    if (rest.empty()) return true;
    Word length = rest;
    if (take(length, {"x", "×"}) && number(length)) {
      read_demand(rest);
      return true;
    }
    if (const auto said = hint(word); !said.empty()) {
      mistakes_.add(word, said);
      return false;
    }
    if (!begins_with_fit(rest)) return head_mistake(word);
    mistakes_.add(word, tr("blanks between diameter, fit and length, like d50 h7 x 40"));
    return false;
  }

  // "grind0.3".
  void read_grinding(Word word, Word rest) {
    auto& grinding = e().demands.grinding_mm;
    const bool turned = e().shape == Shape::cylinder || e().shape == Shape::cone;
    if (grinding)
      mistakes_.add(word, tr("one grinding allowance"));
    else if (const auto x = number(rest); !x || !turned)
      mistakes_.add(word,
                    tr("a grinding allowance on the diameter of a cylinder or cone, like "
                       "grind0.3"));
    else if (in_range(word, *x, 5, "mm", mistakes_))
      grinding = x;
  }

  // "RAA0.8"; whether the word is a knurl.
  bool read_knurl(Word word) {
    std::string text(word);
    for (char& c : text)
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const auto knurl = part::knurl(text);
    if (!knurl) return false;
    if (e().knurl)
      mistakes_.add(word, tr("one knurl"));
    else if (e().shape != Shape::cylinder || out_.inner)
      mistakes_.add(word, tr("no knurl: only an outer cylinder has one"));
    else
      e().knurl = part::designation(*knurl);
    return true;
  }

  void read_demand(Word word) {
    Word rest = word;
    if (take(rest, {"x", "×"})) return read_length(word, rest);
    if (e().shape == Shape::as_stock)
      return mistakes_.add(word,
                           tr("a length like x 20 alone: what stays as the bar is has no "
                              "fit, limits or roughness"));
    if (read_knurl(word)) return;
    if (take_roughness(word, e().demands, mistakes_)) return;
    if (take(rest, {"grind"})) return read_grinding(word, rest);
    if (e().shape == Shape::arc && read_arc(word)) return;
    const bool thread = e().shape == Shape::thread;
    if (thread ? is_thread_class(word) : is_fit(word)) return read_fit(word);
    if (const auto l = limits(word)) {
      if (e().length_mm > 0)
        return mistakes_.add(word,
                             tr("limits of the diameter before the length: d50 "
                                "+0.02/-0.01 x 40 (those of a length: length left to "
                                "right +0.1/-0.1)"));
      return read_limits(word, *l);
    }
    if (const auto said = hint(word); !said.empty()) return add_hint(word, said);
    mistakes_.add(word, thread ? tr("a length like x 40, a class like 6g, limits like "
                                    "+0.02/-0.01 or a roughness like Ra1.6")
                               : tr("a length like x 40, a fit like h7, limits like "
                                    "+0.02/-0.01 or a roughness like Ra1.6"));
  }

  // "+0.02 / -0.01" is one mistake; what stands behind a comma is another element.
  void add_hint(Word word, const std::string& said) {
    mistakes_.add(word, said);
    broken_off_ = word.ends_with(',');
    if (broken_off_) next_ = words_.size();
    while (next_ < words_.size() && hint(words_[next_]) == said) ++next_;
  }

  void read_length(Word word, Word rest) {
    const int before = lengths_++;
    const auto x = number(rest);
    if (const auto said = hint(word); !x && !said.empty()) return add_hint(word, said);
    if (!x) return mistakes_.add(word, tr("a length like x 40"));
    if (!in_range(word, *x, kLargest_mm, "mm", mistakes_)) return;
    if (before == 1 && e().shape == Shape::thread && !pitch_given_)
      e().pitch_mm = e().length_mm;
    else if (before > 0)
      return mistakes_.add(word, tr("one length"));
    e().length_mm = *x;
  }

  bool read_arc(Word word) {
    if (same(word, "convex") || same(word, "concave")) {
      e().convex = same(word, "convex");
      return true;
    }
    Word rest = word;
    if (!take(rest, {"r"}) || !begins_with_number(rest)) return false;
    const auto radius = number(rest);
    if (!radius)
      mistakes_.add(word, tr("a radius like R60"));
    else if (in_range(word, *radius, 1e6, "mm", mistakes_))
      e().radius_mm = *radius;
    radius_given_ = true;
    return true;
  }

  void read_fit(Word word) {
    if (e().shape == Shape::cone || e().shape == Shape::arc)
      return mistakes_.add(word,
                           tr("limits like +0.02/-0.01 here; fits are of cylinders, "
                              "grooves and threads"));
    if (e().demands.fit || e().demands.limits) return sized_twice(word);
    e().demands.fit = std::string(word);
  }

  void read_limits(Word word, const part::Limits& l) {
    if (e().demands.fit || e().demands.limits) return sized_twice(word);
    if (!(l.lower_mm < l.upper_mm))
      return mistakes_.add(word, tr("limits that differ, like +0.02/-0.01"));
    e().demands.limits = l;
  }

  void sized_twice(Word word) {
    mistakes_.add(word, tr("one fit, or limits instead of it"));
  }

  void finish() {
    if (lengths_ == 0 && !broken_off_)
      mistakes_.add(words_.back(), tr("a length like x 40 for this element"));
    if (e().shape == Shape::arc && !radius_given_)
      mistakes_.add(words_.back(), tr("a radius like R60 for this arc"));
  }

  const std::vector<Word>& words_;
  Mistakes& mistakes_;
  ReadElement out_;
  std::size_t next_ = 0;
  int lengths_ = 0;
  bool pitch_given_ = false, radius_given_ = false, broken_off_ = false;
};

}  // namespace

bool begins_element(Word word) {
  if (same(word, "bore") || shape_word(word) || part::inch_thread(word)) return true;
  return (take_d(word) || take(word, {"m"})) && begins_with_number(word);
}

ReadElement element(const std::vector<Word>& words, Mistakes& mistakes) {
  return ElementWords(words, mistakes).read();
}

}  // namespace turnwright::exchange::notated
