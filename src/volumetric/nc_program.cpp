#include "turnwright/volumetric/nc_program.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace turnwright::volumetric {
namespace {

constexpr double kInch_mm = 25.4;
constexpr double kRadii_mm = 0.01;  // start and end of an arc may differ by so much
constexpr std::size_t kMostChords = 100000;

struct Word {
  char letter = 0;
  double value = 0;
  std::string_view text;  // with its letter
};

struct Block {
  std::vector<Word> words;
  std::string comments;
};

struct Fault {
  std::string got, expected;
};

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Words and comments of a line.  Throws Fault.
Block parsed(std::string_view line) {
  Block block;
  std::size_t i = 0;
  while (i < line.size()) {
    if (blank(line[i])) {
      ++i;
      continue;
    }
    if (line[i] == ';') {
      block.comments += line.substr(i);
      break;
    }
    if (line[i] == '(') {
      const auto end = line.find(')', i);
      if (end == line.npos) throw Fault{"( without )", "comments that end"};
      block.comments += line.substr(i, end + 1 - i);
      i = end + 1;
      continue;
    }
    const std::size_t start = i;
    char letter = line[i++];
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    if (letter < 'A' || letter > 'Z')
      throw Fault{std::string("\"") + letter + '"',
                  "words of a letter and a number; no variables, expressions or deleted "
                  "blocks"};
    while (i < line.size() && blank(line[i])) ++i;
    if (i < line.size() && line[i] == '+') ++i;
    double value = 0;
    const auto [end, error] = std::from_chars(line.data() + i, line.data() + line.size(),
                                              value, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(value) || !(std::abs(value) <= 1e6))
      throw Fault{std::string("\"") + std::string(line.substr(start, 12)) + '"',
                  std::string("a number after ") + letter + ", at most 1e6"};
    i = static_cast<std::size_t>(end - line.data());
    block.words.push_back({letter, value, line.substr(start, i - start)});
  }
  return block;
}

std::string number(double x) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return {text.data(), end};
}

class Interpreter {
 public:
  explicit Interpreter(const NcSetup& setup)
      : setup_(setup), plane_(setup.lathe ? 18 : 17), diameter_(setup.diameter) {
    origin_ = offset("G54").value_or(Vec3{});
    tip_ = setup.start_mm;
    program_.start_mm = absolute(tip_);
  }

  void line(std::size_t number, std::string_view text) {
    line_ = number;
    const int motion = motion_;
    try {
      take(text);
    } catch (const Fault& fault) {
      motion_ = motion;  // so that one fault is told once
      program_.problems.push_back({number, fault.got, fault.expected});
    }
  }

  NcProgram result() { return std::move(program_); }

 private:
  static constexpr int kThrough[] = {40, 61, 64, 80, 94, 95, 96, 97, 98, 99};

  std::optional<Vec3> offset(const std::string& name) const {
    const auto found = setup_.work_offsets_mm.find(name);
    if (found == setup_.work_offsets_mm.end()) return std::nullopt;
    return found->second;
  }

  Vec3 absolute(const Vec3& p) const {
    return {p[0] + origin_[0], p[1] + origin_[1], p[2] + origin_[2]};
  }

  void pass(std::string_view text) {
    program_.moves.push_back({.line = line_, .before = std::string(text)});
  }

  void take(std::string_view text) {
    const auto first = std::ranges::find_if_not(text, blank);
    if (first == text.end() || *first == '%') return pass(text);
    const Block block = parsed(text);
    std::optional<int> motion;
    bool dwell = false, limit = false;
    before_.clear();
    after_.clear();
    std::optional<int> height;
    bool lengths = false;
    for (const Word& w : block.words) {
      if (w.letter == 'H') height = static_cast<int>(w.value);
      if (w.letter != 'G') continue;
      if (w.value != std::floor(w.value)) throw unknown(w);
      const int g = static_cast<int>(w.value);
      if (g <= 3 && g >= 0) {
        if (motion) throw Fault{std::string(w.text), "one of G0 to G3 in a block"};
        motion = g;
        continue;
      }
      dwell = dwell || g == 4;
      limit = limit || g == 50 || g == 92;
      lengths = lengths || g == 43;
      state(g, w);
    }
    if (dwell || limit) return special(block, dwell, text);
    if (lengths) select(height.value_or(-1));
    words(block);
    if (motion) motion_ = *motion;
    append(after_, block.comments);
    move(block, motion.has_value());
  }

  static Fault unknown(const Word& w) {
    return {std::string(w.text),
            "a code that can be compensated: G0 to G4, G7, G8, G17 to G21, G40, G43, "
            "G49, G54 to G59, G61, G64, G80, G90, G91, G94 to G99"};
  }

  void state(int g, const Word& w) {
    bool keep = true;
    if (g >= 17 && g <= 19) {
      plane_ = g;
    } else if (g == 20 || g == 21) {
      inch_ = g == 20;
    } else if (g == 90 || g == 91) {
      incremental_ = g == 91;
      keep = false;
    } else if (g == 7 || g == 8) {
      diameter_ = g == 7;
    } else if (g >= 54 && g <= 59) {
      const std::string name = "G" + std::to_string(g);
      const auto at = offset(name);
      if (!at && g != 54) throw Fault{name, "a work offset that is given"};
      shift(at.value_or(Vec3{}));
    } else if (g == 49) {
      tool_ = 0;
    } else if (g != 43 && g != 4 && g != 50 && g != 92 &&
               std::ranges::find(kThrough, g) == std::end(kThrough)) {
      throw unknown(w);
    }
    if (keep) append(before_, w.text);
  }

  /// The tip stays, its coordinates change.
  void shift(const Vec3& origin) {
    for (std::size_t k = 0; k < 3; ++k) tip_[k] += origin_[k] - origin[k];
    origin_ = origin;
  }

  void special(const Block& block, bool dwell, std::string_view text) {
    for (const Word& w : block.words)
      if (!dwell && w.letter != 'G' && w.letter != 'S' && w.letter != 'N')
        throw Fault{std::string(w.text), "G50 or G92 with S alone, the speed limit"};
    pass(text);
  }

  void select(int number) {
    if (number != 0 && !setup_.tool_offsets_mm.contains(number))
      throw Fault{"tool offset " + std::to_string(number), "one that is given"};
    tool_ = number;
  }

  static void append(std::string& to, std::string_view text) {
    if (!to.empty() && !text.empty()) to += ' ';
    to += text;
  }

  void words(const Block& block) {
    for (const Word& w : block.words) switch (w.letter) {
        case 'G':
        case 'X':
        case 'Y':
        case 'Z':
        case 'I':
        case 'J':
        case 'K':
        case 'R':
          break;
        case 'N':
          before_ = std::string(w.text) + (before_.empty() ? "" : " ") + before_;
          break;
        case 'M':
          machine_code(w);
          break;
        case 'T':
          if (setup_.lathe && w.value >= 100) select(static_cast<int>(w.value) % 100);
          append(before_, w.text);
          break;
        case 'F':
        case 'S':
        case 'H':
          append(before_, w.text);
          break;
        case 'O':
          if (block.words.size() > 1) throw Fault{std::string(w.text), "O alone"};
          append(before_, w.text);
          break;
        default:
          throw Fault{std::string(w.text),
                      "words N G X Y Z I J K R F S T H M of a program without "
                      "subprograms and further axes"};
      }
  }

  void machine_code(const Word& w) {
    const int m = static_cast<int>(w.value);
    if (m == 97 || m == 98 || m == 99)
      throw Fault{std::string(w.text), "a program without subprograms"};
    // What stops or switches off does so after the block's motion.
    const bool late = m <= 2 || m == 5 || m == 9 || m == 30 || m == 60;
    append(late ? after_ : before_, w.text);
  }

  double mm(double value) const { return inch_ ? value * kInch_mm : value; }

  void move(const Block& block, bool commanded) {
    std::array<std::optional<double>, 3> to, centre;
    std::optional<double> radius;
    for (const Word& w : block.words) {
      if (w.letter >= 'X' && w.letter <= 'Z') {
        if (setup_.axes.find(w.letter) == std::string::npos)
          throw Fault{std::string(w.text), "axes of the machine: " + setup_.axes};
        const auto k = static_cast<std::size_t>(w.letter - 'X');
        if (to[k]) throw Fault{std::string(w.text), "each axis once in a block"};
        to[k] = mm(w.value) * (k == 0 && diameter_ ? 0.5 : 1);
      }
      if (w.letter >= 'I' && w.letter <= 'K')
        centre[static_cast<std::size_t>(w.letter - 'I')] = mm(w.value);
      if (w.letter == 'R') radius = mm(w.value);
    }
    const bool anywhere = to[0] || to[1] || to[2];
    const bool arc = motion_ > 1;
    const bool arc_words = centre[0] || centre[1] || centre[2] || radius;
    if (arc_words && !arc) throw Fault{"I, J, K or R", "arc words in G2 and G3 only"};
    if (!anywhere && !arc_words) {
      if (commanded && motion_ <= 1) append(before_, motion_ == 0 ? "G0" : "G1");
      if (commanded && arc) throw Fault{"no end", "the end or centre of the arc"};
      append(before_, after_);
      return pass(before_);
    }
    Vec3 end = tip_;
    for (std::size_t k = 0; k < 3; ++k)
      if (to[k]) end[k] = incremental_ ? tip_[k] + *to[k] : *to[k];
    if (arc) {
      chords(end, centre, radius);
    } else {
      emit(end, true, true);
    }
    tip_ = end;
  }

  void emit(const Vec3& p, bool first, bool last) {
    program_.moves.push_back({.line = line_,
                              .moves = true,
                              .rapid = motion_ == 0,
                              .inch = inch_,
                              .diameter = diameter_,
                              .target_mm = absolute(p),
                              .origin_mm = origin_,
                              .tool = tool_,
                              .before = first ? before_ : "",
                              .after = last ? after_ : ""});
  }

  /// Both axes of the plane, turning from the first to the second, and the one across.
  std::array<std::size_t, 3> plane() const {
    if (plane_ == 17) return {0, 1, 2};
    if (plane_ == 18) return {2, 0, 1};
    return {1, 2, 0};
  }

  /// Of an arc of radius R through both ends, ccw; the long way round if R < 0.
  std::array<double, 2> centre_of(double du, double dv, double R, bool ccw) const {
    const double half = std::hypot(du, dv) / 2;
    if (!(half > 0)) throw Fault{"R and no other end", "an end, or the centre"};
    const double rest = R * R - half * half;
    if (!(rest > -2 * std::abs(R) * kRadii_mm))
      throw Fault{"R " + number(std::abs(R)) + " mm",
                  "at least half the distance of the ends, " + number(half) + " mm"};
    const double h =
        std::sqrt(std::max(0.0, rest)) / (2 * half) * ((R > 0) == ccw ? 1 : -1);
    return {du / 2 - h * dv, dv / 2 + h * du};
  }

  void chords(const Vec3& end, const std::array<std::optional<double>, 3>& given,
              std::optional<double> R) {
    const auto [u, v, w] = plane();
    if (given[w]) throw Fault{std::string(1, "IJK"[w]), "a centre in the plane"};
    const bool ccw = motion_ == 3;
    const double du = end[u] - tip_[u], dv = end[v] - tip_[v];
    if (R && (given[u] || given[v])) throw Fault{"R and a centre", "one of them"};
    const std::array<double, 2> c =
        R ? centre_of(du, dv, *R, ccw)
          : std::array{given[u].value_or(0), given[v].value_or(0)};
    const double r0 = std::hypot(c[0], c[1]), r1 = std::hypot(du - c[0], dv - c[1]);
    if (!(r0 > 0)) throw Fault{"an arc of radius 0", "a centre off the start"};
    if (!(std::abs(r1 - r0) <= kRadii_mm))
      throw Fault{"radii " + number(r0) + " and " + number(r1) + " mm",
                  "an arc whose ends are as far from the centre, within 0.01 mm"};
    const double pi = units::kPi;
    const double a0 = std::atan2(-c[1], -c[0]), a1 = std::atan2(dv - c[1], du - c[0]);
    double sweep = a1 - a0;
    const bool closed = du == 0 && dv == 0;
    if (ccw && (closed || sweep <= 0)) sweep += 2 * pi;
    if (!ccw && (closed || sweep >= 0)) sweep -= 2 * pi;
    std::vector<double>
        stops;  // shares of the sweep: where an axis reverses, and the end
    for (int q = -8; q <= 8; ++q) {
      const double share = (q * pi / 2 - a0) / sweep;
      if (share > 1e-9 && share < 1 - 1e-9) stops.push_back(share);
    }
    std::ranges::sort(stops);
    stops.push_back(1);
    const double step =
        2 * std::acos(std::max(0.0, 1 - setup_.tolerance_mm / std::max(r0, r1)));
    double from = 0;
    for (const double stop : stops) {
      const double parts = std::ceil((stop - from) * std::abs(sweep) / step);
      if (!(parts <= kMostChords)) throw Fault{"an arc", "a tolerance it can be cut to"};
      const auto n = std::max<std::size_t>(1, static_cast<std::size_t>(parts));
      for (std::size_t i = 1; i <= n; ++i) {
        const double share =
            from + (stop - from) * static_cast<double>(i) / static_cast<double>(n);
        const bool last = i == n && stop == 1;
        const double a = a0 + share * sweep, r = r0 + share * (r1 - r0);
        Vec3 p = end;
        if (!last) {
          p[u] = tip_[u] + c[0] + r * std::cos(a);
          p[v] = tip_[v] + c[1] + r * std::sin(a);
          p[w] = tip_[w] + share * (end[w] - tip_[w]);
        }
        emit(p, from == 0 && i == 1, last);
      }
      from = stop;
    }
  }

  const NcSetup& setup_;
  NcProgram program_;
  std::size_t line_ = 0;
  int plane_, motion_ = 0, tool_ = 0;
  bool inch_ = false, incremental_ = false, diameter_;
  Vec3 origin_{}, tip_{};  // tip in program coordinates [mm], X as radius
  std::string before_, after_;
};

}  // namespace

NcProgram read_nc(const std::vector<std::string_view>& lines, const NcSetup& setup) {
  Interpreter interpreter(setup);
  for (std::size_t i = 0; i < lines.size(); ++i) interpreter.line(i + 1, lines[i]);
  return interpreter.result();
}

}  // namespace turnwright::volumetric
