#pragma once
#include <optional>
#include <string>

#include "turnwright/catalogue/tool.hpp"

/// Designations of inserts, holders and bars made from what a tool library says, and their
/// letters one by one.
namespace turnwright::catalogue {

/// The symbols 1 to 7 of an insert, "CNMG 120408": decode_iso1832() reads them back. Sizes
/// are those of the standard when they lie within what makers round: 0.06 mm of edge and
/// thickness, 0.025 mm of the corner, whose code counts tenths of a millimetre.
/// @throws std::domain_error naming the size that no code has, and for round inserts.
std::string encode_iso1832(const Insert1832& insert);

/// Decodes the inch designation of an insert, e.g. "CNMG 432" or "CCMT 32.51": letters as
/// in ISO 1832, then eighths of an inch of the inscribed circle, sixteenths of the
/// thickness, sixty-fourths of the corner, each a digit or, for the first two, a decimal: .2
/// and .8 stand for a quarter and three.  Edge and thickness are those of ISO 1832, the
/// corner is its inch size.
/// Source: [ansi-inserts].
/// @throws std::domain_error naming what cannot be read.
Insert1832 decode_inch_insert(const std::string& designation);

/// Length [mm] of the cutting edge of an insert about an inscribed circle [mm]; 0 for a
/// letter that is no shape of decode_iso1832().
double edge_length_mm(char shape, double circle_mm);

/// Corner angle [deg] of an insert's shape; none for round inserts and other letters.
std::optional<double> included_angle_deg(char shape);

/// Whether a corner of `re_mm` bears the corner code of this insert: its radius in
/// millimetres, 0.8 mm for 08, or in inches, 1/32 in = 0.794 mm.  Codes of inch inserts
/// count 64ths of an inch by fours: 04, 08, 12 are 1, 2, 3.
/// Source: [sumitomo], table of corner radii.
bool is_corner_of(const Insert1832& insert, double re_mm);

/// Clearance [deg] by its letter in ISO 1832 and ISO 5608, and the letter by the clearance.
std::optional<double> clearance_of_letter_deg(char letter);
std::optional<char> clearance_letter(double clearance_deg);

/// KAPR [deg] by the style letter of ISO 5608, which bars share.
std::optional<double> style_kapr_deg(char style);

/// Symbols 1 to 9 of an external holder, "PCLNL 2525M 12"; a length that has no code is X.
/// @param clamping  C, D, M, P, S or W.
/// @param style     letter of style_kapr_deg().
/// @throws std::domain_error if decode_iso5608() would not read `holder` back.
std::string encode_iso5608(char clamping, char style, const Holder5608& holder);

/// What the designation of a boring bar says.
struct Bar5609 {
  char shank = 'S';                 ///< A, S: steel, with and without coolant; E: carbide
  double diameter_mm = 0;           ///< of the shank
  std::optional<double> length_mm;  ///< not coded by X
  char insert_shape = 'C';
  double kapr_deg = 0;
  double clearance_deg = 0;
  char hand = 'R';
  int edge_code = 0;  ///< as in the insert's designation
};

/// Decodes a designation, e.g. "S25T-SCLCR 09": shank, diameter, length, clamping, insert
/// shape, style (KAPR), clearance, hand, edge length.
/// Source: [makers-bars]; styles as in ISO 5608.
/// @throws std::domain_error naming the symbol that cannot be read.
Bar5609 decode_iso5609(const std::string& designation);

}  // namespace turnwright::catalogue
