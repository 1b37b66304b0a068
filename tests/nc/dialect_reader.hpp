#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "turnwright/gcode/dialect.hpp"
#include "turnwright/nc/program.hpp"

/// A reader of programs as the manuals of their controls describe them, which shares no
/// words with the writer.  What it does not know it refuses.
namespace turnwright::nc::test {

/// What a control does with a block of coordinates.
struct Read {
  Move::Kind kind = Move::Kind::rapid;
  double x_mm = 0, z_mm = 0;  ///< radius and place where it ends
  Point centre = {};
  bool clockwise = false;
  double f_mm_rev = 0;
  double S = 0;
  bool surface_speed = false;
  double limit_rpm = 0;
  std::string turn;  ///< "M3", "M4", "" at rest
  bool coolant = false;
  int tool = 0, offset = 0;
  int stops = 0;  ///< M0 and M1 before
};

/// The words in which controls differ.
struct Manual {
  std::set<int> per_revolution;  ///< feed
  int limit = 0;                 ///< code of the spindle's limit, 0: a word
  std::string limit_word;        ///< with G96
  int thread = 0;
  char lead = 0;
  bool thread_cycle = false;    ///< the thread's code brings the tool back
  std::set<std::string> modes;  ///< words of the start that must all be there
  int T_digits = 0;             ///< 4 and 6: of the whole word, 3: tool, two of offset
  bool points = false;          ///< every length and feed has a point
};

inline const Manual& manual(Control control) {
  static const std::map<Control, Manual> kManuals{
      {Control::linuxcnc,
       {{95}, 0, "D", 33, 'K', false, {"G7", "G21", "G90", "G18"}, 0, false}},
      {Control::fanuc, {{99}, 50, "", 32, 'F', false, {"G21", "G18"}, 4, true}},
      {Control::fanuc_b, {{95}, 92, "", 33, 'F', false, {"G21", "G90", "G18"}, 4, true}},
      {Control::haas, {{99}, 50, "", 32, 'F', false, {"G21", "G18"}, 3, true}},
      {Control::siemens_iso,
       {{95}, 92, "", 33, 'F', false, {"G291", "G21", "G90", "G18"}, 4, true}},
      {Control::siemens,
       {{95}, 0, "LIMS", 33, 'K', false, {"DIAMON", "G710", "G90", "G18"}, 0, false}},
      {Control::okuma, {{95}, 50, "", 33, 'F', true, {"G90", "G18"}, 6, false}}};
  return kManuals.at(control);
}

class DialectReader {
 public:
  explicit DialectReader(Control control) : control_(control), m_(manual(control)) {}

  std::vector<Read> read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (ended_ && line != "%") fail(line, "after the end");
      take(line);
    }
    if (!ended_) fail("", "no M30");
    for (const auto& mode : m_.modes)
      if (!seen_.contains(mode)) fail(mode, "not selected");
    return moves_;
  }

  const std::vector<std::string>& comments() const { return comments_; }
  const std::vector<int>& numbers() const { return numbers_; }
  const std::set<std::string>& words() const { return seen_; }

 private:
  struct Word {
    std::string letter, value;
    double number() const { return std::stod(value); }
    int whole() const { return std::stoi(value); }
  };

  [[noreturn]] static void fail(const std::string& what, const std::string& why) {
    throw std::runtime_error(what + ": " + why);
  }

  bool comment(const std::string& line) {
    const bool semicolon = control_ == Control::siemens;
    if (line.empty() || line[0] != (semicolon ? ';' : '(')) return false;
    if (!semicolon && line.find(')') != line.size() - 1) fail(line, "a bad comment");
    comments_.push_back(line);
    return true;
  }

  // Words like X12.5, DIAMON, LIMS=2500 and G75.
  static std::vector<Word> words(const std::string& line) {
    std::vector<Word> all;
    std::istringstream in(line);
    for (std::string word; in >> word;) {
      const auto equals = word.find('=');
      const auto digits =
          equals != word.npos ? equals : word.find_first_of("0123456789.-");
      const auto value = equals != word.npos ? equals + 1 : digits;
      all.push_back({word.substr(0, digits),
                     value < word.size() ? word.substr(value) : std::string()});
    }
    return all;
  }

  void take(const std::string& line) {
    if (line == "%" || comment(line)) return;
    auto all = words(line);
    if (!all.empty() && all[0].letter == "N") {
      numbers_.push_back(all[0].whole());
      all.erase(all.begin());
    }
    if (all.empty()) fail(line, "an empty block");
    block_ = {};
    for (const auto& w : all) {
      if (!block_.emplace(w.letter, w).second && w.letter != "G") fail(line, "twice");
      seen_.insert(w.letter + w.value);
    }
    limit_block_ = false;
    reference_ = false;
    tap_ = std::any_of(all.begin(), all.end(),
                       [&](const Word& w) { return w.letter == "G" && taps(w.value); });
    for (const auto& w : all)
      if (w.letter == "G" && !tap_) code(w.whole(), line);
    if (reference_) return;
    for (const auto& w : all)
      if (!tap_ || w.letter == "S") word(w, line);
    if (tap_) return tap(line);
    if (block_.contains("X") || block_.contains("Z")) move(line);
  }

  bool taps(const std::string& G) const {
    switch (control_) {
      case Control::linuxcnc:
        return G == "33.1";
      case Control::siemens:
        return G == "331" || G == "332";
      case Control::okuma:
        return G == "77";
      default:
        return G == "84";
    }
  }

  // In with the spindle in step, and back to where it began; Siemens has a block for each.
  void tap(const std::string& line) {
    if (x_mm_ != 0 || now_.surface_speed || !per_revolution_) fail(line, "no way to tap");
    const auto value = [&](const char* letter) { return block_.at(letter).number(); };
    const double begins = z_mm_;
    Read in = now_;
    in.kind = Move::Kind::thread;
    in.x_mm = 0;
    in.z_mm = value("Z");
    in.f_mm_rev = value(m_.lead == 'K' ? "K" : "F");
    if (control_ == Control::siemens && !seen_.contains("SPOS0")) fail(line, "no SPOS");
    if (control_ == Control::haas && value("R") != begins) fail(line, "another R plane");
    if (block_.contains("R") && control_ != Control::haas && value("R") != 0)
      fail(line, "another R plane");
    add(in);
    if (control_ == Control::siemens) return;
    in.z_mm = begins;
    add(in);
  }

  void code(int g, const std::string& line) {
    if (g <= 3 || g == m_.thread)
      motion_ = g;
    else if (g == 96 || g == 97)
      now_.surface_speed = g == 96;
    else if (m_.per_revolution.contains(g))
      per_revolution_ = true;
    else if (g == m_.limit && m_.limit != 0)
      limit_block_ = true;
    else if (g == 28 || g == 75 || g == 20 || g == 53 || g == 91)
      reference_ = true;
    else if (g != 7 && g != 18 && g != 21 && g != 40 && g != 43 && g != 54 && g != 55 &&
             g != 61 && g != 80 && g != 90 && g != 291 && g != 710)
      fail(line, "an unknown code");
    if (g == 21 && control_ == Control::okuma) fail(line, "no unit there");
    if (g == 90 && (control_ == Control::fanuc || control_ == Control::haas))
      fail(line, "a cycle there");
    if (g == 20 && control_ != Control::okuma) fail(line, "inches");
  }

  void word(const Word& w, const std::string& line) {
    const auto& a = w.letter;
    if (m_.points && a.size() == 1 && std::string("XZIKF").find(a) != a.npos &&
        w.value.find('.') == w.value.npos)
      fail(line, "counts steps");
    if (a == "S" && limit_block_)
      now_.limit_rpm = w.number();
    else if (a == "S")
      now_.S = w.number();
    else if (a == m_.limit_word)
      now_.limit_rpm = w.number();
    else if (motion_ == m_.thread && a == std::string(1, m_.lead))
      lead_ = w.number();
    else if (motion_ == m_.thread && (a == "F" || a == "K" || a == "I"))
      fail(line, "no word of a thread");
    else if (a == "F")
      now_.f_mm_rev = w.number();
    else if (a == "T")
      tool(w);
    else if (a == "H" || (a == "D" && control_ == Control::siemens))
      now_.offset = w.whole();
    else if (a == "M")
      machine(w.whole(), line);
    else if (a != "G" && a != "X" && a != "Z" && a != "I" && a != "K" && a != "DIAMON" &&
             a != "O" && !(a == "SPOS" && control_ == Control::siemens))
      fail(line, "an unknown word");
  }

  void tool(const Word& w) {
    const auto& v = w.value;
    const auto n = v.size();
    if (m_.T_digits == 0) {
      now_.tool = w.whole();
      return;
    }
    if (m_.T_digits == 3 ? (n != 3 && n != 4)
                         : n != static_cast<std::size_t>(m_.T_digits))
      fail(v, "digits of T");
    now_.offset = std::stoi(v.substr(n - 2));
    now_.tool =
        std::stoi(v.substr(m_.T_digits == 6 ? 2 : 0, n - 2 - (m_.T_digits == 6 ? 2 : 0)));
  }

  void machine(int m, const std::string& line) {
    if (m == 0 || m == 1)
      ++now_.stops;
    else if (m == 3 || m == 4)
      now_.turn = m == 3 ? "M3" : "M4";
    else if (m == 5)
      now_.turn = "";
    else if (m == 9)
      now_.coolant = false;
    else if (m == 30)
      ended_ = true;
    else if (m == 29) {
      if (!block_.contains("S")) fail(line, "no speed to tap at");
    } else if (m != 6) {
      if (m < 7) fail(line, "an unknown code");
      now_.coolant = true;
    }
  }

  void move(const std::string& line) {
    if (!motion_) fail(line, "no motion");
    Read r = now_;
    const auto value = [&](const char* letter, double otherwise) {
      return block_.contains(letter) ? block_.at(letter).number() : otherwise;
    };
    const Point from{x_mm_, z_mm_};
    r.x_mm = value("X", 2 * x_mm_) / 2;
    r.z_mm = value("Z", z_mm_);
    if (*motion_ == 2 || *motion_ == 3) {
      r.kind = Move::Kind::arc;
      r.clockwise = *motion_ == 2;
      r.centre = {from.h_mm + value("I", 0), from.z_mm + value("K", 0)};
    } else if (*motion_ == m_.thread) {
      r.kind = Move::Kind::thread;
      r.f_mm_rev = lead_.value();
    } else {
      r.kind = *motion_ == 0 ? Move::Kind::rapid : Move::Kind::feed;
    }
    if (r.kind != Move::Kind::rapid && !per_revolution_) fail(line, "feed by the minute");
    if (r.kind == Move::Kind::thread && m_.thread_cycle) return cycle(r, from);
    add(r);
  }

  // In along X, along Z with the lead, out, and back.
  void cycle(const Read& cut, const Point& from) {
    Read in = cut, out = cut, back = cut;
    in.kind = out.kind = back.kind = Move::Kind::rapid;
    in.z_mm = from.z_mm;
    out.x_mm = back.x_mm = from.h_mm;
    back.z_mm = from.z_mm;
    for (const auto& r : {in, cut, out, back}) add(r);
  }

  void add(const Read& r) {
    moves_.push_back(r);
    x_mm_ = r.x_mm;
    z_mm_ = r.z_mm;
    now_.stops = 0;
  }

  Control control_;
  const Manual& m_;
  std::map<std::string, Word> block_;
  std::optional<int> motion_;
  std::optional<double> lead_;
  bool tap_ = false, per_revolution_ = false, limit_block_ = false, reference_ = false,
       ended_ = false;
  Read now_;
  double x_mm_ = 0, z_mm_ = 0;
  std::vector<Read> moves_;
  std::vector<std::string> comments_;
  std::vector<int> numbers_;
  std::set<std::string> seen_;
};

}  // namespace turnwright::nc::test
