#pragma once
#include <optional>

#include "turnwright/exchange/outline.hpp"

/// Undercuts of DIN 76 behind outer threads, known by their sizes.
namespace turnwright::exchange {

/// The undercut of DIN 76's form A or B with this radius, depth below the thread's diameter,
/// and width g2 from where its flank leaves that diameter to the shoulder [mm].  The radius is
/// compared to 0.1 mm and the width to 0.1 mm (which the floor's g1 and the flank differ by
/// from g2), twice the depth to 0.05 mm, half of the last digit of d - dg.
/// Nothing if the table has none.
std::optional<part::Undercut> thread_undercut_of(double radius_mm, double depth_mm,
                                                 double width_mm);

/// Keeps the undercuts of DIN 76 that stand behind a thread of their pitch.  The others leave
/// their corner sharp, and `ignored` says so.  For when it is known which elements are threads.
void settle_thread_undercuts(Outline& outline);

}  // namespace turnwright::exchange
