#include "turnwright/tolerance/iso286.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/say.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::tolerance {
namespace {

constexpr std::size_t kRanges = 13, kSteps = 25, kGrades = 20;

/// Upper ends [mm] of the main ranges and of the steps that divide them.
constexpr std::array<double, kRanges> kRangeTo{3,   6,   10,  18,  30,  50, 80,
                                               120, 180, 250, 315, 400, 500};
constexpr std::array<double, kSteps> kStepTo{3,   6,   10,  14,  18,  24,  30,  40,  50,
                                             65,  80,  100, 120, 140, 160, 180, 200, 225,
                                             250, 280, 315, 355, 400, 450, 500};

// Rows: IT01, IT0, IT1 .. IT18; columns: the main ranges [um].
// clang-format off
constexpr std::array<std::array<double, kRanges>, kGrades> kIT{{
  { 0.3,  0.4,  0.4,  0.5,  0.6,  0.6,  0.8,    1,  1.2,    2,  2.5,    3,    4},
  { 0.5,  0.6,  0.6,  0.8,    1,    1,  1.2,  1.5,    2,    3,    4,    5,    6},
  { 0.8,    1,    1,  1.2,  1.5,  1.5,    2,  2.5,  3.5,  4.5,    6,    7,    8},
  { 1.2,  1.5,  1.5,    2,  2.5,  2.5,    3,    4,    5,    7,    8,    9,   10},
  {   2,  2.5,  2.5,    3,    4,    4,    5,    6,    8,   10,   12,   13,   15},
  {   3,    4,    4,    5,    6,    7,    8,   10,   12,   14,   16,   18,   20},
  {   4,    5,    6,    8,    9,   11,   13,   15,   18,   20,   23,   25,   27},
  {   6,    8,    9,   11,   13,   16,   19,   22,   25,   29,   32,   36,   40},
  {  10,   12,   15,   18,   21,   25,   30,   35,   40,   46,   52,   57,   63},
  {  14,   18,   22,   27,   33,   39,   46,   54,   63,   72,   81,   89,   97},
  {  25,   30,   36,   43,   52,   62,   74,   87,  100,  115,  130,  140,  155},
  {  40,   48,   58,   70,   84,  100,  120,  140,  160,  185,  210,  230,  250},
  {  60,   75,   90,  110,  130,  160,  190,  220,  250,  290,  320,  360,  400},
  { 100,  120,  150,  180,  210,  250,  300,  350,  400,  460,  520,  570,  630},
  { 140,  180,  220,  270,  330,  390,  460,  540,  630,  720,  810,  890,  970},
  { 250,  300,  360,  430,  520,  620,  740,  870, 1000, 1150, 1300, 1400, 1550},
  { 400,  480,  580,  700,  840, 1000, 1200, 1400, 1600, 1850, 2100, 2300, 2500},
  { 600,  750,  900, 1100, 1300, 1600, 1900, 2200, 2500, 2900, 3200, 3600, 4000},
  {1000, 1200, 1500, 1800, 2100, 2500, 3000, 3500, 4000, 4600, 5200, 5700, 6300},
  {1400, 1800, 2200, 2700, 3300, 3900, 4600, 5400, 6300, 7200, 8100, 8900, 9700}}};

/// Marks a cell that is empty in the standard.
constexpr int kNone = -1;

struct ByRange {
  std::string_view letter;
  std::array<int, kRanges> um;
};
struct ByStep {
  std::string_view letter;
  std::array<int, kSteps> um;
};

// Magnitudes of the shafts' fundamental deviations [um], es = -x for a..g.
constexpr std::array<ByStep, 3> kLooseByStep{{
  {"a", {270, 270, 280, 290, 290, 300, 300, 310, 320, 340, 360, 380, 410, 460, 520, 580,
         660, 740, 820, 920, 1050, 1200, 1350, 1500, 1650}},
  {"b", {140, 140, 150, 150, 150, 160, 160, 170, 180, 190, 200, 220, 240, 260, 280, 310,
         340, 380, 420, 480, 540, 600, 680, 760, 840}},
  {"c", {60, 70, 80, 95, 95, 110, 110, 120, 130, 140, 150, 170, 180, 200, 210, 230,
         240, 260, 280, 300, 330, 360, 400, 440, 480}}}};
constexpr std::array<ByRange, 8> kLooseByRange{{
  {"cd", {34, 46, 56, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}},
  {"d", {20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230}},
  {"e", {14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135}},
  {"ef", {10, 14, 18, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}},
  {"f", {6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68}},
  {"fg", {4, 6, 8, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}},
  {"g", {2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20}},
  {"h", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}};

// The same, ei = +x for k..zc; k's holds for IT4..IT7.
constexpr std::array<ByRange, 4> kTightByRange{{
  {"k", {0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5}},
  {"m", {2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23}},
  {"n", {4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40}},
  {"p", {6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68}}}};
constexpr std::array<ByStep, 11> kTightByStep{{
  {"r", {10, 15, 19, 23, 23, 28, 28, 34, 34, 41, 43, 51, 54, 63, 65, 68,
         77, 80, 84, 94, 98, 108, 114, 126, 132}},
  {"s", {14, 19, 23, 28, 28, 35, 35, 43, 43, 53, 59, 71, 79, 92, 100, 108,
         122, 130, 140, 158, 170, 190, 208, 232, 252}},
  {"t", {kNone, kNone, kNone, kNone, kNone, kNone, 41, 48, 54, 66, 75, 91, 104, 122, 134,
         146, 166, 180, 196, 218, 240, 268, 294, 330, 360}},
  {"u", {18, 23, 28, 33, 33, 41, 48, 60, 70, 87, 102, 124, 144, 170, 190, 210,
         236, 258, 284, 315, 350, 390, 435, 490, 540}},
  {"v", {kNone, kNone, kNone, kNone, 39, 47, 55, 68, 81, 102, 120, 146, 172, 202, 228,
         252, 284, 310, 340, 385, 425, 475, 530, 595, 660}},
  {"x", {20, 28, 34, 40, 45, 54, 64, 80, 97, 122, 146, 178, 210, 248, 280, 310,
         350, 385, 425, 475, 525, 590, 660, 740, 820}},
  {"y", {kNone, kNone, kNone, kNone, kNone, 63, 75, 94, 114, 144, 174, 214, 254, 300, 340,
         380, 425, 470, 520, 580, 650, 730, 820, 920, 1000}},
  {"z", {26, 35, 42, 50, 60, 73, 88, 112, 136, 172, 210, 258, 310, 365, 415, 465,
         520, 575, 640, 710, 790, 900, 1000, 1100, 1250}},
  {"za", {32, 42, 52, 64, 77, 98, 118, 148, 180, 226, 274, 335, 400, 470, 535, 600,
          670, 740, 820, 920, 1000, 1150, 1300, 1450, 1600}},
  {"zb", {40, 50, 67, 90, 108, 136, 160, 200, 242, 300, 360, 445, 525, 620, 700, 780,
          880, 960, 1050, 1200, 1300, 1500, 1650, 1850, 2100}},
  {"zc", {60, 80, 97, 130, 150, 188, 218, 274, 325, 405, 480, 585, 690, 800, 900, 1000,
          1150, 1250, 1350, 1550, 1700, 1900, 2100, 2400, 2600}}}};

// j: ei [um] of j5 and j6, of j7 and, to 3 mm, of j8.  J: ES [um] of J6, J7, J8.
constexpr std::array<int, kRanges> kj56{-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20};
constexpr std::array<int, kRanges> kj7{-4, -4, -5, -6, -8, -10, -12, -15, -18, -21, -26, -28, -32};
constexpr int kj8 = -6;
constexpr std::array<std::array<int, kRanges>, 3> kJ{{
  {2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33},
  {4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43},
  {6, 10, 12, 15, 20, 24, 28, 34, 41, 47, 55, 60, 66}}};
// clang-format on

template <std::size_t N>
std::size_t index_of(double nominal_mm, const std::array<double, N>& up_to) {
  if (!(nominal_mm > 0 && nominal_mm <= up_to.back()))
    throw std::domain_error(
        say("nominal size {} mm: ISO 286 is held here for sizes above 0 up to 500 mm",
            nominal_mm));
  return static_cast<std::size_t>(std::ranges::lower_bound(up_to, nominal_mm) -
                                  up_to.begin());
}

/// A size with its rows in the tables, and the required tolerance class.
struct Asked {
  double nominal_mm;
  std::size_t range, step;
  std::string_view text;
  std::string letter;  ///< lower case
  bool bore;
  Grade grade;
};

[[noreturn]] void refuse(std::string_view tolerance_class, const std::string& why) {
  throw std::domain_error(say("tolerance class '{}': {}", tolerance_class, why));
}

bool at_most(const Asked& a, Grade grade) { return a.grade <= grade; }

template <class Table>
const auto* find(const Table& table, std::string_view letter) {
  const auto row =
      std::ranges::find(table, letter, [](const auto& r) { return r.letter; });
  return row == table.end() ? nullptr : &*row;
}

/// Magnitude [um] of the letter's deviation at this size, from one of the two tables.
template <class Steps, class Ranges>
std::optional<int> magnitude_um(const Asked& a, const Steps& by_step,
                                const Ranges& by_range) {
  int um = 0;
  if (const auto* row = find(by_step, a.letter))
    um = row->um[a.step];
  else if (const auto* other = find(by_range, a.letter))
    um = other->um[a.range];
  else
    return std::nullopt;
  if (um == kNone)
    refuse(a.text,
           say("ISO 286-1 gives {} no deviation at {} mm ({})", a.letter, a.nominal_mm,
               a.letter == "t"   ? tr("t starts above 24 mm")
               : a.letter == "v" ? tr("v starts above 14 mm")
               : a.letter == "y" ? tr("y starts above 18 mm")
                                 : tr("cd, ef and fg end at 10 mm")));
  return um;
}

Asked read(double nominal_mm, std::string_view text) {
  Asked a{.nominal_mm = nominal_mm,
          .range = index_of(nominal_mm, kRangeTo),
          .step = index_of(nominal_mm, kStepTo),
          .text = text,
          .letter = {},
          .bore = false,
          .grade = Grade::IT01};
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto is_letter = [&](char c) { return is_upper(c) || (c >= 'a' && c <= 'z'); };
  const std::string_view letters = text.substr(
      0,
      static_cast<std::size_t>(std::ranges::find_if_not(text, is_letter) - text.begin()));
  const std::string_view digits = text.substr(letters.size());
  if (letters.empty() || digits.empty())
    refuse(text,
           tr("write a letter and a grade, such as k6 for a shaft or H7 for a bore"));
  a.bore = is_upper(letters.front());
  for (const char c : letters) {
    if (is_upper(c) != a.bore)
      refuse(text,
             tr("capitals are bores and small letters are shafts, they do not mix"));
    a.letter += static_cast<char>(a.bore ? c - 'A' + 'a' : c);
  }
  static constexpr std::array<std::string_view, kGrades> kNames{
      "01", "0",  "1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",
      "9",  "10", "11", "12", "13", "14", "15", "16", "17", "18"};
  const auto grade = std::ranges::find(kNames, digits);
  if (grade == kNames.end())
    refuse(text, say("'{}' is no grade, they are 01, 0, 1, 2 .. 18", digits));
  a.grade = static_cast<Grade>(grade - kNames.begin());
  return a;
}

/// ei or ES [um] of j and J.
double j_um(const Asked& a) {
  using enum Grade;
  if (a.bore) {
    if (a.grade < IT6 || a.grade > IT8)
      refuse(a.text, tr("J is made in the grades 6, 7 and 8 only; JS has them all"));
    return kJ[static_cast<std::size_t>(a.grade) - static_cast<std::size_t>(IT6)][a.range];
  }
  if (a.grade == IT8 && a.range == 0) return kj8;
  if (a.grade == IT7) return kj7[a.range];
  if (a.grade == IT5 || a.grade == IT6) return kj56[a.range];
  refuse(a.text,
         tr("j is made in the grades 5, 6, 7 and, up to 3 mm, 8 only; js has them all"));
}

/// ES [um] of the bores K..ZC from the shaft's ei.
double tight_bore_um(const Asked& a, double ei_um) {
  using enum Grade;
  if (a.grade < IT3)
    refuse(a.text, tr("ISO 286-1 gives the bores K to ZC from grade 3 on only"));
  const bool kmn = a.letter == "k" || a.letter == "m" || a.letter == "n";
  const bool smallest = a.range == 0;  // Delta = 0 there
  if (!at_most(a, kmn ? IT8 : IT7)) {
    if (a.letter == "k" && !smallest)
      refuse(a.text, tr("K above 3 mm is made in the grades 3 to 8 only"));
    if (a.letter == "n" && a.nominal_mm <= 1)
      refuse(a.text, tr("N coarser than grade 8 is not used up to 1 mm"));
    return a.letter == "n" && !smallest ? 0 : -ei_um;
  }
  if (smallest) return -ei_um;
  if (a.letter == "m" && a.grade == IT6 && kRangeTo[a.range] == 315) return -9;
  const auto n = static_cast<std::size_t>(a.grade);
  return -ei_um + kIT[n][a.range] - kIT[n - 1][a.range];
}

part::Limits mm(double lower_um, double upper_um) {
  return {.lower_mm = units::mm_from_um(lower_um),
          .upper_mm = units::mm_from_um(upper_um)};
}

}  // namespace

double it_um(double nominal_mm, Grade grade) {
  const std::size_t range = index_of(nominal_mm, kRangeTo);
  if (grade >= Grade::IT14 && nominal_mm <= 1)
    throw std::domain_error(
        say("nominal size {} mm: IT14 and coarser are not used up to 1 mm", nominal_mm));
  return kIT[static_cast<std::size_t>(grade)][range];
}

part::Limits fit_limits_mm(double nominal_mm, std::string_view tolerance_class) {
  const Asked a = read(nominal_mm, tolerance_class);
  const double it = it_um(nominal_mm, a.grade);
  if (a.letter == "js") return mm(-it / 2, it / 2);
  if (a.letter == "j")
    return a.bore ? mm(j_um(a) - it, j_um(a)) : mm(j_um(a), j_um(a) + it);
  if (const auto loose = magnitude_um(a, kLooseByStep, kLooseByRange)) {
    if (nominal_mm <= 1 && (a.letter == "a" || a.letter == "b"))
      refuse(a.text, tr("a and b, A and B are not used up to 1 mm"));
    return a.bore ? mm(*loose, *loose + it) : mm(-*loose - it, -*loose);
  }
  if (const auto tight = magnitude_um(a, kTightByStep, kTightByRange)) {
    if (a.bore) {
      const double ES = tight_bore_um(a, *tight);
      return mm(ES - it, ES);
    }
    const bool zero = a.letter == "k" && (a.grade < Grade::IT4 || a.grade > Grade::IT7);
    const double ei = zero ? 0 : *tight;
    return mm(ei, ei + it);
  }
  refuse(tolerance_class,
         say("ISO 286-1 has no letter {}; it has a b c cd d e ef f fg g h js j k m "
             "n p r s t u v x y z za zb zc, in capitals for bores",
             a.letter));
}

}  // namespace turnwright::tolerance
