#include "turnwright/nc/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "drilled_hole.hpp"
#include "thread_cuts.hpp"

namespace turnwright::nc {

using gcode::Dialect;
using gcode::dialect;
using gcode::OffsetNumber;
using gcode::PeckLaw;

namespace {

using std::string_view;

constexpr int kLastBlock = 9999;
constexpr double kMostRatio = 0.999;  ///< of a peck to the one before it: less than 1

template <class... Args>
std::string filled(string_view words, const Args&... args) {
  return fmt::format(fmt::runtime(words), args...);
}

// "12.5", never "12.5000" nor "-0".
std::string number(double value, int decimals) {
  auto text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != text.npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string at_most(double value, int decimals) {
  return number(gcode::cut_off(value, decimals), decimals);
}

// Lines of a program, with the numbers of blocks that the shop wants.
class Lines {
 public:
  Lines(const Dialect& dialect, BlockNumbers numbers)
      : dialect_(dialect), numbers_(numbers) {}

  /// Lines that never have a number.
  void bare(string_view words) {
    if (!words.empty()) (text_ += words) += '\n';
  }
  void blocks(string_view words) {
    for (std::size_t end = 0; !words.empty(); words.remove_prefix(end)) {
      end = std::min(words.find('\n'), words.size() - 1) + 1;
      if (numbers_ == BlockNumbers::all)
        fmt::format_to(std::back_inserter(text_), "N{} ", last_ = last_ % kLastBlock + 1);
      text_ += words.substr(0, end);
    }
    text_ += '\n';
  }
  /// Blocks that call a tool, of which the first has the number of an operation.
  void tool(std::size_t operation, string_view words) {
    if (numbers_ == BlockNumbers::tools)
      fmt::format_to(std::back_inserter(text_), "N{} ", 10 * operation);
    blocks(words);
  }
  /// A comment holds no brackets, and nothing that ends the line or the program.
  void comment(string_view words) {
    std::string out;
    for (const char c : words.substr(0, dialect_.longest)) {
      const bool plain = c >= ' ' && c <= '~' && c != '(' && c != ')' && c != '%';
      const bool small = dialect_.upper_case && c >= 'a' && c <= 'z';
      out += small   ? static_cast<char>(c - 'a' + 'A')
             : plain ? c
                     : (c == '('   ? '['
                        : c == ')' ? ']'
                                   : '?');
    }
    bare(filled(dialect_.comment, out));
  }

  std::string take() { return std::move(text_); }

 private:
  const Dialect& dialect_;
  BlockNumbers numbers_;
  std::string text_;
  int last_ = 0;
};

// The moves of a step, of which blocks have only the words that change, from where the step
// before has ended.
class Moves {
 public:
  Moves(Lines& lines, const Dialect& dialect, double f_mm_rev, const Point& from)
      : lines_(lines),
        dialect_(dialect),
        lead_mm_(f_mm_rev),
        f_(pointed(at_most(f_mm_rev, 4))),
        from_(from) {}
  /// Of a milling cutter, whose feed counts by the minute.
  Moves(Lines& lines, const Dialect& dialect, const Milling& milling)
      : lines_(lines), dialect_(dialect), milling_(&milling) {
    if (!milling.needs_y) y_ = length(0);
  }

  void write(const Move& m) {
    const auto x = diameter(m), y = length(m.y_mm), z = length(m.z_mm);
    std::string words;
    if (x != x_) words += " X" + x;
    if (milling_ && y != y_) words += " Y" + y;
    if (z != z_) words += " Z" + z;
    if (words.empty()) return;
    if (m.kind == Move::Kind::arc) {
      const auto from_x = x_.empty() ? length(2 * from_.h_mm) : x_;
      const auto from_z = z_.empty() ? length(from_.z_mm) : z_;
      words = " X" + x + " Z" + z + " I" + centre(m.centre.h_mm - std::stod(from_x) / 2) +
              " K" + centre(m.centre.z_mm - std::stod(from_z));
    }
    lines_.blocks(code(m).append(words).append(feed(m)));
    x_ = x;
    y_ = y;
    z_ = z;
  }

  /// All cuts of a thread by one cycle.  The first is rounded up, so that the control
  /// needs no further cut for what rounding has left.
  void write_cycle(const ThreadCuts& t) {
    const double first = t.first_mm();
    lines_.blocks(
        filled(dialect_.thread_cycle, fmt::arg("X", length(2 * t.to.h_mm)),
               fmt::arg("Z", length(t.to.z_mm)), fmt::arg("lead", f_),
               fmt::arg("peak_d", length(2 * (t.outside_mm() - t.from.h_mm))),
               fmt::arg("depth", length(t.depth_mm)),
               fmt::arg("depth_d", length(2 * t.depth_mm)),
               fmt::arg("depth_um", std::lround(1e3 * t.depth_mm)),
               fmt::arg("first", up(first)), fmt::arg("first_d", up(2 * first)),
               fmt::arg("first_um", std::lround(std::ceil(1e3 * first))),
               fmt::arg("least", length(t.least_mm())), fmt::arg("others", t.cuts - 1),
               fmt::arg("Z_run_in", length(t.from.z_mm - lead_mm_)),
               fmt::arg("outside_d", length(2 * t.outside_mm())),
               fmt::arg("clear", length(std::abs(t.from.h_mm - t.outside_mm()))),
               fmt::arg("form", t.to.h_mm < t.from.h_mm ? 3 : 4),
               fmt::arg("least_um", std::lround(std::floor(1e3 * t.least_mm())))));
    // Where along Z a cycle ends depends on the control.
    x_.clear();
    z_.clear();
    write({Move::Kind::rapid, t.from.h_mm, t.from.z_mm});
  }

  /// A tap from where it stands, and back there.
  void write_tap(const Move& m, double n_rpm) {
    lines_.blocks(filled(dialect_.tap, fmt::arg("Z", length(m.z_mm)), fmt::arg("R", z_),
                         fmt::arg("lead", f_),
                         fmt::arg("S", at_most(n_rpm, dialect_.S_decimals))));
  }

  /// A hole by the control's drilling cycle, and back to where the drill stands.  Pecks are
  /// rounded up, so that rounding leaves nothing for a further one.
  void write_hole(const DrilledHole& h) {
    const double first = h.first_mm(),
                 peck = h.places_mm.size() > 1 ? h.step_mm() : first;
    lines_.blocks(
        filled(h.places_mm.size() > 1 ? dialect_.peck_cycle : dialect_.drill_cycle,
               fmt::arg("Z", length(h.bottom_mm())), fmt::arg("R", z_),
               fmt::arg("R_less_1", length(h.from_mm - 1)),
               fmt::arg("depth", up(h.from_mm - h.bottom_mm())), fmt::arg("feed", f_),
               fmt::arg("peck", up(peck)),
               fmt::arg("peck_um", std::lround(std::ceil(1e3 * peck * (1 - 1e-12)))),
               fmt::arg("first", up(first)), fmt::arg("first_Z", length(h.places_mm[0])),
               fmt::arg("less", up(first - peck)),
               fmt::arg("ratio", at_most(std::min(peck / first, kMostRatio), 3)),
               fmt::arg("back", length(h.back_mm))));
    fed_ = true;
  }

  /// A cut of a thread by a cycle that comes back to where it began.
  void write_returning(const Move& m) {
    lines_.blocks(code(m) + " X" + diameter(m) + " Z" + length(m.z_mm) + feed(m));
  }

 private:
  std::string code(const Move& m) const {
    switch (m.kind) {
      case Move::Kind::rapid:
        return "G0";
      case Move::Kind::feed:
        return "G1";
      case Move::Kind::arc:
        return m.clockwise ? "G2" : "G3";
      case Move::Kind::thread:
        break;
    }
    return std::string(dialect_.thread);
  }
  std::string feed(const Move& m) {
    if (m.kind == Move::Kind::rapid) return "";
    if (m.kind == Move::Kind::thread) return fmt::format(" {}{}", dialect_.lead, f_);
    if (milling_) {
      const auto f = pointed(at_most(m.feed_share * milling_->f_mm_min, 1));
      if (f == f_) return "";
      return " F" + (f_ = f);
    }
    if (fed_) return "";
    fed_ = true;
    return " F" + f_;
  }
  std::string pointed(std::string number) const {
    const bool whole = number.find('.') == number.npos;
    return dialect_.point && whole ? number + '.' : number;
  }
  /// Rounded up.
  std::string up(double mm) const {
    const double scale = std::pow(10, dialect_.decimals);
    return length(std::ceil(mm * scale * (1 - 1e-12)) / scale);
  }
  std::string length(double mm) const { return pointed(number(mm, dialect_.decimals)); }
  std::string diameter(const Move& m) const { return length(2 * m.x_mm); }
  /// From the start as it is written.
  std::string centre(double mm) const {
    return pointed(number(mm, dialect_.centre_decimals));
  }

  Lines& lines_;
  const Dialect& dialect_;
  const Milling* milling_ = nullptr;
  double lead_mm_ = 0;
  std::string f_, x_, y_, z_;
  Point from_ = {};
  bool fed_ = false;
};

// A word of the shop's, or else of the control's.
std::string either(const std::string& given, string_view own) {
  return given.empty() ? std::string(own) : given;
}

// The codes for milling that a program has, the shop's before the control's own.
MillingCodes milling_codes(const Settings& s) {
  const auto& d = dialect(s.control);
  const auto& given = s.milling;
  return {either(given.c_axis_on, d.c_axis_on), either(given.c_axis_off, d.c_axis_off),
          either(given.lock, d.lock),           either(given.unlock, d.unlock),
          either(given.tool_on, d.tool_on),     either(given.tool_off, d.tool_off)};
}

std::string with_speed(std::string words, const std::string& S) {
  const auto at = words.find("{S}");
  return at == words.npos ? words : words.replace(at, 3, S);
}

void write_moves(Lines& lines, const Dialect& dialect, const Step& s,
                 const Settings& settings, const Point& from) {
  Moves moves(lines, dialect, s.f_mm_rev, from);
  const bool cycles = settings.cycles && !dialect.thread_cycle.empty();
  for (std::size_t k = 0; k < s.moves.size(); ++k) {
    const auto cuts = cycles ? thread_cuts(s.moves, k) : std::nullopt;
    const auto hole = settings.drill_cycles ? drilled_hole(s.moves, k) : std::nullopt;
    if (hole && hole->pecked_as(dialect.pecks)) {
      moves.write_hole(*hole);
      k += hole->moves().size() - 1;
    } else if (taps(s.moves, k)) {
      moves.write_tap(s.moves[k], s.S);
      ++k;
    } else if (cuts) {
      moves.write_cycle(*cuts);
      k += 4 * static_cast<std::size_t>(cuts->cuts) - 1;
    } else if (dialect.thread_returns && returns(s.moves, k)) {
      moves.write_returning(s.moves[k + 1]);
      k += 3;
    } else if (dialect.thread_returns && s.moves[k].kind == Move::Kind::thread) {
      throw std::domain_error("nc: a thread that " + std::string(dialect.name) +
                              " has no word for");
    } else {
      moves.write(s.moves[k]);
    }
  }
}

const TableTool& tool_of(const SetupProgram& p, int number) {
  return *std::find_if(p.tools.begin(), p.tools.end(),
                       [&](const TableTool& t) { return t.number == number; });
}

bool turns(const SetupProgram& p, const Step& s) {
  const bool thread = std::any_of(s.moves.begin(), s.moves.end(), [](const Move& m) {
    return m.kind == Move::Kind::thread;
  });
  return !thread && tool_of(p, s.tool).orientation != kDrillOrientation;
}

void write_spindle(Lines& lines, const Dialect& d, const Step& s, string_view turn) {
  const auto S = at_most(s.S, d.S_decimals);
  if (!s.constant_surface_speed) return lines.blocks(fmt::format("G97 S{} {}", S, turn));
  lines.blocks(filled(d.surface_speed, fmt::arg("S", S), fmt::arg("turn", turn),
                      fmt::arg("limit", at_most(s.n_max_rpm, 0))));
}

std::string tool_words(const TableTool& t) {
  const auto corner = t.re_mm > 0 ? ", corner " + number(t.re_mm, 3) + " mm" : "";
  return fmt::format("T{} {}{}", t.number, t.id, corner);
}

// A program while it is written.
class Writer {
 public:
  Writer(const SetupProgram& program, const Settings& settings)
      : p_(program),
        s_(settings),
        d_(dialect(settings.control)),
        lines_(d_, settings.block_numbers) {}

  std::string text() {
    lines_.bare(filled(
        d_.begin, fmt::arg("program", s_.program_number + static_cast<int>(p_.setup))));
    for (const auto& c : p_.comments) lines_.comment(c);
    for (const auto& t : p_.tools) lines_.comment(tool_words(t));
    lines_.blocks(filled(d_.start, fmt::arg("offset", work_offset(s_))));
    if (s_.reference_returns) lines_.blocks(d_.reference);
    std::size_t operation = 0;
    for (const auto& step : p_.steps) {
      if (step.stop)
        stop(step);
      else if (step.milling)
        mill(step, ++operation);
      else
        cut(step, ++operation);
    }
    rest();
    if (s_.reference_returns) lines_.blocks(d_.reference);
    lines_.bare(d_.end);
    return lines_.take();
  }

 private:
  /// Coolant and spindle off.
  void rest() {
    if (running_ && !s_.coolant.empty()) lines_.blocks("M9");
    if (running_) lines_.blocks("M5");
    running_ = false;
  }
  void stop(const Step& step) {
    rest();
    for (const auto& c : step.comments) lines_.comment(c);
    lines_.blocks("M0");
  }
  void call(const TableTool& tool, std::size_t operation) {
    tool_ = tool.number;
    lines_.tool(operation, filled(d_.tool, fmt::arg("tool", tool.number),
                                  fmt::arg("offset", tool.offset)));
  }
  void cut(const Step& step, std::size_t operation) {
    if (tool_ != 0 && tool_ != step.tool) change();
    for (const auto& c : step.comments) lines_.comment(c);
    if (tool_ != step.tool) call(tool_of(p_, step.tool), operation);
    const bool reversed = s_.spindle == SpindleTurn::M4 && turns(p_, step);
    write_spindle(lines_, d_, step, reversed ? "M4" : "M3");
    if (!s_.coolant.empty()) lines_.blocks(s_.coolant);
    running_ = true;
    write_moves(lines_, d_, step, s_, at_);
    if (!step.moves.empty()) at_ = {step.moves.back().x_mm, step.moves.back().z_mm};
  }
  /// The main spindle turns the part to an angle and holds it, and is a spindle again.
  void mill(const Step& step, std::size_t operation) {
    if (const auto why = cannot_mill(*step.milling, s_); !why.empty())
      throw std::domain_error("nc: a place is to be milled, and " + why);
    if (tool_ != 0 && tool_ != step.tool) change();
    rest();
    for (const auto& c : step.comments) lines_.comment(c);
    if (tool_ != step.tool) call(tool_of(p_, step.tool), operation);
    const auto codes = milling_codes(s_);
    const auto blocks = [this](string_view words) {
      if (!words.empty()) lines_.blocks(words);
    };
    blocks(codes.c_axis_on);
    lines_.blocks(d_.per_minute);
    blocks(codes.unlock);
    lines_.blocks(filled(d_.c_axis, fmt::arg("C", angle(step.milling->C_deg))));
    blocks(codes.lock);
    lines_.blocks(with_speed(codes.tool_on, at_most(step.milling->n_rpm, 0)));
    blocks(s_.coolant);
    Moves moves(lines_, d_, *step.milling);
    for (const auto& m : step.moves) moves.write(m);
    if (!step.moves.empty()) at_ = {step.moves.back().x_mm, step.moves.back().z_mm};
    if (!s_.coolant.empty()) lines_.blocks("M9");
    lines_.blocks(codes.tool_off);
    blocks(codes.unlock);
    blocks(codes.c_axis_off);
    lines_.blocks(d_.per_revolution);
  }
  std::string angle(double deg) const {
    const auto text = number(deg, 3);
    return d_.point && text.find('.') == text.npos ? text + '.' : text;
  }
  /// Before another tool.
  void change() {
    if (s_.reference_returns) lines_.blocks(d_.reference);
    if (!s_.optional_stops) return;
    rest();
    lines_.blocks("M1");
  }

  const SetupProgram& p_;
  const Settings& s_;
  const Dialect& d_;
  Lines lines_;
  int tool_ = 0;
  Point at_ = {};  // where the last step has ended
  bool running_ = false;
};

// Somebody mills.
Step stop_to_mill(const Milling& milling, const std::string& why) {
  Step s;
  s.stop = true;
  s.comments = {milling.stop, why};
  return s;
}

// A drill's moves with pecks of one length, where it pecks.
std::vector<Move> pecked_alike(const Step& step, double back_mm) {
  std::vector<Move> all;
  for (std::size_t k = 0; k < step.moves.size(); ++k) {
    const auto hole = drilled_hole(step.moves, k);
    if (!hole || hole->places_mm.size() == 1) {
      all.push_back(step.moves[k]);
      continue;
    }
    const double back = back_mm > 0 ? back_mm : hole->back_mm;
    std::ranges::copy(with_equal_pecks(*hole, *step.pecks, back).moves(),
                      std::back_inserter(all));
    k += hole->moves().size() - 1;
  }
  return all;
}

// LinuxCNC numbers the quadrants of a tip in front of and behind the axis the other way round
// than most controls do: 2 outside, 3 in a bore.
int linuxcnc_orientation(int orientation) {
  return orientation == 3 ? 2 : orientation == 2 ? 3 : orientation;
}

int usual_offset(const Settings& settings, int number) {
  return dialect(settings.control).offset == OffsetNumber::edge ? 1 : number;
}

}  // namespace

std::string work_offset(const Settings& settings) {
  if (!settings.work_offset.empty()) return settings.work_offset;
  const auto offsets = dialect(settings.control).work_offsets;
  return offsets.empty() ? "" : std::string(offsets[0]);
}

void number_tools(std::vector<SetupProgram>& programs, const Settings& settings) {
  std::set<int> taken;
  std::map<std::string, ShopTool> numbered;
  for (const auto& t : settings.tools) {
    taken.insert(t.number);
    numbered[t.id] = t;
  }
  int next = 1;
  for (auto& p : programs) {
    std::map<int, int> now;
    for (auto& t : p.tools) {
      if (!numbered.contains(t.id)) {
        while (taken.contains(next)) ++next;
        numbered[t.id] = {t.id, next++};
      }
      const auto& as = numbered[t.id];
      now[t.number] = as.number;
      t.number = as.number;
      t.offset = as.offset.value_or(usual_offset(settings, as.number));
    }
    for (auto& step : p.steps)
      if (!step.stop) step.tool = now.at(step.tool);
  }
}

std::string cannot_mill(const Milling& milling, const Settings& settings) {
  const auto& d = dialect(settings.control);
  const auto codes = milling_codes(settings);
  if (d.c_axis_is_builders && (codes.c_axis_on.empty() || codes.c_axis_off.empty()))
    return "no codes of the axis C are given";
  if (codes.tool_on.empty() || codes.tool_off.empty())
    return "no codes of the driven tools are given";
  if (milling.needs_y && !d.y_axis)
    return "an axis Y of " + std::string(d.name) + " is not programmed";
  return "";
}

void fit_to_control(std::vector<SetupProgram>& programs, const Settings& settings,
                    const catalogue::Lathe& machine) {
  const auto& d = dialect(settings.control);
  const bool pecks_alike = settings.drill_cycles && d.pecks == PeckLaw::equal;
  for (auto& p : programs) {
    for (auto& step : p.steps) {
      if (pecks_alike && step.pecks) step.moves = pecked_alike(step, d.peck_back_mm);
      if (!step.milling) continue;
      if (const auto why = cannot_mill(*step.milling, settings); !why.empty())
        step = stop_to_mill(*step.milling, why);
    }
    std::erase_if(p.tools, [&](const TableTool& t) {
      return std::ranges::none_of(
          p.steps, [&](const Step& s) { return !s.stop && s.tool == t.number; });
    });
    p.minutes = minutes(p, machine);
  }
}

std::string text(const SetupProgram& program, const Settings& settings) {
  return Writer(program, settings).text();
}

std::string tool_table(const std::vector<SetupProgram>& programs) {
  std::map<int, TableTool> all;
  for (const auto& p : programs)
    for (const auto& t : p.tools) all[t.number] = t;
  std::string out;
  for (const auto& [n, t] : all)
    out += fmt::format("T{} P{} X0 Z0 D{} Q{} ;{}\n", n, n, number(2 * t.re_mm, 4),
                       linuxcnc_orientation(t.orientation), t.id);
  return out;
}

}  // namespace turnwright::nc
