#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace turnwright::report {

/// The chart of a `stability` result (schemas/stability.result.json) as one picture (SVG
/// 1.1, readable alone, 190 mm wide): depth over spindle speed, unstable depths of each
/// speed filled - the darker the more multipliers are unstable, where `depths_mm` were
/// counted -, islands included; every crossing as a stroke, flip and Hopf told apart; the
/// line of the first limit, and that of the robust limit if there is one; the points
/// asked about, stable and unstable; the best point and the magic speeds; what the
/// machine does not reach shaded.  A speed stands for the speeds half way to its
/// neighbours.
///
/// @param request  of the same result: ap_max_mm and machine_rpm.
/// @returns "" of a result without speeds.  Equal results give equal bytes.
std::string stability_chart(const nlohmann::json& request,
                            const nlohmann::ordered_json& result);

}  // namespace turnwright::report
