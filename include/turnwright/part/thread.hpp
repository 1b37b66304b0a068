#pragma once
#include <optional>
#include <string_view>

#include "turnwright/part/drawing.hpp"

namespace turnwright::part {

/// Limits of a thread as deviations from the basic diameters [mm]: of the pitch diameter and of
/// the crests, the major diameter outside and the minor one inside.  With the fundamental
/// deviation e0, positive into the material, and the widths T2 and Tc they lie
///
///     e0 .. e0 + T2  and  e0 .. e0 + Tc                                              (1)
///
/// into the material.  Of metric classes, in um with P and d in mm,
///
///     e0: e 50 + 11 P,  f 30 + 11 P,  g and G 15 + 11 P,  h and H 0                  (2)
///     T2 = q 90 P^0.4 d^0.1                                                          (3)
///     Tc = q (180 P^(2/3) - 3.15/P^0.5),  inside q (433 P - 190 P^1.22) up to
///          P = 0.8 mm and q 230 P^0.7 above                                          (4)
///
/// with the geometric mean d of the range of nominal diameters and q = 0.5, 0.63, 0.8, 1,
/// 1.25, 1.6, 2 of the grades 3 to 9, for T2 inside q = 0.67, 0.85, 1.06, 1.32, 1.7, 2.12,
/// 2.65.  Of Unified ones, in inches,
///
///     T2 of 2A = 0.0015 D^(1/3) + 0.0015 D^0.5 + 0.015 P^(2/3);  1A 1.5, 3A 0.75,
///          1B 1.95, 2B 1.3, 3B 0.975 times as wide;  e0: 1A and 2A 0.3 T2 of 2A       (5)
///     Tc = 0.06 P^(2/3), of 1A 0.09 P^(2/3); of 1B and 2B from 1/4 in on
///          0.25 P - 0.4 P^2, from P = 1/4 in on 0.15 P; else
///          0.05 P^(2/3) + 0.03 P/D - 0.002, of 1B and 2B at least 0.25 P - 0.4 P^2, of 3B
///          at least 0.23 P - 1.5 P^2 or, from P = 1/12 in on, 0.12 P; at most 0.394 P  (6)
///
/// Source: ISO 965-1, whose tables round the widths to the series R 40, and ASME B1.1, with
/// the diameter as length of engagement, as of UNC and UNF; the other series may have T2 up
/// to 0.1 mm wider.
struct ThreadLimits {
  Limits pitch = {}, crest = {};
};
/// Of a class with the letters of its side: "6g", "5g6g", "2A" outside, "6H", "2B" inside.
/// Nothing of another text.
std::optional<ThreadLimits> thread_limits(std::string_view tolerance_class, double d_mm,
                                          double pitch_mm, Where where);

/// Limits [mm] of the minor diameter D1 of an inner metric thread of class 6H, to which its
/// tap drill belongs:
///
///     D1 = d - 1.08253 P and (4) above it                                            (7)
///
/// Source: ISO 724; ISO 965-1.  DIN 336 gives the drills, about d - P.
struct MinorDiameter {
  double least_mm = 0, most_mm = 0;
};
MinorDiameter minor_diameter_6H(double d_mm, double pitch_mm);

/// Thread of nominal diameter d and pitch P, H = (sqrt 3/2) P, in a blank of the basic
/// profile that is cut to the middle of the crests' limits:
///
///     outside: turned to d, core d3 = d - 2 (17/24) H                                (8)
///     inside:  bored to D1 = d - 2 (5/8) H, opening d                                (9)
///
/// and the core or opening beside that by the middle of the pitch diameter's limits.
///
/// Source: ISO 68-1's basic profile, ISO 724's diameters; d3 with the root radius H/6 of
/// the handbook's tables, with which the pitch diameter is right when the core is.
Shaped thread(double d_mm, double pitch_mm, Where where, const ThreadLimits& limits = {});
/// An inner thread that is tapped into a drilled hole, its blank.
Shaped tapped(double d_mm, double pitch_mm, double drilled_mm, double lead_mm);

}  // namespace turnwright::part
