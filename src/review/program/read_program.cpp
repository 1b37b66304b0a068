#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/say.hpp"
#include "contour_cycle.hpp"
#include "cycles.hpp"
#include "drill_cycle_reader.hpp"
#include "expression.hpp"
#include "flow.hpp"
#include "g7x_cycle.hpp"
#include "macro_statements.hpp"
#include "milling_words.hpp"
#include "modal_state.hpp"
#include "o_words.hpp"
#include "okuma_lap.hpp"
#include "okuma_statements.hpp"
#include "siemens_cycles.hpp"
#include "siemens_statements.hpp"
#include "turnwright/base/cancelled.hpp"
#include "words.hpp"

namespace turnwright::review {
namespace {

using gcode::Control;
using toolpath::Move;
using toolpath::Point;

constexpr double kRadii_mm = 0.02;        // by which the ends of an arc may differ
constexpr double kLargestProgram = 9999;  // more digits of P are times

constexpr double kOkumaBack_mm = 0.5;  // after a peck of G74

bool system_a(Control c) { return c == Control::fanuc || c == Control::haas; }

// G codes that change nothing here: planes, cancellations, exact stop, retract levels.
constexpr std::array kIdle{43, 49, 61, 64, 291, 601, 602, 603};

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

// Whether a control reckons as custom macro B does.
bool has_macros(Control c) {
  return system_a(c) || c == Control::fanuc_b || c == Control::siemens_iso;
}

// The variables of G65's arguments.
std::map<int, double> macro_arguments(const Block& block) {
  static const std::map<char, int> kNumbers{
      {'A', 1},  {'B', 2},  {'C', 3},  {'I', 4},  {'J', 5},  {'K', 6},  {'D', 7},
      {'E', 8},  {'F', 9},  {'H', 11}, {'M', 13}, {'Q', 17}, {'R', 18}, {'S', 19},
      {'T', 20}, {'U', 21}, {'V', 22}, {'W', 23}, {'X', 24}, {'Y', 25}, {'Z', 26}};
  std::map<int, double> all;
  for (const auto& w : block.words) {
    const auto number = kNumbers.find(w.name.front());
    if (number != kNumbers.end() && w.value) all.emplace(number->second, *w.value);
  }
  return all;
}

class ProgramReader {
 public:
  ProgramReader(Flow& flow, const ReadOptions& options)
      : flow_(flow),
        o_words_(options.control == Control::linuxcnc ? std::make_shared<OWords>(flow)
                                                      : nullptr),
        macros_(has_macros(options.control) ? std::make_shared<MacroStatements>(flow)
                                            : nullptr),
        siemens_(options.control == Control::siemens
                     ? std::make_shared<SiemensStatements>(flow)
                     : nullptr),
        okuma_(options.control == Control::okuma ? std::make_shared<OkumaStatements>(flow)
                                                 : nullptr),
        control_(options.control),
        words_(gcode::dialect(options.control)),
        s_(options) {
    for (const auto line : flow.lines()) name_tools(line);
    s_.diameter = control_ != Control::linuxcnc && control_ != Control::siemens;
    s_.per_revolution = control_ != Control::linuxcnc;
  }

  void follow() {
    for (auto at = flow_.next(); at && !ended_ && !s_.full(); at = flow_.next()) {
      leave_if_asked();
      line(*at);
    }
  }

  TurningProgram result() {
    s_.line = flow_.line() + 1;
    if (s_.full())
      s_.unknown(tr("the rest of the program"),
                 tr("It has more moves than are followed."));
    else if (flow_.endless() && !ended_)
      s_.unknown(
          tr("the rest of the program"),
          tr("More lines would be executed than are followed; its loops may not end."));
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

  void name_tools(std::string_view line) {
    if (line.find_first_of("(;") == line.npos) return;
    for (const auto& c : block_of(line, language()).comments) name_tool(c);
  }

  void line(std::size_t at) {
    s_.line = at + 1;
    const auto text = flow_.lines()[at];
    if (trimmed(text).starts_with('%') || (okuma_ && names_okuma_file(text))) return;
    try {
      execute(text);
    } catch (const NotFollowed& why) {
      not_followed(text, why.what());
    }
    if (const auto why = flow_.take_doubt()) not_followed(text, *why);
  }

  void not_followed(std::string_view text, const std::string& why) {
    s_.unknown(trimmed(text), say("{} The block may have moved the tool.", why));
    s_.lose_place();
  }

  void execute(std::string_view text) {
    if (directs(text)) return;
    set_place_variables();
    auto block = block_of(text, language());
    if (siemens_ && transforms(block)) return;
    const auto call = siemens_ && SiemensCycles::knows(block.rest)
                          ? std::exchange(block.rest, {})
                          : std::string();
    if (unreadable(block)) return;
    if (block.deletable && !block.words.empty())
      s_.assume(tr("Blocks with a slash are taken as executed."));
    evaluate(block, flow_.parameters);
    take(block);
    if (!call.empty()) siemens_cycle(call);
  }

  // "TRACYL(40)", "TRANSMIT(1)": words with values in brackets.
  bool transforms(Block& block) {
    const auto [name, rest] = name_at_front(block.rest);
    if ((name != "tracyl" && name != "transmit") || !rest.starts_with('(')) return false;
    take_up(s_,
            {name == "tracyl" ? MillingWord::What::cylinder : MillingWord::What::plane});
    return true;
  }

  Language language() const { return flow_.parameters.language(); }

  void set_place_variables() {
    const double scale = s_.inch ? 25.4 : 1;
    if (s_.x_mm) flow_.parameters.x = *s_.x_mm / scale;
    if (s_.z_mm) flow_.parameters.z = *s_.z_mm / scale;
  }

  void siemens_cycle(const std::string& call) {
    SiemensCycles::take(s_, flow_.parameters, call, [this](std::string_view name) {
      const auto lines = SiemensStatements::contour(flow_, name);
      return lines ? contour_of_lines(lines->first, lines->second) : std::nullopt;
    });
  }

  // A contour is one block after the other.
  bool directs(std::string_view text) {
    if (siemens_) return siemens_directs(text);
    if (okuma_ && !in_contour_) return okuma_->direct(flow_);
    if (okuma_ && OkumaStatements::is_directing(text))
      throw NotFollowed(
          tr("Branches and loops in the contour of a cycle are not followed."));
    if (!o_words_ && !macros_) return false;
    if (!in_contour_) return o_words_ ? o_words_->direct(flow_) : macros_->direct(flow_);
    const auto word = keyword_of(statement_of(text)).first;
    if (word == "IF" || word == "WHILE" || word == "GOTO")
      throw NotFollowed(
          tr("Branches and loops in the contour of a cycle are not followed."));
    return false;
  }

  bool siemens_directs(std::string_view text) {
    if (!in_contour_) return siemens_->direct(flow_);
    const auto word = name_at_front(siemens_statement_of(text)).first;
    if (SiemensStatements::is_directing(text))
      throw NotFollowed(
          tr("Branches and loops in the contour of a cycle are not followed."));
    if (word == "ret") ended_ = true;
    return word == "ret" || word == "proc" || word == "def" || word == "extern";
  }

  bool unreadable(const Block& block) {
    if (block.rest.empty()) return false;
    s_.unknown(trimmed(block.rest),
               tr("What stands here is not known; the block may have moved the tool."));
    s_.lose_place();
    return true;
  }

  void take(const Block& block) {
    special_ = Special::none;
    nose_here_ = false;
    corner_here_ = {};
    driven_here_ = block.find("$") && block.value("$") != 0;
    for (const auto& w : block.words)
      if (const auto m = milling_word(control_, w)) take_up(s_, *m);
    for (const auto& w : block.words)
      if (w.name == "G" && w.value && !milling_word(control_, w)) code(*w.value, block);
    if (!in_contour_ && special_ == Special::none &&
        begins_milling(s_, control_, motion_, block))
      take_up(s_, {MillingWord::What::begins});
    // S beside M3 or M4 is the main spindle's, wherever it stands in the block.
    if (s_.milling.on && turns_main_spindle(block)) s_.end_milling();
    for (const auto& w : block.words)
      if (w.name != "G" && !milling_word(control_, w)) word(w);
    tell_repeated(block);
    if (motion_ < 4) box_end_.reset();
    if (special_ == Special::done) return;
    if (special_ == Special::thread_cycle) return threads_.take(s_, control_, block);
    if (special_ == Special::contour) return contour_cycle(block);
    if (special_ == Special::lap) return lap(block);
    if (special_ == Special::pecks)
      return okuma_ ? okuma_drilling(block) : pecks_.take(s_, cycle_code_, block);
    if (special_ == Special::macro) return macro(block);
    if (special_ == Special::modal_macro) return begin_modal_macro(block);
    if (special_ == Special::tap) return tap(block);
    special_ == Special::dwell ? dwell(block) : move(block);
    for (const auto& w : block.words)
      if (w.name == "M" && w.value) ends(static_cast<int>(*w.value), block);
  }

  void code(double value, const Block& block) {
    const int g = static_cast<int>(value);
    if (value != g) return fraction(value, block);
    if (g >= 0 && g <= 3)
      motion_ = g;
    else if ((g == 32 && system_a(control_)) || (g == 33 && !system_a(control_)))
      motion_ = g;
    else if (g == 4)
      special_ = Special::dwell;
    else if (g == 76)
      special_ = Special::thread_cycle;
    else if (taps(g))
      special_ = Special::tap;
    else if (DrillCycleReader::has(control_, g))
      motion_ = g, drilling_.begin();
    else if (g >= 17 && g <= 19)
      s_.plane = g;
    else if (g == 80)  // ends drilling
      motion_ = drills() ? 0 : motion_;
    else if (g >= 70 && g <= 72 && o_words_) {
      special_ = Special::contour;
      cycle_code_ = g;
    } else if (g >= 70 && g <= 75 && system_a(control_)) {
      special_ = g < 74 ? Special::contour : Special::pecks;
      cycle_code_ = g;
    } else if (okuma_ && okuma_cycle(g)) {
      special_ = g == 74 ? Special::pecks : Special::lap;
      cycle_code_ = g;
    } else if ((g == 65 || g == 66) && has_macros(control_))
      special_ = g == 65 ? Special::macro : Special::modal_macro;
    else if (g == 67 && has_macros(control_))
      modal_macro_.reset();
    else if (g >= 40 && g <= 42)
      nose(g, 0);
    else if (g == 96 || g == 97)
      s_.surface_speed = g == 96;
    else if (!units(g) && !feeds_and_boxes(g) && !zeros(g, block) &&
             std::ranges::find(kIdle, g) == kIdle.end())
      strange(g, names_a_place(block, true));
  }

  // Contours and their cycles, and drilling.
  static bool okuma_cycle(int g) { return g == 74 || (g >= 81 && g <= 88); }

  bool drills() const {
    return motion_ >= 70 && DrillCycleReader::has(control_, motion_);
  }

  bool taps(int g) const {
    if (control_ == Control::siemens) return g == 331 || g == 332;
    if (control_ == Control::okuma) return g == 77;
    return g == 84 && control_ != Control::linuxcnc;
  }

  // Codes with a decimal.
  void fraction(double value, const Block& block) {
    for (const int g : {71, 72})
      if (o_words_ && std::abs(value - g - 0.1) < 1e-6) {
        special_ = Special::contour;
        cycle_code_ = g;
        return;
      }
    if (control_ == Control::linuxcnc && std::abs(value - 33.1) < 1e-6) {
      special_ = Special::tap;
      return;
    }
    for (const int side : {41, 42})
      if (control_ == Control::linuxcnc && std::abs(value - side - 0.1) < 1e-6)
        return nose(side, s_.mm(block.value("D").value_or(0)) / 2);
    if (std::abs(value - 92.1) < 1e-6 || std::abs(value - 92.2) < 1e-6) {
      s_.suspended.clear();
      s_.lose_place();
    } else if (std::abs(value - 91.1) > 1e-6 && std::abs(value - 7.1) > 1e-6) {
      s_.unknown(fmt::format("G{}", value), tr("The code is not known."));
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
    if (g == 98 || g == 99) s_.to_plane_R = g == 99;
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
      s_.suspended = say("G{} shifts the zero, which is not followed.", g);
      special_ = Special::done;
      return true;
    }
    if (g >= 54 && g <= 59) {
      if (work_offset_ != 0 && work_offset_ != g)
        s_.suspended = tr("Another work offset, whose zero is not known.");
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

  // A code that nobody knows may be one of motion, if its block names a place.
  void strange(int g, bool names_a_place) {
    const auto name = fmt::format("G{}", g);
    const bool cycle = (g >= 70 && g <= 89) || g == 32 || g == 33;
    s_.unknown(name, cycle ? tr("The cycle is not followed.")
                     : names_a_place
                         ? tr("The code is not known; the block may have moved the tool.")
                         : tr("The code is not known."));
    if (!cycle && !names_a_place) return;
    s_.lose_place();
    special_ = Special::done;
  }

  void nose(int g, double radius_mm) {
    nose_here_ = true;
    s_.nose = {g == 40   ? NoseSide::none
               : g == 41 ? NoseSide::left
                         : NoseSide::right,
               radius_mm};
  }

  void word(const Word& w) {
    const auto value = w.value.value_or(0);
    if (special_ == Special::macro || special_ == Special::modal_macro ||
        (special_ == Special::dwell && w.name != "M"))
      return;  // its arguments
    if (w.name == "F" && motion_ != 92 && special_ != Special::thread_cycle &&
        special_ != Special::tap)
      feed(value);
    else if (w.name == "S" && (s_.milling.on || driven_here_))
      s_.milling.n_rpm = value;
    else if (w.name == "S")
      special_ == Special::limit ? limit(value) : speed(value);
    else if (w.name == "LIMS" || (w.name == "D" && control_ == Control::linuxcnc &&
                                  s_.surface_speed && !nose_here_))
      limit(value);
    else if (w.name == "T")
      tool(w);
    else if (w.name == "M")
      machine(static_cast<int>(value), w.text);
    else if (w.name == "DIAMON" || w.name == "DIAMOF")
      s_.diameter = w.name == "DIAMON";
    else if (w.name == "CHR" || w.name == "CHF" || w.name == "RND")
      corner_here_ = {w.name == "RND"   ? Corner::Form::rounded
                      : w.name == "CHF" ? Corner::Form::chamfer_across
                                        : Corner::Form::chamfer,
                      s_.mm(value)};
    else if (special_ == Special::lap && w.name.front() == 'N')  // its contour
      return;
    else if (w.name.size() > 1 && special_ != Special::done && !moves_nothing(w.name))
      strange_word(w);
    if (in_contour_ && o_words_ && (w.name == "A" || w.name == "C"))
      corner_here_ = {
          w.name == "A" ? Corner::Form::rounded : Corner::Form::chamfer_rounded,
          s_.mm(value)};
    else if (w.name.size() == 1 && !(s_.milling.on && (w.name == "C" || w.name == "Y")) &&
             !(w.name == "Y" && value == 0 && motion_ == 0) &&
             std::string_view("ABCVY").find(w.name) != std::string_view::npos)
      s_.unknown(w.text, tr("Only the axes X and Z are followed."));
    if (w.name == "E" && special_ == Special::none && motion_ < 4)
      s_.unknown(
          w.text,
          tr("The letter belongs to threads; a number before it ends there, it has no "
             "exponent."));
  }

  // Words of several letters that leave the place as it is or belong to another one.
  static bool moves_nothing(const std::string& name) {
    constexpr std::string_view kIdleNames[] = {
        "SPOS",   "CR",   "SF",     "SOFT",    "BRISK",  "FFWON",
        "FFWOF",  "NORM", "KONT",   "CFC",     "CFIN",   "CFTCP",
        "STOPRE", "SUPA", "COMPOF", "WALIMON", "FPRAOF", "SETMS"};
    return std::ranges::find(kIdleNames, name) != std::end(kIdleNames);
  }
  void strange_word(const Word& w) {
    s_.unknown(w.text, tr("The word is not known; the block may have moved the tool."));
    s_.lose_place();
    special_ = Special::done;
  }

  // Codes alone may stand twice in a block.
  void tell_repeated(const Block& block) {
    for (const auto& w : block.words)
      if (w.name != "G" && w.name != "M" && block.find(w.name) != &w)
        s_.unknown(w.text,
                   tr("The letter stands twice in the block, which controls refuse."));
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

  bool turns_main_spindle(const Block& block) const {
    if (driven_here_ || special_ == Special::macro || special_ == Special::modal_macro)
      return false;
    return std::ranges::any_of(block.words, [](const Word& w) {
      return w.name == "M" && (w.value == 3 || w.value == 4);
    });
  }

  void machine(int m, const std::string& text) {
    if ((m == 3 || m == 4) && driven_here_) s_.milling.on = true, s_.turning = false;
    if ((m == 3 || m == 4) && !driven_here_) s_.turning = true;
    if (m == 6) s_.tool = s_.chosen_tool;
    if (m == 198) s_.unknown(text, tr("The subprogram is not in the text."));
  }

  // Codes that act after the motion of their block.
  void ends(int m, const Block& block) {
    if (m == 0 || m == 1) s_.stop();
    if (m == 5 && !driven_here_) s_.turning = false;
    const bool siemens_end = siemens_ && (m == 2 || m == 17 || m == 30);
    if (siemens_end && !in_contour_ && flow_.leave_program()) return;
    if (m == 2 || m == 30 || siemens_end) ended_ = true;
    if (m < 97 || m > 99 || !(o_words_ || macros_)) return;
    if (in_contour_) throw NotFollowed(tr("The contour of a cycle has no calls."));
    if (m == 99)
      back(block);
    else
      call(block, m == 97);
  }

  // M98 P1000 L2, of Fanuc also P21000; M97 P100 L2 of Haas, of blocks.
  void call(const Block& block, bool blocks) {
    const auto P = block.value("P");
    if (!P) throw NotFollowed(tr("The subprogram has no number."));
    double number = *P, times = block.value("L").value_or(1);
    if (blocks) return flow_.call_blocks(number, times);
    if (number > kLargestProgram && !flow_.has_program(number) && !block.find("L")) {
      times = std::floor(number / (kLargestProgram + 1));
      number -= times * (kLargestProgram + 1);
    }
    flow_.call_program(number, times);
  }

  void back(const Block& block) {
    if (flow_.leave(block.value("P"))) return;
    s_.assume(tr("M99 at the end of the program is taken as its end."));
    ended_ = true;
  }

  void macro(const Block& block) {
    const auto P = block.value("P");
    if (!P) throw NotFollowed(tr("The macro has no number."));
    if (in_contour_) throw NotFollowed(tr("The contour of a cycle has no calls."));
    flow_.call_macro(*P, block.value("L").value_or(1), macro_arguments(block));
  }

  // G66: the macro is called behind each block that moves, in the program of the G66, until
  // G67, each time with the same arguments.
  void begin_modal_macro(const Block& block) {
    const auto P = block.value("P");
    if (!P) throw NotFollowed(tr("The macro has no number."));
    if (modal_macro_) throw NotFollowed(tr("One G66 in another is not followed."));
    if (!flow_.has_program(*P))
      throw NotFollowed(tr("The subprogram is not in the text."));
    modal_macro_ = {*P, block.value("L").value_or(1), macro_arguments(block),
                    flow_.depth()};
  }
  void call_modal_macro() {
    if (!modal_macro_ || modal_macro_->depth != flow_.depth()) return;
    if (in_contour_) throw NotFollowed(tr("The contour of a cycle has no calls."));
    const auto& m = *modal_macro_;
    flow_.call_macro(m.number, m.times, m.arguments);
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
        s_.assume(tr("Numbers without a point are millimetres or inches, not steps."));
      using Meant = Word::Meant;
      const auto meant = block.find(name)->meant;
      if (meant == Meant::absolute || (meant == Meant::by_mode && !s_.incremental))
        return s_.mm(*v) * scale;
      return now ? std::optional(*now + s_.mm(*v) * scale) : std::nullopt;
    };
    Target t{absolute("X", half, s_.x_mm), absolute("Z", 1, s_.z_mm)};
    if (!system_a(control_) && !(o_words_ && in_contour_)) return t;
    if (const auto u = block.value("U"); u && s_.x_mm) t.x = *s_.x_mm + s_.mm(*u) * half;
    if (const auto w = block.value("W"); w && s_.z_mm) t.z = *s_.z_mm + s_.mm(*w);
    return t;
  }

  bool names_a_place(const Block& block, bool arcs) const {
    for (const char* name : {"X", "Z", "U", "W"})
      if (block.find(name)) return true;
    if (s_.milling.on && (block.find("C") || block.find("Y") || block.find("H")))
      return true;
    return arcs && (block.find("I") || block.find("K"));
  }

  void move(const Block& block) {
    if (special_ == Special::limit || !names_a_place(block, motion_ == 2 || motion_ == 3))
      return;
    const auto t = target(block);
    const bool driven = s_.milling.on && motion_ <= 3 &&
                        driven_move(s_, control_, motion_, block, t.x, t.z);
    if (!driven) straight_or_arc(block, t);
    s_.corner = corner_here_;
    call_modal_macro();
  }

  void straight_or_arc(const Block& block, const Target& t) {
    switch (motion_) {
      case 0:  // a contour's is a cut in LinuxCNC
        return s_.straight(in_contour_ && o_words_ ? Move::Kind::feed : Move::Kind::rapid,
                           t.x, t.z);
      case 1:
        return s_.straight(Move::Kind::feed, t.x, t.z);
      case 2:
      case 3:
        return arc(block, t);
      default:
        break;
    }
    if (drills()) return drilling_.take(s_, control_, motion_, block, t.x, t.z);
    if (!s_.x_mm || !s_.z_mm) {
      s_.unknown(tr("a cut from a place that is not known"),
                 tr("It is not followed: X or Z was not given before it."));
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

  // Seconds by F (Siemens, Okuma), X or U, P without a point in ms (Fanuc), or P (LinuxCNC);
  // turns of the spindle by S (Siemens).
  void dwell(const Block& block) {
    double s = 0;
    for (const char* name : {"F", "X", "U", "P"}) {
      const auto* w = block.find(name);
      if (!w || !w->value) continue;
      const bool ms = *name == 'P' && control_ != Control::linuxcnc && !w->point;
      s = *w->value / (ms ? 1000 : 1);
    }
    s_.dwell(s / 60);
    if (control_ == Control::siemens) s_.dwell_turns(block.value("S").value_or(0));
  }

  // On the axis, with the spindle in step.  Siemens has a block for each way.
  void tap(const Block& block) {
    const auto t = target(block);
    if (t.x && t.x != s_.x_mm) s_.straight(Move::Kind::rapid, t.x, s_.z_mm);
    const bool own_words = words_.lead == 'K';
    const double lead = s_.mm(block.value(own_words ? "K" : "F").value_or(0));
    if (!t.z || !s_.z_mm)
      return s_.unknown(tr("a tap that is not followed"),
                        tr("Z was not given before or in it."));
    if (control_ == Control::siemens && s_.x_mm) return s_.thread(*s_.x_mm, *t.z, lead);
    const double R = s_.mm(block.value("R").value_or(0));
    const bool absolute = control_ == Control::haas && block.find("R");
    tap_cycle(s_, absolute ? R : *s_.z_mm + R, *t.z, lead);
  }

  // G90, G92 and G94 of system A.
  void box(const Block& block, double x, double z) {
    if (block.value("R").value_or(0) != 0)
      s_.unknown(tr("R of a cycle"), tr("Its taper is not followed."));
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

  // From the beginning, or absolute where it says so ("I=AC(30)").
  double centre_word(const Block& block, const char* name, double from_mm, double scale) {
    const auto* w = block.find(name);
    const double value = w ? s_.mm(w->value.value_or(0)) : 0;
    return w && w->meant == Word::Meant::absolute ? value * scale : from_mm + value;
  }

  void arc(const Block& block, const Target& t) {
    if (!s_.x_mm || !s_.z_mm)
      return s_.straight(Move::Kind::feed, t.x, t.z);  // tells that it is not followed
    const Point from{*s_.x_mm, *s_.z_mm};
    const Point to{t.x.value_or(from.h_mm), t.z.value_or(from.z_mm)};
    const bool clockwise = motion_ == 2;
    std::optional<Point> centre;
    if (const auto R = block.value(siemens_ ? "CR" : "R"))
      centre = centre_of(from, to, s_.mm(*R), clockwise);
    else
      centre = Point{centre_word(block, "I", from.h_mm, s_.diameter ? 0.5 : 1),
                     centre_word(block, "K", from.z_mm, 1)};
    const auto radius = [&](const Point& p) {
      return std::hypot(p.h_mm - centre->h_mm, p.z_mm - centre->z_mm);
    };
    if (!centre || !(radius(from) > 0) ||
        !(std::abs(radius(from) - radius(to)) <= kRadii_mm)) {
      s_.unknown(tr("an arc whose ends do not fit its centre"),
                 tr("It is taken as straight."));
      return s_.straight(Move::Kind::feed, to.h_mm, to.z_mm);
    }
    s_.to({Move::Kind::arc, to.h_mm, to.z_mm, *centre, clockwise});
  }

  // G70 to G73 of system A; the program goes on behind the contour.
  void contour_cycle(const Block& block) {
    if (o_words_) return subroutine_cycle(block);
    const auto end =
        contours_.take(s_, control_, cycle_code_, block,
                       [this](double P, double Q) { return contour_between(P, Q); });
    const auto line = end ? flow_.block(*end) : std::nullopt;
    if (line && *line >= flow_.line()) flow_.go_to(*line + 1);
  }

  // G70 to G72 of LinuxCNC, along the contour of a subroutine.
  void subroutine_cycle(const Block& block) {
    const auto Q = block.value("Q");
    const auto lines = Q ? o_words_->subroutine(*Q) : std::nullopt;
    if (!lines)
      throw NotFollowed(tr("The subroutine of its contour is not in the text."));
    const auto t = target(block);
    s_.straight(Move::Kind::rapid, t.x, t.z);
    const auto contour = contour_of_lines(lines->first + 1, lines->second - 1);
    if (!contour) throw NotFollowed(tr("The contour of a cycle has no cycles."));
    g7x_cycle(s_, cycle_code_, block, *contour);
  }

  // G81 to G88 of Okuma.  The definition of a contour is passed over where it stands.
  void lap(const Block& block) {
    const bool defines = cycle_code_ <= 83;
    const auto end = okuma_->end_of_contour(flow_.line());
    if (defines && in_contour_) return;  // its first line
    if (defines) {
      if (!end) throw NotFollowed(tr("The definition of the contour has no end."));
      return flow_.go_to(*end + 1);
    }
    const auto label = label_in(block);
    const auto begins = label ? flow_.block(*label) : std::nullopt;
    const auto last = begins ? okuma_->end_of_contour(*begins) : std::nullopt;
    if (!last || *last <= *begins || cycle_code_ == 84 || cycle_code_ == 88)
      throw NotFollowed(
          tr("G85, G86 and G87 of a contour between G81 or G82 and G80 are followed."));
    const auto first = block_of(flow_.lines()[*begins], Language::okuma).value("G");
    if (first != 81 && first != 82)
      throw NotFollowed(
          tr("Contours that G81 or G82 begins are followed, without a blank."));
    const auto contour = contour_of_lines(*begins, *last - 1);
    if (!contour) throw NotFollowed(tr("The contour of a cycle has no cycles."));
    lap_cycle(s_, cycle_code_, block, *contour,
              first == 81 ? RoughingAlong::z : RoughingAlong::x);
  }

  // G74 X0 Z D F: D the length of a peck; how far it comes back is a parameter.
  void okuma_drilling(const Block& block) {
    const auto t = target(block);
    for (const auto& w : block.words)
      if (std::string_view("GNXZDFSTM").find(w.name.front()) == std::string_view::npos ||
          w.name.size() > 1)
        throw NotFollowed(tr("Only X, Z, D and F of G74 are followed."));
    if (t.x && t.x != s_.x_mm) s_.straight(Move::Kind::rapid, t.x, s_.z_mm);
    if (!t.z || !s_.z_mm) throw NotFollowed(tr("Z was not given before or in it."));
    const double depth = std::abs(*t.z - *s_.z_mm);
    const double peck = s_.mm(block.value("D").value_or(0));
    DrillCycle d{.from_z_mm = *s_.z_mm, .away_z_mm = *s_.z_mm};
    d.strokes_z_mm = strokes(*s_.z_mm, *t.z, peck > 0 ? peck : depth,
                             [](double before) { return before; });
    d.clears = false;
    d.retract_mm = kOkumaBack_mm;
    if (d.strokes_z_mm.size() > 1)
      s_.assume(tr(
          "G74 comes back after each peck by a parameter of the control, here 0.5 mm."));
    drill_cycle(s_, d);
  }

  // The moves of the blocks from N = P to N = Q, as if they followed.
  std::optional<Contour> contour_between(double P, double Q) {
    const auto first = flow_.block(P), last = flow_.block(Q);
    if (!first || !last || *last < *first) return std::nullopt;
    return contour_of_lines(*first, *last);
  }

  std::optional<Contour> contour_of_lines(std::size_t first, std::size_t last) {
    if (in_contour_) return std::nullopt;
    auto kept = std::exchange(s_.program, {});
    ProgramReader inner(*this);
    s_.program = std::move(kept);
    inner.in_contour_ = true;
    inner.s_.turning = true;
    if (o_words_) inner.s_.nose = {};
    if (siemens_) {  // feeds of CYCLE95 are its own, or those of the contour's words
      inner.s_.F_line = 0;
      if (!(inner.s_.F > 0)) inner.s_.F = 1;
    }
    for (auto i = first; i <= last && !inner.ended_ && !flow_.spent() && !inner.s_.full();
         ++i)
      inner.line(i);
    for (auto& u : inner.s_.program.unknown) s_.unknown(u.what, u.why);
    return Contour{std::move(inner.s_.program.runs)};
  }

  enum class Special {
    none,
    done,
    limit,
    dwell,
    thread_cycle,
    contour,
    pecks,
    lap,
    macro,
    modal_macro,
    tap
  };

  Flow& flow_;
  std::shared_ptr<const OWords> o_words_;
  std::shared_ptr<const MacroStatements> macros_;
  std::shared_ptr<const SiemensStatements> siemens_;
  std::shared_ptr<const OkumaStatements> okuma_;
  Control control_;
  const gcode::Dialect& words_;
  ModalState s_;
  ThreadCycleReader threads_;
  ContourCycleReader contours_;
  PeckCycleReader pecks_;
  DrillCycleReader drilling_;
  int motion_ = 0;
  Special special_ = Special::none;
  int work_offset_ = 0;
  double lead_mm_ = 0;
  std::optional<Point> box_end_;  // of the cycle before
  bool ended_ = false, in_contour_ = false;
  bool nose_here_ = false;    // G40 to G42 in the block
  bool driven_here_ = false;  // "$1" in the block
  Corner corner_here_;
  int cycle_code_ = 0;
  struct ModalMacro {
    double number = 0, times = 1;
    std::map<int, double> arguments = {};
    std::size_t depth = 0;
  };
  std::optional<ModalMacro> modal_macro_;  // of G66
};

}  // namespace

TurningProgram read_program(std::string_view text, const ReadOptions& options) {
  const auto lines = lines_of(text);
  Flow flow(lines, options.control);
  ProgramReader reader(flow, options);
  reader.follow();
  return reader.result();
}

}  // namespace turnwright::review
