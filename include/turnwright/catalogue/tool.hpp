#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"

namespace turnwright::catalogue {

enum class ToolUse { roughing, finishing, facing, boring };

/// Closed interval, lower <= upper.
struct Range {
  double lower = 0, upper = 0;
};

/// One segment of a boring bar's shank, counted from the tool block outwards.
struct BarSegment {
  double length_mm = 0, diameter_mm = 0;
  double bore_mm = 0;  ///< coolant bore, 0: none
};

/// Symmetric positive semi-definite compliance [[c0, c1], [c1, c2]] of the support of a
/// body: deflection and rotation at its root per unit force and couple there.
struct RootCompliance {
  double c0_mm_N = 0, c1_rad_N = 0, c2_rad_Nmm = 0;
};

/// The shank of a boring tool.
struct BoringBar {
  double E_MPa = 0, nu = 0;
  std::vector<BarSegment> segments;
  /// Longest stick-out at which the maker lets it bore; the part then decides how far it
  /// sticks out.  Absent: as far as its segments say.
  std::optional<double> longest_mm;
  double tip_offset_mm = 0;        ///< distance of the corner from the bar's axis
  double min_bore_mm = 0;          ///< smallest hole it enters
  RootCompliance holder;           ///< the same in both planes
  std::optional<double> tip_mm_N;  ///< measured at the tip; replaces shank and holder
  std::optional<double> damping_ratio;  ///< absent: PlanRequest::machine_damping_ratio
};

/// How far a bar sticks out of its block [mm].
double stick_out_mm(const BoringBar& bar);

/// An external holder with a rectangular shank.
struct Holder {
  std::string designation;  ///< ISO 5608, "PCLNL 2525M 12"
  double h_mm = 0;          ///< shank height H
  double b_mm = 0;          ///< shank width B, along the part's axis
  double lf_mm = 0;         ///< functional length LF, from the tip to the shank's end
  double lh_mm = 0;         ///< head length LH, from the tip to the shank
  double wf_mm = 0;         ///< functional width WF, from the tip to the shank's far side
};

/// An edge of a chip breaker's window, straight in logarithms: f <= f1 ap^exponent, or
/// f >= f1 ap^exponent.
struct ChipEdge {
  double f1_mm_rev = 0, exponent = 0;
  bool upper = true;  ///< <=
};

/// A piece of a chip breaker's window that is convex in logarithms: its ranges of depth
/// and feed, and its sloping edges.
struct ChipPiece {
  Range ap_mm, f_mm_rev;
  std::vector<ChipEdge> edges;
};

/// A turning tool: holder and insert in symbols of ISO 13399, and its permitted
/// conditions.
struct Tool {
  std::string id, name;
  std::string insert;  ///< ISO 1832 designation
  std::vector<ToolUse> uses;
  std::vector<IsoGroup> groups;  ///< materials the grade is for
  double kapr_deg = 0;           ///< tool cutting edge angle KAPR
  double minor_kapr_deg =
      0;                 ///< angle of the minor edge kappa', for f <= 2 r sin(kappa')
  double gamma_deg = 0;  ///< rake
  double alpha_deg = 0;  ///< clearance
  double re_mm = 0;      ///< corner radius RE
  bool wiper = false;
  double edge_um = 0;            ///< radius of the rounded edge, 0: not known
  Range f_mm_rev, ap_mm;         ///< chip breaker's window, or the range that contains it
  std::vector<ChipPiece> chip;   ///< convex pieces of a window that is a polygon
  Range vc_m_min;                ///< cutting speeds of the grade over all materials
  double Fc_max_N = 0;           ///< strength of insert and holder
  Range T_min;                   ///< tool life window [min]
  double change_min = 0;         ///< time to change a worn edge [min]
  double edge_cost = 0;          ///< cost of one cutting edge
  std::optional<BoringBar> bar;  ///< for boring tools
  std::optional<Holder> holder;  ///< of an external tool, if its document has it
};

/// Whether the major edge goes behind a shoulder as far as undercuts of form F ask, 8 deg: a
/// KAPR of at least 98 deg.  The forms G and H ask for more, part::leans_rad.
bool goes_behind_shoulders(const Tool& tool);

/// Least depth of cut [mm] of a tool: of its chip breaker's window, and two thirds of the
/// corner radius, below which the corner pushes more than it cuts.
double least_depth_mm(const Tool& tool);

/// Geometry of an indexable insert as its ISO 1832 designation gives it.
struct Insert1832 {
  char shape = 'C';
  double included_angle_deg = 0;  ///< corner angle
  double clearance_deg = 0;
  char tolerance_class = 'M';
  char type = 'G';
  double edge_length_mm = 0, thickness_mm = 0, re_mm = 0;
};

/// Decodes the metric designation, e.g. "CNMG 120408" or "DCMT11T304-PF": shape,
/// clearance, tolerance class, type, edge length, thickness, corner radius.
/// Source: ISO 1832:2017, symbols 1 to 7.
/// @throws std::domain_error naming the symbol that cannot be read.
Insert1832 decode_iso1832(const std::string& designation);

/// What the ISO 5608 designation of an external holder says of its geometry.
struct Holder5608 {
  char insert_shape = 'C';
  double kapr_deg = 0;
  double clearance_deg = 0;
  char hand = 'L';  ///< R, L or N
  double h_mm = 0, b_mm = 0;
  std::optional<double> lf_mm;  ///< not coded by "-" and "X"
  int edge_code = 0;            ///< as in the insert's designation
};

/// Decodes a designation, e.g. "PCLNL 2525M 12": clamping, insert shape, style (KAPR),
/// clearance, hand, shank height and width, length, edge length.
/// Source: ISO 5608:2012, reference positions 1 to 9.
/// @throws std::domain_error naming the symbol that cannot be read.
Holder5608 decode_iso5608(const std::string& designation);

}  // namespace turnwright::catalogue
