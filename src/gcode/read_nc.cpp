#include "turnwright/gcode/read_nc.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/say.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::gcode {
namespace {

constexpr double kInch_mm = 25.4;
constexpr double kRadii_mm = 0.01;  // start and end of an arc may differ by so much
constexpr double kSame_mm = 1e-6;   // ends nearer than this make a whole circle
constexpr double kFarthest_mm = 1e6;
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

bool blank(char c) { return c == ' ' || c == '\t'; }

/// The first characters of the text in quotation marks: `bytes` of UTF-8, and the rest of
/// the last character.
std::string quoted(std::string_view text, std::size_t bytes) {
  const auto inside = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
  };
  std::size_t n = std::min(bytes, text.size());
  while (n < text.size() && inside(text[n])) ++n;
  std::string out = "\"";
  for (const char c : text.substr(0, n))
    out += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '?' : c;
  return out + '"';
}

/// Words and comments of a line.  Throws Fault.
void parse(std::string_view line, Block& block) {
  block.words.clear();
  block.comments.clear();
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
      if (end == line.npos) throw Fault{tr("( without )"), tr("comments that end")};
      block.comments += line.substr(i, end + 1 - i);
      i = end + 1;
      continue;
    }
    const std::size_t start = i;
    char letter = line[i++];
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    if (letter < 'A' || letter > 'Z')
      throw Fault{quoted(line.substr(start), 1),
                  tr("words of a letter and a number; no variables or expressions")};
    while (i < line.size() && blank(line[i])) ++i;
    if (i + 1 < line.size() && line[i] == '+' && line[i + 1] != '-') ++i;
    double value = 0;
    const auto [end, error] = std::from_chars(line.data() + i, line.data() + line.size(),
                                              value, std::chars_format::fixed);
    if (error != std::errc() || !(std::abs(value) <= 1e6))
      throw Fault{quoted(line.substr(start), 12),
                  say("a number after {}, at most 1e6", letter)};
    i = static_cast<std::size_t>(end - line.data());
    block.words.push_back({letter, value, line.substr(start, i - start)});
  }
}

/// The modal group of a code; two codes of one group exclude each other in a block.  0
/// for codes that are not interpreted.
constexpr auto kGroups = [] {
  using Codes = std::initializer_list<std::size_t>;
  std::array<unsigned, 100> group{};
  unsigned number = 0;
  for (const Codes& codes :
       {Codes{0, 1, 2, 3}, Codes{4}, Codes{7, 8}, Codes{17, 18, 19}, Codes{20, 21},
        Codes{40}, Codes{43, 49}, Codes{50, 92}, Codes{54, 55, 56, 57, 58, 59},
        Codes{61, 64}, Codes{80}, Codes{90, 91}, Codes{94, 95}, Codes{96, 97},
        Codes{98, 99}}) {
    ++number;
    for (const std::size_t g : codes) group[g] = number;
  }
  return group;
}();

/// A code's or offset's number.  Throws Fault.
int whole(const Word& w) {
  if (!(w.value >= 0) || w.value != std::floor(w.value))
    throw Fault{std::string(w.text), say("a whole number after {}", w.letter)};
  return static_cast<int>(w.value);
}

/// Number of a G word that is read.  Throws Fault.
int code(const Word& w) {
  const bool read = w.value >= 0 && w.value < static_cast<double>(kGroups.size()) &&
                    w.value == std::floor(w.value) &&
                    kGroups[static_cast<std::size_t>(w.value)] != 0;
  if (!read)
    throw Fault{
        std::string(w.text),
        tr("a code that can be compensated: G0 to G4, G7, G8, G17 to G21, G40, G43, "
           "G49, G54 to G59, G61, G64, G80, G90, G91, G94 to G99")};
  return static_cast<int>(w.value);
}

std::string number(double x) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return {text.data(), end};
}

class Interpreter {
 public:
  Interpreter(const NcSetup& setup, std::size_t lines)
      : setup_(setup), plane_(setup.lathe ? 18 : 17), diameter_(setup.diameter) {
    origin_ = offset("G54").value_or(Vec3{});
    tip_ = setup.start_mm;
    program_.start_mm = absolute(tip_);
    program_.moves.reserve(lines);
  }

  void line(std::size_t number, std::string_view text) {
    line_ = number;
    const int motion = motion_;
    try {
      take(text);
    } catch (const Fault& fault) {
      motion_ = motion;  // so that one fault is reported once
      program_.problems.push_back({number, fault.got, fault.expected});
    }
  }

  bool full() const { return full_; }

  NcProgram result() { return std::move(program_); }

 private:
  static constexpr int kNoMotion = -1;

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
    require_room();
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (text.find('\r') != text.npos)
      throw Fault{tr("a carriage return within the line"), tr("one block in a line")};
    const auto first = std::ranges::find_if_not(text, blank);
    if (first == text.end()) return pass(text);
    if (*first == '%') return tape_end(text);
    if (*first == '/') return deleted(text);
    parse(text, block_);
    require_going();
    require_single();
    before_.clear();
    after_.clear();
    unsigned groups = 0;
    std::optional<int> motion;
    bool alone = false, lengths = false;
    for (const Word& w : block_.words) {
      if (w.letter != 'G') continue;
      const int g = code(w);
      const unsigned bit = 1u << kGroups[static_cast<std::size_t>(g)];
      if (groups & bit)
        throw Fault{std::string(w.text), tr("one code of a group in a block")};
      groups |= bit;
      if (g <= 3) motion = g;
      alone = alone || g == 4 || g == 50 || g == 92;
      lengths = lengths || g == 43;
      state(g, w.text);
    }
    if (alone) return special(text);
    length(lengths);
    words();
    if (motion) motion_ = *motion;
    commanded_ = commanded_ || motion;
    append(after_, block_.comments);
    move(motion.has_value());
  }

  /// Controls differ in their treatment of lines after the end of the program.
  void require_going() const {
    if (ended_ && !block_.words.empty())
      throw Fault{std::string(block_.words[0].text),
                  tr("nothing but % and comments after M2 or M30")};
  }

  /// G words have their groups; a block may have several M words.
  void require_single() const {
    unsigned seen = 0;
    for (const Word& w : block_.words) {
      if (w.letter == 'G' || w.letter == 'M') continue;
      const unsigned bit = 1u << (w.letter - 'A');
      if (seen & bit)
        throw Fault{std::string(w.text), say("{} once in a block", w.letter)};
      seen |= bit;
    }
  }

  void state(int g, std::string_view text) {
    if (g <= 3) return;
    if (g == 90 || g == 91) {
      incremental_ = g == 91;
      return;
    }
    if (g == 7 || g == 8) diameter_ = g == 7;
    if (g >= 17 && g <= 19) plane_ = g;
    if (g == 20 || g == 21) inch_ = g == 20;
    if (g == 49) select(0);
    if (g == 80) motion_ = kNoMotion;
    if (g >= 54 && g <= 59) {
      std::string name = std::to_string(g);
      name.insert(name.begin(), 'G');
      const auto at = offset(name);
      if (!at && g != 54) throw Fault{name, tr("a work offset that is given")};
      shift(at.value_or(Vec3{}));
    }
    append(before_, text);
  }

  /// The tip stays, and its coordinates change.
  void shift(const Vec3& origin) {
    for (std::size_t k = 0; k < 3; ++k) tip_[k] += origin_[k] - origin[k];
    origin_ = origin;
  }

  /// The axes stay; the position then is that of another tip.
  void select(int number) {
    const auto vector = [this](int n) {
      const auto found = setup_.tool_offsets_mm.find(n);
      if (n != 0 && found == setup_.tool_offsets_mm.end())
        throw Fault{say("tool offset {}", n), tr("one that is given")};
      return n == 0 ? Vec3{} : found->second;
    };
    const Vec3 old = vector(tool_), now = vector(number);
    for (std::size_t k = 0; k < 3; ++k) tip_[k] += now[k] - old[k];
    tool_ = number;
  }

  /// A line of % may contain only comments, because controls differ in their treatment of
  /// anything else.
  void tape_end(std::string_view text) {
    parse(text.substr(text.find('%') + 1), block_);
    if (!block_.words.empty())
      throw Fault{'%' + std::string(block_.words[0].text), tr("% without words")};
    pass(text);
  }

  /// G43 and its H, each of which requires the other: H alone would silently select an
  /// offset.
  void length(bool asked) {
    const auto h = std::ranges::find(block_.words, 'H', &Word::letter);
    if (asked && h == block_.words.end()) throw Fault{"G43", tr("its offset number H")};
    if (!asked && h != block_.words.end())
      throw Fault{std::string(h->text), tr("H with G43")};
    if (asked) select(whole(*h));
  }

  /// Dwell and speed limit.  Their lines are passed on unchanged and so must not contain
  /// modal codes.
  void special(std::string_view text) {
    int codes = 0;
    bool dwell = false;
    for (const Word& w : block_.words) {
      if (w.letter == 'G' && ++codes > 1)
        throw Fault{std::string(w.text),
                    tr("G4, G50 and G92 as the only code of a block")};
      dwell = dwell || (w.letter == 'G' && w.value == 4);
    }
    for (const Word& w : block_.words)
      if (std::string_view(dwell ? "NGPXUSF" : "NGS").find(w.letter) == std::string::npos)
        throw Fault{std::string(w.text),
                    dwell ? tr("G4 with a time alone")
                          : tr("G50 or G92 with S alone, the speed limit")};
    pass(text);
  }

  /// A line that the control may omit (block delete) must neither move nor select
  /// anything.
  void deleted(std::string_view text) {
    auto rest = text.substr(text.find('/') + 1);
    if (!rest.empty() && rest.front() >= '1' && rest.front() <= '9')
      rest.remove_prefix(1);
    parse(rest, block_);
    require_going();
    for (const Word& w : block_.words) {
      if (w.letter == 'M') machine_code(w);
      if (std::string_view("NMSF").find(w.letter) == std::string::npos)
        throw Fault{
            '/' + std::string(w.text),
            tr("deleted blocks of N, M, S, F, which need no knowledge of the switch")};
    }
    pass(text);
  }

  static void append(std::string& to, std::string_view text) {
    if (!to.empty() && !text.empty()) to += ' ';
    to += text;
  }

  bool has(int g) const {
    return std::ranges::any_of(
        block_.words, [g](const Word& w) { return w.letter == 'G' && w.value == g; });
  }

  void words() {
    for (const Word& w : block_.words) switch (w.letter) {
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
          if (!before_.empty()) before_.insert(0, 1, ' ');
          before_.insert(0, w.text);
          break;
        case 'M':
          append(machine_code(w) ? after_ : before_, w.text);
          ended_ = ended_ || w.value == 2 || w.value == 30;
          break;
        case 'T':
          if (const int t = whole(w); setup_.lathe && t >= 100) select(t % 100);
          append(before_, w.text);
          break;
        case 'F':
        case 'S':
        case 'H':
          append(before_, w.text);
          break;
        default:
          other(w);
      }
  }

  void other(const Word& w) {
    const bool belongs = (w.letter == 'O' && block_.words.size() == 1) ||
                         ((w.letter == 'P' || w.letter == 'Q') && has(64)) ||
                         (w.letter == 'D' && has(96));
    if (!belongs)
      throw Fault{
          std::string(w.text),
          tr("words N G X Y Z I J K R F S T H M of a program without subprograms and "
             "further axes; O alone, P with G64, D with G96")};
    append(before_, w.text);
  }

  /// Whether the code acts after the motion of its block, as codes that stop or switch
  /// off do.
  static bool machine_code(const Word& w) {
    const int m = whole(w);
    // Subprograms, repetition, stored modal states.
    if (m == 47 || (m >= 70 && m <= 73) || (m >= 97 && m <= 99))
      throw Fault{std::string(w.text),
                  tr("a program without subprograms, repetition and restored states")};
    return m <= 2 || m == 5 || m == 9 || m == 30 || m == 60;
  }

  double mm(double value) const { return inch_ ? value * kInch_mm : value; }

  void move(bool commanded) {
    std::array<std::optional<double>, 3> to, centre;
    std::optional<double> radius;
    for (const Word& w : block_.words) {
      if (w.letter >= 'X' && w.letter <= 'Z') {
        if (setup_.axes.find(w.letter) == std::string::npos)
          throw Fault{std::string(w.text), say("axes of the machine: {}", setup_.axes)};
        const auto k = static_cast<std::size_t>(w.letter - 'X');
        to[k] = mm(w.value) * (k == 0 && diameter_ ? 0.5 : 1);
      }
      if (w.letter >= 'I' && w.letter <= 'K')
        centre[static_cast<std::size_t>(w.letter - 'I')] = mm(w.value);
      if (w.letter == 'R') radius = mm(w.value);
    }
    const bool anywhere = to[0] || to[1] || to[2];
    const bool arc = motion_ > 1;
    const bool arc_words = centre[0] || centre[1] || centre[2] || radius;
    if (arc_words && !arc)
      throw Fault{tr("I, J, K or R"), tr("arc words in G2 and G3 only")};
    if (!anywhere && !arc_words) {
      if (commanded && motion_ <= 1) append(before_, motion_ == 0 ? "G0" : "G1");
      if (commanded && arc) throw Fault{tr("no end"), tr("the end or centre of the arc")};
      append(before_, after_);
      return pass(before_);
    }
    if (motion_ == kNoMotion)
      throw Fault{tr("coordinates after G80"), tr("G0 to G3 before them")};
    if (!commanded_ && program_.rapid_assumed == 0) program_.rapid_assumed = line_;
    Vec3 end = tip_;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!to[k]) continue;
      end[k] = incremental_ ? tip_[k] + *to[k] : *to[k];
      if (!(std::abs(end[k]) <= kFarthest_mm))
        throw Fault{std::string(1, "XYZ"[k]) + " = " + number(end[k]) + " mm",
                    tr("coordinates within 1e6 mm")};
    }
    if (arc) {
      chords(end, centre, radius);
    } else {
      emit(end, true, true);
    }
    tip_ = end;
  }

  void require_room() {
    leave_if_asked();
    full_ = program_.moves.size() >= setup_.moves_max;
    if (full_)
      throw Fault{say("more than {} moves", setup_.moves_max),
                  tr("fewer; a wider tolerance makes shorter programs of arcs")};
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

  /// Centre of an arc of radius R through both ends, ccw; the longer arc if R < 0.
  std::array<double, 2> centre_of(double du, double dv, double R, bool ccw) const {
    const double half = std::hypot(du, dv) / 2;
    if (!(2 * half > kSame_mm))
      throw Fault{tr("R with the end at the start"),
                  tr("an end away from the start, or the centre instead of R")};
    const double rest = R * R - half * half;
    if (!(rest > -2 * std::abs(R) * kRadii_mm))
      throw Fault{"R " + number(std::abs(R)) + " mm",
                  say("at least half the distance of the ends, {} mm", number(half))};
    const double h =
        std::sqrt(std::max(0.0, rest)) / (2 * half) * ((R > 0) == ccw ? 1 : -1);
    return {du / 2 - h * dv, dv / 2 + h * du};
  }

  void chords(const Vec3& end, const std::array<std::optional<double>, 3>& given,
              std::optional<double> R) {
    const auto [u, v, w] = plane();
    if (given[w]) throw Fault{std::string(1, "IJK"[w]), tr("a centre in the plane")};
    for (const std::size_t k : {u, v})
      if (setup_.axes.find("XYZ"[k]) == std::string::npos)
        throw Fault{"G" + std::to_string(plane_),
                    say("an arc in a plane of the machine's axes: {}", setup_.axes)};
    const bool ccw = motion_ == 3;
    const double du = end[u] - tip_[u], dv = end[v] - tip_[v];
    if (R && (given[u] || given[v])) throw Fault{tr("R and a centre"), tr("one of them")};
    const std::array<double, 2> c =
        R ? centre_of(du, dv, *R, ccw)
          : std::array{given[u].value_or(0), given[v].value_or(0)};
    const double r0 = std::hypot(c[0], c[1]), r1 = std::hypot(du - c[0], dv - c[1]);
    if (!(r0 > 0)) throw Fault{tr("an arc of radius 0"), tr("a centre off the start")};
    if (!(std::abs(r1 - r0) <= kRadii_mm))
      throw Fault{say("radii {} and {} mm", number(r0), number(r1)),
                  tr("an arc whose ends are as far from the centre, within 0.01 mm")};
    const double pi = units::kPi;
    const double a0 = std::atan2(-c[1], -c[0]), a1 = std::atan2(dv - c[1], du - c[0]);
    double sweep = a1 - a0;
    if (std::hypot(du, dv) <= kSame_mm) sweep = 0;
    if (ccw && sweep <= 0) sweep += 2 * pi;
    if (!ccw && sweep >= 0) sweep -= 2 * pi;
    // Fractions of the sweep at which an axis reverses, and the end.
    std::vector<double> stops;
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
      if (!(parts <= kMostChords))
        throw Fault{tr("an arc"), tr("a tolerance it can be cut to")};
      const auto n = std::max<std::size_t>(1, static_cast<std::size_t>(parts));
      for (std::size_t i = 1; i <= n; ++i) {
        const double share =
            from + (stop - from) * static_cast<double>(i) / static_cast<double>(n);
        const bool last = i == n && stop == 1;
        require_room();
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
  Block block_;
  int plane_, motion_ = 0, tool_ = 0;
  bool full_ = false;
  bool commanded_ = false;  // a motion code was read
  bool ended_ = false;      // by M2 or M30
  bool inch_ = false, incremental_ = false, diameter_;
  Vec3 origin_{}, tip_{};  // tip in program coordinates [mm], X as radius
  std::string before_, after_;
};

}  // namespace

NcProgram read_nc(const std::vector<std::string_view>& lines, const NcSetup& setup) {
  Interpreter interpreter(setup, lines.size());
  for (std::size_t i = 0; i < lines.size() && !interpreter.full(); ++i)
    interpreter.line(i + 1, lines[i]);
  return interpreter.result();
}

}  // namespace turnwright::gcode
