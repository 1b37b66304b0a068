#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::report {

/// The chart of a `stability` result (schemas/stability.result.json) as one
/// self-contained picture (SVG 1.1, 190 mm wide): depth over spindle speed.  Unstable
/// depths of each speed, also of islands, are filled, and are darker where more
/// multipliers are unstable if `depths_mm` were counted.  Every crossing is a stroke,
/// with different strokes for flip and Hopf.  There are lines of the first limit and of
/// the robust limit, if there is one, the requested points, stable and unstable, the best
/// point and the magic speeds.  Speeds outside the machine's range are shaded.  Each
/// speed represents the range half way to its neighbours.
///
/// @param request  the request of the result, with ap_max_mm and machine_rpm.
/// @returns "" for a result without speeds.  Equal results give equal bytes.
std::string stability_chart(const nlohmann::json& request,
                            const nlohmann::ordered_json& result);

}  // namespace turnwright::report
