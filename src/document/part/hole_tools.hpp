#pragma once
#include <optional>
#include <string>
#include <vector>

#include "part_sections.hpp"

/// How the tools of a draft make holes: drills, flat drills, reamers, taps, countersinks.
namespace turnwright::document {

inline constexpr double kRounding_mm = 1e-9;  ///< of diameters and depths

/// A hole as tools on the axis make it.
struct MadeHole {
  part::Shaped shape;
  std::string how;   ///< for people
  const char* word;  ///< "drilled", "reamed", "tapped", "counterbored"
};

/// What is asked of a hole, and of the tools that make it.
struct HoleDemand {
  double D_mm = 0, pitch_mm = 0;            ///< of a thread its nominal diameter
  double length_mm = 0, drilled_to_mm = 0;  ///< at least, from the face
  std::optional<part::Limits> limits = {};
  std::optional<double> Ra_um = {};
  /// Of the drill that makes what lies behind it, if that is a hole too: it is to make this.
  std::optional<double> drill_mm = {};

  bool takes_drill(double size_mm) const { return !drill_mm || *drill_mm == size_mm; }
};

/// Of which it is known what they leave of a hole.
std::vector<const catalogue::FixedTool*> known_tools(const Draft& draft,
                                                     catalogue::FixedUse use);
bool has_size(const catalogue::FixedTool& tool, double diameter_mm);
bool keeps_size(const catalogue::FixedTool& tool, double diameter_mm,
                const part::Limits& limits);
/// What a tool is known to leave: "IT10 and Ra 3.2 um".
std::string promise(const catalogue::FixedTool& tool);

/// The limits that a hole of the document is given, if they can be read.
std::optional<part::Limits> given_limits(Reader& hole, double diameter_mm);

/// The hole as a drill, a reamer behind its drill, or a tap makes it; none if none does.
std::optional<MadeHole> drilled_hole(const Draft& draft, const HoleDemand& demand);
std::optional<MadeHole> reamed_hole(const Draft& draft, const HoleDemand& demand);
std::optional<MadeHole> tapped_hole(const Draft& draft, const HoleDemand& demand);
/// Inner element i as a flat drill opens the hole behind it.
std::optional<MadeHole> counterbored_hole(const Draft& draft, std::size_t inner,
                                          const HoleDemand& demand);
/// Why the tools that would keep what is asked of a hole do not make it here; empty without
/// such tools.
std::string why_not(const Draft& draft, const HoleDemand& demand);

/// The countersink of the material for a chamfer up to a diameter, of an angle if that is
/// given, which passes the bores before it; none.
const catalogue::FixedTool* countersink_for(const Draft& draft, double way_in_mm,
                                            double diameter_mm,
                                            const part::Chamfer* chamfer);
/// Whether countersinks cut the chamfers of a bore: where it begins, and where it leaves the
/// part.
bool can_be_countersunk(const Draft& draft, std::size_t inner);

}  // namespace turnwright::document
