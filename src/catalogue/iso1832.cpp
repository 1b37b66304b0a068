#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/say.hpp"
#include "designation.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/catalogue/tool_codes.hpp"

namespace turnwright::catalogue {
namespace {

/// Edge length per inscribed-circle diameter, and the corner angle.
struct Shape {
  char letter;
  double included_angle_deg;
  double edge_per_circle;
};

double rhombus(double angle_deg) {
  return 1.0 / std::sin(units::rad_from_deg(angle_deg));
}
double regular(int corners) { return std::tan(std::numbers::pi / corners); }

// The trigon touches its circle between corners of 80 and 160 degrees.
double trigon() {
  return 0.5 / std::tan(units::rad_from_deg(40)) +
         0.5 / std::tan(units::rad_from_deg(80));
}

std::optional<Shape> shape_of(char letter) {
  for (const Shape& shape : {Shape{'C', 80, rhombus(80)}, Shape{'D', 55, rhombus(55)},
                             Shape{'E', 75, rhombus(75)}, Shape{'M', 86, rhombus(86)},
                             Shape{'V', 35, rhombus(35)}, Shape{'T', 60, regular(3)},
                             Shape{'S', 90, regular(4)}, Shape{'P', 108, regular(5)},
                             Shape{'H', 120, regular(6)}, Shape{'O', 135, regular(8)},
                             Shape{'W', 80, trigon()}, Shape{'R', 0, 1.0}})
    if (shape.letter == letter) return shape;
  return std::nullopt;
}

constexpr std::array kCircles_mm{3.97, 4.76,   5.56,  6.35, 7.94, 9.525,
                                 12.7, 15.875, 19.05, 25.4, 31.75};

constexpr std::array<std::string_view, 13> kThicknessCodes{
    "01", "T1", "02", "T2", "03", "T3", "04", "05", "06", "07", "09", "11", "12"};
constexpr std::array kThickness_mm{1.59, 1.98, 2.38, 2.78, 3.18,  3.97, 4.76,
                                   5.56, 6.35, 7.94, 9.52, 11.11, 12.7};

/// The code is the edge length, taken to 0.1 mm (a triangle of 21.997 mm is 22.0),
/// without its decimal.
int edge_code(double edge_mm) { return static_cast<int>(std::lround(10 * edge_mm) / 10); }

double edge_mm(const Shape& shape, int code, const Designation& reader) {
  std::optional<double> found;
  for (const double circle : kCircles_mm) {
    const double edge = circle * shape.edge_per_circle;
    if (edge_code(edge) != code) continue;
    if (found) reader.fail(tr("fits more than one inscribed circle of this shape"));
    found = edge;
  }
  if (!found) reader.fail(tr("fits no inscribed circle of this shape"));
  return *found;
}

double thickness_mm(std::string_view code, const Designation& reader) {
  const auto at = std::find(kThicknessCodes.begin(), kThicknessCodes.end(), code);
  if (at != kThicknessCodes.end())
    return kThickness_mm[static_cast<std::size_t>(at - kThicknessCodes.begin())];
  reader.fail(tr("is no thickness of the standard"));
}

constexpr double kRounded_mm = 0.06;  // makers print edges and thicknesses to 0.1 mm

std::string two_digits(long number) {
  const std::string digits = std::to_string(number);
  return digits.size() < 2 ? "0" + digits : digits;
}

[[noreturn]] void no_code(const std::string& what, double mm) {
  throw std::domain_error(
      fmt::format("encode_iso1832: {} of {:.4g} mm is none of the standard", what, mm));
}

std::string edge_symbol(const Shape& shape, double mm) {
  for (const double circle : kCircles_mm) {
    const double edge = circle * shape.edge_per_circle;
    if (std::abs(edge - mm) <= kRounded_mm) return two_digits(edge_code(edge));
  }
  no_code("an edge", mm);
}

std::string thickness_symbol(double mm) {
  for (std::size_t i = 0; i < kThickness_mm.size(); ++i)
    if (std::abs(kThickness_mm[i] - mm) <= kRounded_mm)
      return std::string(kThicknessCodes[i]);
  no_code("a thickness", mm);
}

std::string corner_symbol(double mm) {
  constexpr double kOff_mm = 0.0251;  // 1/8 in = 3.175 mm bears 32
  const double tenths = std::round(10 * mm);
  if (!(std::abs(10 * mm - tenths) <= 10 * kOff_mm) || tenths < 0 || tenths > 99)
    no_code("a corner", mm);
  return two_digits(std::lround(tenths));
}

// Symbols 1 to 4.
Insert1832 take_letters(Designation& reader) {
  Insert1832 insert;
  insert.shape = reader.take(1).front();
  const auto shape = shape_of(insert.shape);
  if (!shape) reader.fail(say("must be one of {}", "CDEHMOPRSTVW"));
  insert.included_angle_deg = shape->included_angle_deg;
  const auto clearance = clearance_of_letter_deg(reader.take(1).front());
  if (!clearance) reader.fail(say("must be one of {}", "ABCDEFGNP"));
  insert.clearance_deg = *clearance;
  insert.tolerance_class = reader.take_one_of("ACEFGHJKLMNU");
  insert.type = reader.take_one_of("ABCFGHJMNQRTUWX");
  return insert;
}

// A digit, and decimals of quarters: 1.2 is 1 1/4.
double take_quarters(Designation& reader) {
  const double whole = reader.take_one_of("0123456789") - '0';
  if (!reader.point_follows()) return whole;
  reader.take(1);
  switch (reader.take_one_of("258")) {
    case '2':
      return whole + 0.25;
    case '5':
      return whole + 0.5;
    default:
      return whole + 0.75;
  }
}

}  // namespace

Insert1832 decode_iso1832(const std::string& designation) {
  Designation reader("decode_iso1832", designation);
  Insert1832 insert = take_letters(reader);
  const auto shape = shape_of(insert.shape);

  const int edge_code = reader.take_two_digits();
  const Designation at_edge = reader;
  insert.thickness_mm = thickness_mm(reader.take(2), reader);

  if (insert.shape == 'R') {
    const auto corner = reader.take(2);
    if (corner != "M0" && corner != "00")
      reader.fail(tr("must be M0 (metric diameter) or 00 (inch diameter)"));
    insert.edge_length_mm =
        corner == "M0" ? edge_code : edge_mm(*shape, edge_code, at_edge);
    if (!(insert.edge_length_mm > 0)) at_edge.fail(tr("must be a diameter above 0 mm"));
    insert.re_mm = insert.edge_length_mm / 2;
  } else {
    insert.edge_length_mm = edge_mm(*shape, edge_code, at_edge);
    insert.re_mm = reader.take_two_digits() / 10.0;
  }
  if (reader.digit_follows()) reader.fail(tr("is followed by one digit too many"));
  return insert;
}

std::string encode_iso1832(const Insert1832& insert) {
  const auto shape = shape_of(insert.shape);
  const auto clearance = clearance_letter(insert.clearance_deg);
  if (!shape || insert.shape == 'R')
    throw std::domain_error("encode_iso1832: the shape must be one of CDEHMOPSTVW");
  if (!clearance)
    throw std::domain_error("encode_iso1832: no letter has this clearance angle");
  return std::string{insert.shape, *clearance, insert.tolerance_class, insert.type, ' '} +
         edge_symbol(*shape, insert.edge_length_mm) +
         thickness_symbol(insert.thickness_mm) + corner_symbol(insert.re_mm);
}

Insert1832 decode_inch_insert(const std::string& designation) {
  constexpr double kInch_mm = 25.4;
  Designation reader("decode_inch_insert", designation);
  Insert1832 insert = take_letters(reader);
  const double circle_mm = take_quarters(reader) * kInch_mm / 8;
  insert.edge_length_mm = edge_length_mm(insert.shape, circle_mm);
  insert.thickness_mm = take_quarters(reader) * kInch_mm / 16;
  insert.re_mm = (reader.take_one_of("0123468") - '0') * kInch_mm / 64;
  if (reader.digit_follows() || reader.point_follows())
    reader.fail(tr("is followed by one digit too many"));
  const double corner_mm = insert.re_mm;
  insert = decode_iso1832(encode_iso1832(insert));
  insert.re_mm = corner_mm;
  return insert;
}

double edge_length_mm(char shape, double circle_mm) {
  const auto known = shape_of(shape);
  return known ? circle_mm * known->edge_per_circle : 0;
}

std::optional<double> included_angle_deg(char shape) {
  const auto known = shape_of(shape);
  return known && shape != 'R' ? std::optional(known->included_angle_deg) : std::nullopt;
}

bool is_corner_of(const Insert1832& insert, double re_mm) {
  constexpr double kInchPerMetric = (25.4 / 64) / 0.4, kPrinted_mm = 5.01e-4;
  return std::abs(re_mm - insert.re_mm) <= 1e-9 ||
         std::abs(re_mm - kInchPerMetric * insert.re_mm) <= kPrinted_mm;
}

}  // namespace turnwright::catalogue
