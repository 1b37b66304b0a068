#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "turnwright/nc/program.hpp"

namespace turnwright::nc {
namespace {

constexpr std::size_t kLine = 200;  // controls read about 250 characters a line

// A comment holds no brackets, and nothing that ends the line.
std::string comment(const std::string& text) {
  std::string out = "(";
  for (const char c : text.substr(0, kLine)) {
    const bool plain = c >= ' ' && c <= '~' && c != '(' && c != ')' && c != '%';
    out += plain ? c : (c == '(' ? '[' : c == ')' ? ']' : '?');
  }
  return out + ")\n";
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

// A number as a control reads it.  Fanuc may count numbers without a point in steps.
std::string pointed(std::string number, Control control) {
  const bool whole = number.find('.') == number.npos;
  return control == Control::fanuc && whole ? number + '.' : number;
}

// Writes only the words that change.
class Moves {
 public:
  Moves(std::string& out, Control control, double f_mm_rev)
      : out_(out), control_(control), f_(pointed(at_most(f_mm_rev, 4), control)) {}

  void write(const Move& m) {
    const auto written = [this](double mm, int decimals) {
      return pointed(number(mm, decimals), control_);
    };
    const auto x = written(2 * m.x_mm, 4), z = written(m.z_mm, 4);
    std::string words;
    if (x != x_) words += " X" + x;
    if (z != z_) words += " Z" + z;
    if (words.empty()) return;
    if (m.kind == Move::Kind::arc) {
      words = " X" + x + " Z" + z + " I" + written(m.centre.h_mm - at_.x_mm, 5) + " K" +
              written(m.centre.z_mm - at_.z_mm, 5);
    }
    out_ += code(m) + words + feed(m) + '\n';
    x_ = x;
    z_ = z;
    at_ = m;
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
    return control_ == Control::linuxcnc ? "G33" : "G32";
  }
  std::string feed(const Move& m) {
    if (m.kind == Move::Kind::rapid) return "";
    if (m.kind == Move::Kind::thread)
      return (control_ == Control::linuxcnc ? " K" : " F") + f_;
    if (fed_) return "";
    fed_ = true;
    return " F" + f_;
  }

  std::string& out_;
  Control control_;
  std::string f_, x_, z_;
  Move at_;
  bool fed_ = false;
};

std::string spindle(const Step& s, Control control) {
  // Fanuc takes no decimals of S.
  const auto S = at_most(s.S, control == Control::fanuc ? 0 : 2),
             n = at_most(s.n_max_rpm, 0);
  if (!s.constant_surface_speed) return "G97 S" + S + " M3\n";
  if (control == Control::linuxcnc) return "G96 D" + n + " S" + S + " M3\n";
  return "G50 S" + n + "\nG96 S" + S + " M3\n";
}

}  // namespace

std::string text(const SetupProgram& p, Control control) {
  const bool fanuc = control == Control::fanuc;
  std::string out = "%\n";
  if (fanuc) out += fmt::format("O{:04}\n", p.setup + 1);
  for (const auto& c : p.comments) out += comment(c);
  for (const auto& t : p.tools)
    out +=
        comment(fmt::format("T{} {}{}", t.number, t.id,
                            t.re_mm > 0 ? ", corner " + number(t.re_mm, 3) + " mm" : ""));
  out += fanuc ? "G18 G21 G40 G99\n" : "G18 G21 G40 G80 G90 G95 G7 G61\n";
  int tool = 0, number_ = 10;
  bool running = false;
  for (const auto& s : p.steps) {
    if (s.stop) {
      out += running ? "M9\nM5\n" : "";
      running = false;
      for (const auto& c : s.comments) out += comment(c);
      out += "M0\n";
      continue;
    }
    for (const auto& c : s.comments) out += comment(c);
    if (s.tool != tool)
      out += fanuc ? fmt::format("N{} T{:02}{:02}\n", number_, s.tool, s.tool)
                   : fmt::format("N{} T{} M6\nG43 H{}\n", number_, s.tool, s.tool);
    number_ += 10;
    tool = s.tool;
    out += spindle(s, control);
    out += "M8\n";
    running = true;
    Moves moves(out, control, s.f_mm_rev);
    for (const auto& m : s.moves) moves.write(m);
  }
  return out + "M9\nM5\nM30\n%\n";
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
