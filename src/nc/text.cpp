#include "turnwright/nc/text.hpp"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace turnwright::nc {
namespace {

using std::string_view;

constexpr int kLastBlock = 9999;

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

// A number cut off at its last decimal, with an allowance for the rounding of whole
// numbers.
std::string at_most(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return number(std::floor(value * scale * (1 + 1e-12)) / scale, decimals);
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

// The moves of a step, of which blocks have only the words that change.
class Moves {
 public:
  Moves(Lines& lines, const Dialect& dialect, double f_mm_rev)
      : lines_(lines), dialect_(dialect), f_(pointed(at_most(f_mm_rev, 4))) {}

  void write(const Move& m) {
    const auto x = written(2 * m.x_mm, 4), z = written(m.z_mm, 4);
    std::string words;
    if (x != x_) words += " X" + x;
    if (z != z_) words += " Z" + z;
    if (words.empty()) return;
    if (m.kind == Move::Kind::arc) {
      words = " X" + x + " Z" + z + " I" + written(m.centre.h_mm - at_.x_mm, 5) + " K" +
              written(m.centre.z_mm - at_.z_mm, 5);
    }
    lines_.blocks(code(m).append(words).append(feed(m)));
    x_ = x;
    z_ = z;
    at_ = m;
  }

  /// A cut of a thread by a cycle that comes back to where it began.
  void write_returning(const Move& m) {
    lines_.blocks(code(m) + " X" + written(2 * m.x_mm, 4) + " Z" + written(m.z_mm, 4) +
                  feed(m));
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
    if (fed_) return "";
    fed_ = true;
    return " F" + f_;
  }
  std::string pointed(std::string number) const {
    const bool whole = number.find('.') == number.npos;
    return dialect_.point && whole ? number + '.' : number;
  }
  std::string written(double mm, int decimals) const {
    return pointed(number(mm, decimals));
  }

  Lines& lines_;
  const Dialect& dialect_;
  std::string f_, x_, z_;
  Move at_;
  bool fed_ = false;
};

// Whether the moves from the k-th are one cut of a thread by a cycle: in along X, the
// cut along Z, out to where it began, and back.
bool returns(const std::vector<Move>& moves, std::size_t k) {
  if (k == 0 || k + 3 >= moves.size()) return false;
  const Move *from = &moves[k - 1], *m = &moves[k];
  const auto same = [](const Move& a, const Move& b) {
    return a.x_mm == b.x_mm && a.z_mm == b.z_mm;
  };
  return m[1].kind == Move::Kind::thread && m[0].z_mm == from->z_mm &&
         m[1].x_mm == m[0].x_mm && m[2].x_mm == from->x_mm && m[2].z_mm == m[1].z_mm &&
         same(m[3], *from);
}

void write_moves(Lines& lines, const Dialect& dialect, const Step& s) {
  Moves moves(lines, dialect, s.f_mm_rev);
  for (std::size_t k = 0; k < s.moves.size(); ++k) {
    if (dialect.thread_returns && returns(s.moves, k)) {
      moves.write_returning(s.moves[k + 1]);
      k += 3;
      continue;
    }
    if (dialect.thread_returns && s.moves[k].kind == Move::Kind::thread)
      throw std::domain_error("nc: a thread that " + std::string(dialect.name) +
                              " has no word for");
    moves.write(s.moves[k]);
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
    write_moves(lines_, d_, step);
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
  bool running_ = false;
};

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
                       t.orientation, t.id);
  return out;
}

}  // namespace turnwright::nc
