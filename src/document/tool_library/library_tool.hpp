#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/json/utf8.hpp"

/// What tool libraries say, whatever their format, in mm and degrees.
namespace turnwright::document {

/// The most turning tools that one library may hold, and the most entries of all kinds.
inline constexpr std::size_t kMostTools = 10'000, kMostEntries = 100'000;

/// Cutting conditions that a library stores with a tool.
struct LibraryPreset {
  double vc_m_min = 0, f_mm_rev = 0;  ///< 0: not said
};

/// A turning tool of a library, or one that makes holes to its size, in symbols of ISO 13399; what is not said is absent.
struct LibraryTool {
  std::string at;    ///< its place in the library: "/data/4", "line 7"
  std::string name;  ///< for people
  std::string id;    ///< the library's own, of an order or an asset
  bool boring = false;
  std::vector<std::string> texts;  ///< in which designations may stand
  std::string insert, holder;      ///< designations that have a place of their own

  std::optional<char> SC;  ///< shape of the insert
  std::optional<char> TC,
      type;                     ///< tolerance class and type, letters 3 and 4 of ISO 1832
  std::optional<double> IC_mm;  ///< inscribed circle
  std::optional<double> L_mm;   ///< length of the cutting edge
  std::optional<double> size_mm;   ///< one of the two, without saying which
  std::optional<double> S_mm;      ///< thickness
  std::optional<double> RE_mm;     ///< corner radius
  std::optional<double> AN_deg;    ///< clearance
  std::optional<double> EPSR_deg;  ///< corner angle

  std::optional<char> clamping, style, hand;  ///< letters 1, 3 and 5 of ISO 5608
  std::optional<double> KAPR_deg;             ///< tool cutting edge angle
  std::optional<double> PSIR_deg;             ///< lead angle, 90 deg - KAPR
  std::optional<double> GAMO_deg;             ///< rake
  std::optional<double> H_mm, B_mm;           ///< height and width of the shank
  std::optional<double> LF_mm;                ///< from the tip to the shank's end
  std::optional<double> LH_mm;                ///< from the tip to the shank
  std::optional<double> WF_mm;    ///< from the tip to the shank's far side, a bar's axis
  std::optional<double> DCON_mm;  ///< diameter of a bar's shank
  std::optional<double> DMIN_mm;  ///< smallest bore
  std::optional<double> OHX_mm;   ///< overhang
  std::optional<double> APMX_mm;  ///< largest depth of cut

  /// Of tools that make holes to their size: "tapping", "reaming", "countersinking"; "" of
  /// turning tools.
  std::string use = {};
  std::string thread = {};        ///< of a tap, as the library writes it
  std::optional<double> DC_mm;    ///< cutting diameter
  std::optional<double> TP_mm;    ///< pitch of a tap's thread
  std::optional<double> SIG_deg;  ///< point angle
  std::optional<double> NOF;      ///< number of flutes
  std::optional<double> LU_mm;    ///< usable length

  std::string groups;  ///< ISO 513 letters of the materials it is for, "PMK"
  std::vector<LibraryPreset> presets;
};

/// A sentence on something at a place.
struct PlacedRemark {
  std::string at, text;
};

struct ToolLibrary {
  std::vector<LibraryTool> tools;
  std::vector<PlacedRemark> ignored;
};

/// A number of ISO 13399 by its symbol.
struct Symbol {
  std::string_view code;
  std::optional<double> LibraryTool::*member;
  bool length;  ///< a length, otherwise an angle or a number
};
/// Those that tables and assets may hold; other spellings of one number are rows too.
const std::vector<Symbol>& symbols();

/// The number that begins a text, with a decimal point or comma, and what follows it
/// without blanks: "6,35 mm" is 6.35 and "mm".  None if it does not begin with a finite
/// number.
struct Quantity {
  double value;
  std::string_view unit;
};
std::optional<Quantity> quantity(std::string_view text);

/// mm per unit of length by its name ("mm", "inches", ..); none for other names.
std::optional<double> unit_mm(std::string_view name);

}  // namespace turnwright::document
