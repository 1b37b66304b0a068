#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/base/language.hpp"
#include "turnwright/catalogue/tool_codes.hpp"

/// What libraries do not say of a tool, estimated from its insert as the catalogue's own
/// tools have it: feeds, depths, strength, angles.  Makers know better.
namespace turnwright::document {

/// Source of a group of numbers that is estimated here, in English.
inline constexpr const char* kNotInLibrary = to_translate(
    "not in the library: estimate from the insert's size, as in the shipped catalogue");
/// Their relative uncertainty [%], one standard deviation.
inline constexpr double kEstimate_pct = 50;

/// A group of a document with its uncertainty and source, an English text.
nlohmann::ordered_json estimated(nlohmann::ordered_json group,
                                 const char* source = kNotInLibrary,
                                 double uncertainty_pct = kEstimate_pct);

/// Without what units leave behind the sixth decimal.
double rounded(double x);

/// Feed from 0.15 to 0.6 corner radii, as shipped tools of 0.4, 0.8 and 1.2 mm have it.
catalogue::Range usual_feed_mm_rev(double re_mm);

/// Depth from 0.6 corner radii, at least 0.1 mm, to a quarter of the edge; of corners below
/// 60 deg to an eighth.
catalogue::Range usual_depth_mm(const catalogue::Insert1832& insert, double re_mm);

/// Largest cutting force [N]: of the largest feed and depth at 2500 MPa.
double usual_strength_N(double f_mm_rev, double ap_mm);

/// Rake [deg] of insert and holder: flat inserts (types A, W, N, Q) have the holder's, -6 deg
/// without clearance, else 0 deg; chip grooves add 12 deg without, 6 deg with clearance.
double usual_rake_deg(const catalogue::Insert1832& insert);

/// Clearance [deg] of the edge in its holder: 6 deg of inserts without any, whose holder
/// leans, else the insert's.
double usual_clearance_deg(const catalogue::Insert1832& insert);

/// KAPR [deg] of the usual holder of a shape: 95 for C and W, 93 for D and V, else 90 for
/// triangles and 75 for all others.
double usual_kapr_deg(char shape);

/// Thickness [mm] of the usual insert about a circle, with or without clearance.
double usual_thickness_mm(double circle_mm, double clearance_deg);

/// What a tool may do: rough with corners from 55 deg and 0.4 mm, finish with radii up to
/// 1.2 mm, face with KAPR from 90 deg and corners from 55 deg.
std::vector<std::string> usual_uses(const catalogue::Insert1832& insert, double kapr_deg,
                                    double re_mm);

}  // namespace turnwright::document
