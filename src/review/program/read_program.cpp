#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "contour_cycle.hpp"
#include "cycles.hpp"
#include "modal_state.hpp"
#include "turnwright/base/cancelled.hpp"
#include "words.hpp"

namespace turnwright::review {
namespace {

using gcode::Control;
using toolpath::Move;
using toolpath::Point;

constexpr double kRadii_mm = 0.02;  // by which the ends of an arc may differ

bool system_a(Control c) { return c == Control::fanuc || c == Control::haas; }

// G codes that change nothing here: planes, cancellations, exact stop, retract levels.
constexpr std::array kIdle{4, 17, 18, 40, 43, 49, 61, 64, 80, 291, 601, 602, 603};

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

std::string trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(" \t\r");
  if (from == text.npos) return "";
  return std::string(text.substr(from, text.find_last_not_of(" \t\r") + 1 - from));
}

// Centre of an arc of a radius through two points, as seen with X up and Z to the right;
// the longer arc for R < 0.  None if the ends are too far apart.
std::optional<Point> centre_of(const Point& a, const Point& b, double R, bool clockwise) {
  const double dh = b.h_mm - a.h_mm, dz = b.z_mm - a.z_mm;
  const double chord = std::hypot(dh, dz), rest = R * R - chord * chord / 4;
  if (!(chord > 0) || !(rest > -2 * std::abs(R) * kRadii_mm)) return std::nullopt;
  const double off = std::sqrt(std::max(0.0, rest)) / chord;
  const double side = clockwise == (R > 0) ? 1 : -1;
  return Point{a.h_mm + dh / 2 - side * off * dz, a.z_mm + dz / 2 + side * off * dh};
}

class ProgramReader {
 public:
  ProgramReader(const std::vector<std::string_view>& lines, const ReadOptions& options)
      : lines_(lines),
        control_(options.control),
        words_(gcode::dialect(options.control)),
        s_(options) {
    s_.diameter = control_ != Control::linuxcnc && control_ != Control::siemens;
    s_.per_revolution = control_ != Control::linuxcnc;
  }

  void line(std::size_t number, std::string_view text) {
    s_.line = number;
    if (trimmed(text).starts_with('%')) return;
    const auto block = block_of(text, control_ == Control::siemens);
    for (const auto& c : block.comments) name_tool(c);
    if (ended_ || skipped(block) || unreadable(block)) return;
    if (block.deletable && !block.words.empty())
      s_.assume("Blocks with a slash are taken as executed.");
    take(block);
  }

  bool full() const { return s_.full(); }

  TurningProgram result() {
    if (s_.full())
      s_.unknown("the rest of the program", "It has more moves than are followed.");
    return std::move(s_.program);
  }

 private:
  // "T1 PCLNL-CNMG120408-PM, corner 0.8 mm".
  void name_tool(const std::string& comment) {
    const auto words = trimmed(comment);
    if (words.size() < 4 || words[0] != 'T' || !std::isdigit(words[1])) return;
    const auto blank = words.find(' ');
    if (blank == words.npos || blank > 4) return;
    const auto corner = lower(words).find(", corner");
    const auto name = trimmed(std::string_view(words).substr(blank, corner - blank));
    s_.program.named_tools.emplace(std::stoi(words.substr(1, blank - 1)), name);
  }

  // Subprograms that LinuxCNC defines in the program, and contours of cycles.
  bool skipped(const Block& block) {
    auto rest = lower(trimmed(block.rest));
    const bool named = rest.starts_with("o<") && rest.find('>') != rest.npos;
    if (named) rest = trimmed(std::string_view(rest).substr(rest.find('>') + 1));
    const bool numbered = !block.words.empty() && block.words[0].name == "O";
    const bool o_word = control_ == Control::linuxcnc && (named || numbered);
    if (o_word && rest.starts_with("endsub")) {
      in_subprogram_ = false;
      return true;
    }
    if (o_word && rest.starts_with("sub")) in_subprogram_ = true;
    if (in_subprogram_) return true;
    if (!contour_end_) return false;
    if (block.value("N") == contour_end_) contour_end_.reset();
    return true;
  }

  bool unreadable(const Block& block) {
    if (block.rest.empty()) return false;
    s_.unknown(trimmed(block.rest),
               "Variables, expressions, calls and loops are not followed; the block may "
               "have moved the tool.");
    s_.lose_place();
    return true;
  }

  void take(const Block& block) {
    special_ = Special::none;
    for (const auto& w : block.words)
      if (w.name == "G" && w.value) code(*w.value, block);
    for (const auto& w : block.words)
      if (w.name != "G") word(w, block);
    tell_repeated(block);
    if (motion_ < 4) box_end_.reset();
    if (special_ == Special::done) return;
    if (special_ == Special::thread_cycle) return threads_.take(s_, control_, block);
    if (special_ == Special::contour) return contour_cycle(block);
    if (special_ == Special::tap) return tap(block);
    move(block);
    for (const auto& w : block.words)
      if (w.name == "M" && w.value) ends(static_cast<int>(*w.value));
  }

  void code(double value, const Block& block) {
    const int g = static_cast<int>(value);
    if (value != g) return fraction(value);
    if (g >= 0 && g <= 3)
      motion_ = g;
    else if ((g == 32 && system_a(control_)) || (g == 33 && !system_a(control_)))
      motion_ = g;
    else if (g == 76)
      special_ = Special::thread_cycle;
    else if (taps(g))
      special_ = Special::tap;
    else if ((g == 70 || g == 71) && system_a(control_)) {
      special_ = Special::contour;
      contour_code_ = g;
    } else if (g == 96 || g == 97)
      s_.surface_speed = g == 96;
    else if (!units(g) && !feeds_and_boxes(g) && !zeros(g, block) &&
             std::ranges::find(kIdle, g) == kIdle.end())
      strange(g, block);
  }

  bool taps(int g) const {
    if (control_ == Control::siemens) return g == 331 || g == 332;
    if (control_ == Control::okuma) return g == 77;
    return g == 84 && control_ != Control::linuxcnc;
  }

  // Codes with a decimal.
  void fraction(double value) {
    if (control_ == Control::linuxcnc && std::abs(value - 33.1) < 1e-6) {
      special_ = Special::tap;
      return;
    }
    if (std::abs(value - 92.1) < 1e-6 || std::abs(value - 92.2) < 1e-6) {
      s_.suspended.clear();
      s_.lose_place();
    } else if (std::abs(value - 91.1) > 1e-6 && std::abs(value - 7.1) > 1e-6) {
      s_.unknown(fmt::format("G{}", value), "The code is not known.");
    }
  }

  bool units(int g) {
    const bool siemens = control_ == Control::siemens;
    if (g == 20 && control_ == Control::okuma) return false;
    if (g == 20 || g == 21) s_.inch = g == 20;
    if (siemens && (g == 70 || g == 71 || g == 700 || g == 710))
      s_.inch = g == 70 || g == 700;
    if (control_ == Control::linuxcnc && (g == 7 || g == 8)) s_.diameter = g == 7;
    return g == 20 || g == 21 || (siemens && (g == 70 || g == 71 || g > 699)) ||
           (control_ == Control::linuxcnc && (g == 7 || g == 8));
  }

  // What systems A and B of Fanuc's codes, which others follow, have under one number.
  bool feeds_and_boxes(int g) {
    if (system_a(control_)) {
      if (g == 98 || g == 99) s_.per_revolution = g == 99;
      if (g == 90 || g == 92 || g == 94) motion_ = g;
      return g == 98 || g == 99 || g == 90 || g == 92 || g == 94;
    }
    if (g == 94 || g == 95) s_.per_revolution = g == 95;
    if (g == 90 || g == 91) s_.incremental = g == 91;
    return g == 94 || g == 95 || g == 90 || g == 91 || g == 98 || g == 99;
  }

  // Limits of the spindle, zeros, and returns to places that are not known.
  bool zeros(int g, const Block& block) {
    const bool limit = g == 50 || (g == 92 && !system_a(control_));
    const bool moves = block.find("X") || block.find("Z");
    if (limit && !moves) {
      special_ = Special::limit;
      return true;
    }
    if (limit || g == 10 || g == 52) {
      s_.suspended = fmt::format("G{} shifts the zero, which is not followed.", g);
      special_ = Special::done;
      return true;
    }
    if (g >= 54 && g <= 59) {
      if (work_offset_ != 0 && work_offset_ != g)
        s_.suspended = "Another work offset, whose zero is not known.";
      else
        s_.suspended.clear();
      if (work_offset_ == 0) work_offset_ = g;
      return true;
    }
    const bool okuma_home = g == 20 && control_ == Control::okuma;
    if (g != 28 && g != 30 && g != 53 && g != 75 && !okuma_home) return false;
    s_.lose_place();
    special_ = Special::done;
    return true;
  }

  void strange(int g, const Block& block) {
    const auto name = fmt::format("G{}", g);
    if (g == 41 || g == 42)
      return s_.unknown(name,
                        "Tool nose radius compensation: cones and arcs are taken as the "
                        "path of the tip, which may be off by the corner's radius.");
    const bool cycle = (g >= 70 && g <= 89) || g == 32 || g == 33;
    s_.unknown(name, cycle ? "The cycle is not followed." : "The code is not known.");
    if (!cycle) return;
    s_.lose_place();
    special_ = Special::done;
    // The blocks between P and Q are its contour.
    if (system_a(control_) && block.find("P") && block.find("Q"))
      contour_end_ = block.value("Q");
  }

  void word(const Word& w, const Block& block) {
    const auto value = w.value.value_or(0);
    if (w.name == "F" && motion_ != 92 && special_ != Special::thread_cycle &&
        special_ != Special::tap)
      feed(value);
    else if (w.name == "S")
      special_ == Special::limit ? limit(value) : speed(value);
    else if (w.name == "LIMS" ||
             (w.name == "D" && control_ == Control::linuxcnc && s_.surface_speed))
      limit(value);
    else if (w.name == "T")
      tool(w);
    else if (w.name == "M")
      machine(static_cast<int>(value), w.text);
    else if (w.name == "DIAMON" || w.name == "DIAMOF")
      s_.diameter = w.name == "DIAMON";
    else if (w.name == "SPOS")  // the spindle stops for a tap, which G331 turns
      return;
    else if (w.name.size() > 1 && !block.find("G"))
      s_.unknown(w.text, "The word is not known.");
    if (w.name.size() == 1 &&
        std::string_view("ABCVY").find(w.name) != std::string_view::npos)
      s_.unknown(w.text, "Only the axes X and Z are followed.");
    if (w.name == "E" && special_ == Special::none && motion_ < 4)
      s_.unknown(
          w.text,
          "The letter belongs to threads; a number before it ends there, it has no "
          "exponent.");
  }

  // Codes alone may stand twice in a block.
  void tell_repeated(const Block& block) {
    for (const auto& w : block.words)
      if (w.name != "G" && w.name != "M" && block.find(w.name) != &w)
        s_.unknown(w.text,
                   "The letter stands twice in the block, which controls refuse.");
  }

  void feed(double value) {
    s_.F = s_.mm(value);
    s_.F_line = s_.line;
  }
  void speed(double value) {
    s_.S = value;
    s_.S_line = s_.line;
  }
  void limit(double n_rpm) {
    if (n_rpm >= 1) s_.limit_rpm = n_rpm;
  }

  void tool(const Word& w) {
    const int v = static_cast<int>(w.value.value_or(0));
    const bool station = control_ == Control::linuxcnc || control_ == Control::siemens;
    const int number = station || v < 100           ? v
                       : control_ == Control::okuma ? v / 100 % 100
                                                    : v / 100;
    s_.chosen_tool = number;
    if (control_ != Control::linuxcnc) s_.tool = number;
  }

  void machine(int m, const std::string& text) {
    if (m == 3 || m == 4) s_.turning = true;
    if (m == 6) s_.tool = s_.chosen_tool;
    if ((m >= 97 && m <= 99) && control_ != Control::siemens)
      s_.unknown(text, "Subprograms are not followed.");
  }

  // Codes that act after the motion of their block.
  void ends(int m) {
    if (m == 0 || m == 1) s_.stop();
    if (m == 5) s_.turning = false;
    if (m == 2 || m == 30) ended_ = true;
  }

  struct Target {
    std::optional<double> x, z;
  };
  Target target(const Block& block) {
    const double half = s_.diameter ? 0.5 : 1;
    const auto absolute = [&](const char* name, double scale,
                              std::optional<double> now) -> std::optional<double> {
      const auto v = block.value(name);
      if (!v) return std::nullopt;
      if (words_.point && !block.find(name)->point)
        s_.assume("Numbers without a point are millimetres or inches, not steps.");
      if (!s_.incremental) return s_.mm(*v) * scale;
      return now ? std::optional(*now + s_.mm(*v) * scale) : std::nullopt;
    };
    Target t{absolute("X", half, s_.x_mm), absolute("Z", 1, s_.z_mm)};
    if (!system_a(control_)) return t;
    if (const auto u = block.value("U"); u && s_.x_mm) t.x = *s_.x_mm + s_.mm(*u) * half;
    if (const auto w = block.value("W"); w && s_.z_mm) t.z = *s_.z_mm + s_.mm(*w);
    return t;
  }

  static bool names_a_place(const Block& block, bool arcs) {
    for (const char* name : {"X", "Z", "U", "W"})
      if (block.find(name)) return true;
    return arcs && (block.find("I") || block.find("K"));
  }

  void move(const Block& block) {
    if (special_ == Special::limit || !names_a_place(block, motion_ == 2 || motion_ == 3))
      return;
    const auto t = target(block);
    switch (motion_) {
      case 0:
        return s_.straight(Move::Kind::rapid, t.x, t.z);
      case 1:
        return s_.straight(Move::Kind::feed, t.x, t.z);
      case 2:
      case 3:
        return arc(block, t);
      default:
        break;
    }
    if (!s_.x_mm || !s_.z_mm) {
      s_.unknown("a cut from a place that is not known",
                 "It is not followed: X or Z was not given before it.");
      return s_.straight(Move::Kind::rapid, t.x, t.z);
    }
    const bool plain = (motion_ == 32 || motion_ == 33) && !words_.thread_returns;
    if (plain || !box_end_) box_end_ = Point{*s_.x_mm, *s_.z_mm};
    // What a block does not say is that of the box before.
    if (t.x) box_end_->h_mm = *t.x;
    if (t.z) box_end_->z_mm = *t.z;
    if (motion_ == 32 || motion_ == 33)
      return thread(block, box_end_->h_mm, box_end_->z_mm);
    box(block, box_end_->h_mm, box_end_->z_mm);
  }

  // On the axis, with the spindle in step.  Siemens has a block for each way.
  void tap(const Block& block) {
    const auto t = target(block);
    if (t.x && t.x != s_.x_mm) s_.straight(Move::Kind::rapid, t.x, s_.z_mm);
    const bool own_words = words_.lead == 'K';
    const double lead = s_.mm(block.value(own_words ? "K" : "F").value_or(0));
    if (!t.z || !s_.z_mm)
      return s_.unknown("a tap that is not followed", "Z was not given before or in it.");
    if (control_ == Control::siemens && s_.x_mm) return s_.thread(*s_.x_mm, *t.z, lead);
    const double R = s_.mm(block.value("R").value_or(0));
    const bool absolute = control_ == Control::haas && block.find("R");
    tap_cycle(s_, absolute ? R : *s_.z_mm + R, *t.z, lead);
  }

  // G90, G92 and G94 of system A.
  void box(const Block& block, double x, double z) {
    if (block.value("R").value_or(0) != 0)
      s_.unknown("R of a cycle", "Its taper is not followed.");
    if (block.find("F") && motion_ == 92) lead_mm_ = s_.mm(*block.value("F"));
    box_cycle(s_,
              motion_ == 90   ? Box::turning
              : motion_ == 94 ? Box::facing
                              : Box::threading,
              x, z, lead_mm_);
  }

  void thread(const Block& block, double x, double z) {
    const auto lead = block.value(std::string(1, words_.lead));
    if (lead) lead_mm_ = s_.mm(*lead);
    if (words_.thread_returns) return box_cycle(s_, Box::threading, x, z, lead_mm_);
    s_.thread(x, z, lead_mm_);
  }

  void arc(const Block& block, const Target& t) {
    if (!s_.x_mm || !s_.z_mm)
      return s_.straight(Move::Kind::feed, t.x, t.z);  // tells that it is not followed
    const Point from{*s_.x_mm, *s_.z_mm};
    const Point to{t.x.value_or(from.h_mm), t.z.value_or(from.z_mm)};
    const bool clockwise = motion_ == 2;
    std::optional<Point> centre;
    if (const auto R = block.value("R"))
      centre = centre_of(from, to, s_.mm(*R), clockwise);
    else
      centre = Point{from.h_mm + s_.mm(block.value("I").value_or(0)),
                     from.z_mm + s_.mm(block.value("K").value_or(0))};
    const auto radius = [&](const Point& p) {
      return std::hypot(p.h_mm - centre->h_mm, p.z_mm - centre->z_mm);
    };
    if (!centre || !(radius(from) > 0) ||
        !(std::abs(radius(from) - radius(to)) <= kRadii_mm)) {
      s_.unknown("an arc whose ends do not fit its centre", "It is taken as straight.");
      return s_.straight(Move::Kind::feed, to.h_mm, to.z_mm);
    }
    s_.to({Move::Kind::arc, to.h_mm, to.z_mm, *centre, clockwise});
  }

  // G71 and G70 of system A.  The first block of Fanuc's G71 has the depth alone.
  void contour_cycle(const Block& block) {
    const auto P = block.value("P"), Q = block.value("Q");
    if (!P || !Q) {
      roughing_.depth_mm = s_.mm(block.value("U").value_or(0));
      roughing_.retract_mm = s_.mm(block.value("R").value_or(0));
      return;
    }
    if (const auto depth = block.value("D")) roughing_.depth_mm = s_.mm(*depth);
    const auto contour = contour_between(*P, *Q);
    if (!contour)
      return s_.unknown(fmt::format("P{:g} Q{:g}", *P, *Q),
                        "There are no such blocks behind the cycle.");
    if (contour_code_ == 70) return finish(s_, *contour);
    contour_end_ = *Q;
    roughing_.left_x_mm = s_.mm(block.value("U").value_or(0)) / 2;
    roughing_.left_z_mm = s_.mm(block.value("W").value_or(0));
    rough(s_, *contour, roughing_);
  }

  // The moves of the blocks from N = P to N = Q, as if they followed.
  std::optional<Contour> contour_between(double P, double Q) {
    if (in_contour_) return std::nullopt;
    ProgramReader inner(*this);
    inner.in_contour_ = true;
    inner.s_.program = {};
    inner.s_.turning = true;
    bool inside = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const auto block = block_of(lines_[i], false);
      inside = inside || block.value("N") == P;
      if (!inside) continue;
      inner.line(i + 1, lines_[i]);
      if (block.value("N") != Q) continue;
      for (auto& u : inner.s_.program.unknown) s_.unknown(u.what, u.why);
      return Contour{std::move(inner.s_.program.runs)};
    }
    return std::nullopt;
  }

  enum class Special { none, done, limit, thread_cycle, contour, tap };

  const std::vector<std::string_view>& lines_;
  Control control_;
  const gcode::Dialect& words_;
  ModalState s_;
  ThreadCycleReader threads_;
  int motion_ = 0;
  Special special_ = Special::none;
  int work_offset_ = 0;
  double lead_mm_ = 0;
  std::optional<Point> box_end_;  // of the cycle before
  bool in_subprogram_ = false, ended_ = false;
  std::optional<double> contour_end_;
  bool in_contour_ = false;
  int contour_code_ = 0;
  RoughingCycle roughing_;
};

}  // namespace

TurningProgram read_program(std::string_view text, const ReadOptions& options) {
  const auto lines = lines_of(text);
  ProgramReader reader(lines, options);
  for (std::size_t i = 0; i < lines.size() && !reader.full(); ++i) {
    leave_if_asked();
    reader.line(i + 1, lines[i]);
  }
  return reader.result();
}

}  // namespace turnwright::review
