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
  int stops = 0;       ///< M0 and M1 before
  bool mills = false;  ///< by the driven tool, the main spindle at rest
  double y_mm = 0, f_mm_min = 0, tool_rpm = 0, C_deg = 0;
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
  /// Drilling cycles that begin in the plane G17, whose third axis they drill along.
  bool drills_in_G17 = false;
};

/// Blocks with which a control mills: axis C on and off, the main spindle held and free, the
/// driven tool at the speed "#" and at rest.  LinuxCNC: spindles by "$" (G-code overview);
/// Haas: M154, M155, M14, M15, M133, M135; Okuma: M110, M109, M147, M146, SB=, M13, M12;
/// Siemens: SPOS, other spindles by their number; of the others the codes that a test gives.
struct MillManual {
  int per_minute = 94;
  std::string on = {}, off = {}, lock = {}, unlock = {};
  std::vector<std::string> tool_on = {};
  std::string tool_off = {};
};

inline const MillManual& mill_manual(Control control) {
  static const MillManual kBuilders{94, "M35", "M34", "M68", "M69", {"S# M13"}, "M15"};
  static const auto kSystemA = [] {
    auto m = kBuilders;
    m.per_minute = 98;
    return m;
  }();
  static const std::map<Control, MillManual> kManuals{
      {Control::linuxcnc, {94, "", "", "", "", {"S# M3 $1"}, "M5 $1"}},
      {Control::fanuc, kSystemA},
      {Control::fanuc_b, kBuilders},
      {Control::haas, {98, "M154", "M155", "M14", "M15", {"M133 P#"}, "M135"}},
      {Control::siemens_iso, kBuilders},
      {Control::siemens, {94, "", "", "", "", {"S2=# M2=3"}, "M2=5"}},
      {Control::okuma, {94, "M110", "M109", "M147", "M146", {"SB=#", "M13"}, "M12"}}};
  return kManuals.at(control);
}

/// From where a cycle feeds again before the depth reached [mm]: LinuxCNC 2.9 has 0.254 mm
/// in its source (interp_cycles.cc), in CYCLE83 it is an argument, elsewhere a parameter or
/// a setting of the control.
inline constexpr double kLinuxCncBack_mm = 0.254, kSetBack_mm = 0.5;

inline const Manual& manual(Control control) {
  static const std::map<Control, Manual> kManuals{
      {Control::linuxcnc,
       {{95}, 0, "D", 33, 'K', false, {"G7", "G21", "G90", "G18"}, 0, false, true}},
      {Control::fanuc, {{99}, 50, "", 32, 'F', false, {"G21", "G18"}, 4, true}},
      {Control::fanuc_b, {{95}, 92, "", 33, 'F', false, {"G21", "G90", "G18"}, 4, true}},
      {Control::haas, {{99}, 50, "", 32, 'F', false, {"G21", "G18"}, 3, true}},
      {Control::siemens_iso,
       {{95}, 92, "", 33, 'F', false, {"G291", "G21", "G90", "G18"}, 4, true}},
      {Control::siemens,
       {{95},
        0,
        "LIMS",
        33,
        'K',
        false,
        {"DIAMON", "G710", "G90", "G18"},
        0,
        false,
        true}},
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
    if (mills(line)) return;
    if (all[0].letter == "CYCLE" && control_ == Control::siemens) return call(line);
    block_ = {};
    for (const auto& w : all) {
      if (!block_.emplace(w.letter, w).second && w.letter != "G") fail(line, "twice");
      seen_.insert(w.letter + w.value);
    }
    limit_block_ = false;
    reference_ = false;
    drill_.reset();
    for (const auto& w : all)
      if (w.letter == "G" && drills(w.value)) drill_ = w.whole();
    tap_ = std::any_of(all.begin(), all.end(),
                       [&](const Word& w) { return w.letter == "G" && taps(w.value); });
    for (const auto& w : all)
      if (w.letter == "G" && !tap_ && w.whole() != drill_) code(w.whole(), line);
    if (reference_) return;
    for (const auto& w : all)
      if (drill_.has_value() ? w.letter == "F" : !tap_ || w.letter == "S") word(w, line);
    if (tap_) return tap(line);
    if (drill_) return drill(line);
    if (block_.contains("X") || block_.contains("Y") || block_.contains("Z")) move(line);
  }

  // Whether a block, which may have a number, belongs to milling alone; what it does.
  bool mills(const std::string& numbered) {
    const bool has_number = numbered[0] == 'N';
    const auto line = has_number ? numbered.substr(numbered.find(' ') + 1) : numbered;
    const auto& m = mill_manual(control_);
    const auto is = [&](const std::string& block) {
      return !block.empty() && line == block;
    };
    const bool known = is(m.on) || is(m.off) || is(m.lock) || is(m.unlock);
    if ((known || tool_speed(line, m)) && !now_.turn.empty())
      fail(line, "while the main spindle turns");
    if (is(m.on) || is(m.off)) {
      if (now_.mills || c_axis_ == is(m.on)) fail(line, "axis C");
      c_axis_ = is(m.on);
      return true;
    }
    if (is(m.lock) || is(m.unlock)) {
      if (now_.mills) fail(line, "while the tool turns");
      held_ = is(m.lock);
      return true;
    }
    const auto angle = control_ == Control::siemens ? "SPOS=" : "G0 C";
    if (line.starts_with(angle) && (control_ != Control::siemens || !per_revolution_)) {
      if (held_ || now_.mills || (!m.on.empty() && !c_axis_)) fail(line, "cannot turn");
      if (m_.points && line.find('.') == line.npos) fail(line, "counts steps");
      now_.C_deg = std::stod(line.substr(std::string(angle).size()));
      return true;
    }
    if (const auto speed = tool_speed(line, m)) {
      if (!m.lock.empty() && !held_) fail(line, "the part is not held");
      if (*speed >= 0) now_.tool_rpm = *speed;
      now_.mills = line == m.tool_on.back() || m.tool_on.size() == 1;
      return true;
    }
    if (!is(m.tool_off)) return false;
    if (!now_.mills) return false;
    now_.mills = false;
    return true;
  }

  // The speed in a block that turns the driven tool on; -1 if it has none.
  static std::optional<double> tool_speed(const std::string& line, const MillManual& m) {
    for (const auto& block : m.tool_on) {
      const auto at = block.find('#');
      if (at == block.npos) {
        if (line == block) return -1;
        continue;
      }
      const auto before = block.substr(0, at), behind = block.substr(at + 1);
      if (!line.starts_with(before) || !line.ends_with(behind)) continue;
      const auto digits = line.substr(at, line.size() - before.size() - behind.size());
      if (!digits.empty() && digits.find_first_not_of("0123456789") == digits.npos)
        return std::stod(digits);
    }
    return std::nullopt;
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

  bool drills(const std::string& G) const {
    switch (control_) {
      case Control::siemens:
        return false;  // by calls
      case Control::okuma:
        return G == "74";
      case Control::linuxcnc:
      case Control::haas:
        return G == "81" || G == "83";
      default:
        return G == "83";
    }
  }

  // Pecks of the lengths that `length` gives after the depth reached, down to `bottom`, each
  // time out to `R`.
  template <class Length>
  void peck(double R, double bottom, double back, Length length,
            const std::string& line) {
    const bool plane = plane_ == (m_.drills_in_G17 ? 17 : 18);
    if (!plane) fail(line, "drilled along another axis");
    if (x_mm_ != 0 || z_mm_ != R || !(bottom < R) || now_.surface_speed ||
        !per_revolution_ || !(now_.f_mm_rev > 0))
      fail(line, "no way to drill");
    Read in = now_;
    in.x_mm = 0;
    in.kind = Move::Kind::feed;
    for (double at = R; at > bottom + 1e-9;) {
      if (at < R) {
        in.z_mm = at + back;
        in.kind = Move::Kind::rapid;
        add(in);
      }
      const double peck = length(R - at);
      if (!(peck > 0)) fail(line, "no peck");
      at = std::max(bottom, at - peck);
      in.z_mm = at;
      in.kind = Move::Kind::feed;
      add(in);
      in.z_mm = R;
      in.kind = Move::Kind::rapid;
      add(in);
    }
  }

  void drill(const std::string& line) {
    const auto value = [&](const char* letter, double otherwise) {
      return block_.contains(letter) ? block_.at(letter).number() : otherwise;
    };
    const double Z = block_.at("Z").number(), whole = z_mm_ - Z;
    const auto in_one = [&](double) { return whole; };
    for (const auto& [letter, word] : block_)
      if (std::string("NGXZRQFIJKD").find(letter) == std::string::npos)
        fail(line, "an unknown word of a hole");
    if (value("X", 0) != 0) fail(line, "beside the axis");
    if (control_ == Control::okuma) {  // G74: D a peck, the way back is a parameter
      if (value("D", 0) < whole - 1e-9) fail(line, "pecks that come back a little");
      return peck(z_mm_, Z, 0, in_one, line);
    }
    // LinuxCNC and Haas: the place of the plane R; Fanuc: from where the tool stands.
    const bool place = control_ == Control::linuxcnc || control_ == Control::haas;
    if (block_.at("R").number() != (place ? z_mm_ : 0)) fail(line, "another R plane");
    cycle_on_ = true;
    if (drill_ == 81) return peck(z_mm_, Z, 0, in_one, line);
    if (control_ == Control::haas) {  // the first I, less by J each time, K at least
      const double I = value("I", 0), J = value("J", 0), K = value("K", 0);
      double next = I;
      const auto less = [&](double) {
        const double now = next;
        next = std::max(next - J, K);
        return now;
      };
      return peck(z_mm_, Z, kSetBack_mm, less, line);
    }
    const double unit = control_ == Control::linuxcnc ? 1 : 1e-3;
    if (unit < 1 && block_.contains("Q") &&
        block_.at("Q").value.find('.') != std::string::npos)
      fail(line, "Q counts steps");
    if (control_ == Control::linuxcnc && !block_.contains("Q")) fail(line, "no Q");
    const double Q = unit * value("Q", whole / unit);
    peck(
        z_mm_, Z, unit < 1 ? kSetBack_mm : kLinuxCncBack_mm, [&](double) { return Q; },
        line);
  }

  // CYCLE81, CYCLE83 and CYCLE97 with their arguments in the order of the manual, from 1.
  void call(const std::string& line) {
    const auto open = line.find('('), close = line.find(')');
    if (close != line.size() - 1) fail(line, "no call");
    std::vector<std::optional<double>> given{std::nullopt};
    std::istringstream in(line.substr(open + 1, close - open - 1));
    for (std::string one; std::getline(in, one, ',');)
      given.push_back(one.empty() ? std::nullopt : std::optional(std::stod(one)));
    given.resize(18);
    const auto at = [&](std::size_t i) { return given[i].value_or(0); };
    if (line.find("CYCLE97(") != line.npos) return thread(line, at);
    // RTP, RFP, SDIS, DP: back to, surface, distance before it, bottom.
    const double R = at(2) + at(3), bottom = at(4), whole = R - bottom;
    if (at(1) != R) fail(line, "back to another plane");
    if (line.find("CYCLE81(") != line.npos)
      return peck(
          R, bottom, 0, [&](double) { return whole; }, line);
    if (line.find("CYCLE83(") == line.npos) fail(line, "an unknown cycle");
    // 6 FDEP the first place, 8 DAM < 0: each peck that share of the last, 11 FRF the share
    // of the first feed, 12 VARI 1 all the way out, 14 _MDEP the least, 17 _DIS1 before the
    // depth reached.
    if (at(12) != 1 || at(11) != 1 || !(at(8) < 0 && at(8) > -1) || at(9) || at(10))
      fail(line, "another way to peck");
    double next = R - at(6);
    const auto less = [&](double) {
      const double now = next;
      next = std::max(-at(8) * next, at(14));
      return now;
    };
    peck(R, bottom, at(17), less, line);
  }

  // 1 PIT, 3 SPL, 4 FPL, 5 DM1, 6 DM2, 7 APP before SPL, 8 ROP beyond FPL, 9 TDEP, 10 FAL the
  // last cut, 13 NRC the others, which are of one section if 15 VARI is 3 outside, 4 inside;
  // 17 _VRT how far it draws out, 0: 1 mm.
  template <class At>
  void thread(const std::string& line, At at) {
    if (at(15) != 3 && at(15) != 4) fail(line, "infeeds of one depth");
    if (at(11) || at(12) || at(14) || at(16) != 1 || at(5) != at(6) || now_.surface_speed)
      fail(line, "another thread");
    const double side = at(15) == 3 ? 1 : -1, out = at(17) ? at(17) : 1;
    const double before = at(3) + at(7), end = at(4) - at(8);
    const double rough = at(9) - at(10), n = at(13);
    const Point from{at(5) / 2 + side * out, before};
    Read cut = now_;
    cut.f_mm_rev = at(1);
    cut.kind = Move::Kind::thread;
    cut.z_mm = end;
    for (int k = 1; k <= n + 1; ++k) {
      const double deep = k <= n ? rough * std::sqrt(k / n) : at(9);
      cut.x_mm = at(5) / 2 - side * deep;
      cycle(cut, from);
    }
  }

  void code(int g, const std::string& line) {
    if (g == 17 || g == 18) plane_ = g;
    if (g == 80) cycle_on_ = false;
    if (g == 17 && !m_.drills_in_G17) fail(line, "an unknown code");
    if (g == mill_manual(control_).per_minute) {
      if (!now_.turn.empty()) fail(line, "while the main spindle turns");
      per_revolution_ = false;
      return;
    }
    if (g == 98 && !(control_ == Control::linuxcnc && drill_.has_value()))
      fail(line, "another feed");
    if (g == 17 || g == 98) return;
    if (g <= 3 || g == m_.thread)
      motion_ = g;
    else if (g == 96 || g == 97)
      now_.surface_speed = g == 96;
    else if (m_.per_revolution.contains(g))
      end_milling(line);
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

  void end_milling(const std::string& line) {
    if (now_.mills || c_axis_ || held_) fail(line, "while it mills");
    per_revolution_ = true;
  }

  void word(const Word& w, const std::string& line) {
    const auto& a = w.letter;
    if (!per_revolution_ && a == "F") {
      now_.f_mm_min = w.number();
      return;
    }
    if (!per_revolution_ && a == "Y") return;
    if (m_.points && a.size() == 1 && std::string("XYZIKF").find(a) != a.npos &&
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
    if (plane_ != 18) fail(line, "turned in another plane");
    if (cycle_on_) fail(line, "while a cycle is on");
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
    if (block_.contains("Y") && per_revolution_) fail(line, "turned beside the axis");
    r.y_mm = y_mm_ = value("Y", y_mm_);
    if (!now_.turn.empty() && now_.mills) fail(line, "both spindles turn");
    if (r.kind != Move::Kind::rapid && !per_revolution_ && !now_.mills)
      fail(line, "feed by the minute");
    if (r.kind != Move::Kind::rapid && per_revolution_ && now_.turn.empty())
      fail(line, "cut at rest");
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
  int plane_ = 0;
  std::optional<int> drill_;
  bool cycle_on_ = false;
  bool tap_ = false, per_revolution_ = false, limit_block_ = false, reference_ = false,
       ended_ = false;
  Read now_;
  bool c_axis_ = false, held_ = false;
  double x_mm_ = 0, y_mm_ = 0, z_mm_ = 0;
  std::vector<Read> moves_;
  std::vector<std::string> comments_;
  std::vector<int> numbers_;
  std::set<std::string> seen_;
};

}  // namespace turnwright::nc::test
