#include "requests.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/exchange/outline.hpp"
#include "report/page/html.hpp"
#include "report/page/stability_html.hpp"
#include "report/picture/budget_drawing.hpp"
#include "report/picture/drawing.hpp"
#include "report/picture/milled_drawing.hpp"
#include "report/picture/path_drawing.hpp"
#include "report/picture/run_drawing.hpp"
#include "report/picture/stabilisation_drawing.hpp"
#include "report/picture/stability_chart.hpp"
#include "report/picture/volumetric_drawing.hpp"
#include "report/picture/window_drawing.hpp"
#include "report/text/text.hpp"
#include "turnwright/document/acceptance.hpp"
#include "turnwright/document/ball_bar.hpp"
#include "turnwright/document/calibrate_material.hpp"
#include "turnwright/document/chuck.hpp"
#include "turnwright/document/compare.hpp"
#include "turnwright/document/compensate.hpp"
#include "turnwright/document/deflection.hpp"
#include "turnwright/document/drawing.hpp"
#include "turnwright/document/geometry.hpp"
#include "turnwright/document/import.hpp"
#include "turnwright/document/import_tools.hpp"
#include "turnwright/document/learn.hpp"
#include "turnwright/document/listen.hpp"
#include "turnwright/document/multipass.hpp"
#include "turnwright/document/nc.hpp"
#include "turnwright/document/overhang.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/document/positioning.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/document/quote.hpp"
#include "turnwright/document/review.hpp"
#include "turnwright/document/samba.hpp"
#include "turnwright/document/stability.hpp"
#include "turnwright/document/thermal.hpp"
#include "turnwright/planning/choice.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/prepare.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::service {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kPlanExample = R"({
  "format": "turnwright-part/1", "name": "Pin", "material": "C45",
  "stock": {"kind": "bar", "diameter_mm": 35, "length_mm": 84, "left_allowance_mm": 2},
  "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 32},
            {"id": "d2", "kind": "cylinder", "length_mm": 50, "diameter_mm": 25,
             "fit": "h8", "Ra_um": 1.6}],
  "machine": "lathe-small", "tools": ["PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"],
  "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
             {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}]})";

constexpr const char* kDeflectionExample = R"({
  "shaft": {"E_MPa": 210000, "nu": 0.3, "segments": [
    {"length_mm": 80, "outer_left_mm": 60, "outer_right_mm": 60, "inner_left_mm": 0,
     "inner_right_mm": 0},
    {"length_mm": 80, "outer_left_mm": 40, "outer_right_mm": 40, "inner_left_mm": 0,
     "inner_right_mm": 0}]},
  "clamping": {"method": "chuck-tailstock"},
  "positions_mm": [40, 120], "load": {"Fr_N": 250, "Ft_N": 600, "Fa_N": 180}})";

constexpr const char* kAcceptanceExample = R"({"cases": [
  {"id": "seat", "tolerance": "diameter", "e_mm": [0.004, 0.011], "upper_mm": 0.016,
   "lower_mm": 0},
  {"id": "taper", "tolerance": "profile", "e_mm": [-0.002, 0.007], "value_mm": 0.02,
   "half_angle_deg": 10}]})";

constexpr const char* kChuckExample = R"({"tests": [
  {"setup": "A", "z_mm": 20, "D_mm": 60, "Fr_N": 150, "Ft_N": 330, "Fa_N": 90,
   "radius_error_mm": 0.0031},
  {"setup": "A", "z_mm": 20, "D_mm": 60, "Fr_N": 700, "Ft_N": 1540, "Fa_N": 420,
   "radius_error_mm": 0.0141},
  {"setup": "A", "z_mm": 90, "D_mm": 60, "Fr_N": 150, "Ft_N": 330, "Fa_N": 90,
   "radius_error_mm": 0.0057},
  {"setup": "A", "z_mm": 90, "D_mm": 60, "Fr_N": 700, "Ft_N": 1540, "Fa_N": 420,
   "radius_error_mm": 0.0270},
  {"setup": "A", "z_mm": 150, "D_mm": 60, "Fr_N": 150, "Ft_N": 330, "Fa_N": 90,
   "radius_error_mm": 0.0098},
  {"setup": "A", "z_mm": 150, "D_mm": 60, "Fr_N": 700, "Ft_N": 1540, "Fa_N": 420,
   "radius_error_mm": 0.0446}],
  "tool_rr_mm_N": 0, "predict": [
    {"z_mm": 120, "D_mm": 60, "Fr_N": 250, "Ft_N": 550, "Fa_N": 150}]})";

constexpr const char* kThermalExample = R"({
  "log": {"csv": ["time_s,rpm,ambient_degC,error_um",
    "0,0,22.00,0.32", "300,0,22.10,0.12", "600,0,22.19,0.02",
    "900,3000,22.27,-0.07", "1200,3000,22.34,1.95", "1500,3000,22.38,3.71",
    "1800,3000,22.40,5.08", "2100,3000,22.39,6.33", "2400,3000,22.36,7.38",
    "2700,3000,22.31,8.20", "3000,3000,22.24,9.00", "3300,3000,22.15,9.62",
    "3600,3000,22.06,10.24", "3900,3000,21.96,10.77", "4200,0,21.86,11.16",
    "4500,0,21.77,9.40", "4800,0,21.70,7.87", "5100,0,21.64,6.71",
    "5400,0,21.61,5.71", "5700,0,21.60,4.81", "6000,0,21.62,4.10",
    "6300,0,21.66,3.41", "6600,0,21.72,2.88", "6900,0,21.80,2.39",
    "7200,0,21.89,1.89", "7500,0,21.99,1.52"]},
  "model": {"lags": 1, "start": "soaked"},
  "shift": {"start": "cold", "time_s": [0, 7200], "rpm": [3000, 3000],
            "ambient_degC": [22, 22],
            "batch": {"first_s": 300, "cycle_s": 240, "parts": 25, "offset_every": 5}}})";

constexpr const char* kGeometryExample = R"({
  "chain": "wCfZXt", "tool_point_mm": [0, 0, 0], "axes": [
    {"name": "C", "loc": {"EX0C": 0.008}, "err": {"EXC": {"f": [[0, 0], [0.001, 0]]}}},
    {"name": "Z", "sq": {"EB0Z": 2e-5}, "err": {"EXZ": {"c": [0, 0, 0.005, 0]}}},
    {"name": "X", "err": {"EXX": {"c": [0, 0.003, 0, 0], "b": -0.0012}}}],
  "points": [{"q": {"X": 30, "Z": 20}, "sign": {"X": -1, "Z": -1}},
             {"q": {"X": 30, "Z": 120, "C": 0.5}, "sign": {"Z": -1}}]})";

constexpr const char* kBallBarExample = R"({"analyse": {
  "plane": "XY", "R_mm": 100,
  "ccw_mm": [0.0012, 0.0021, 0.0013, -0.0012, -0.002, -0.0011, 0.0009, 0.0014, 0.0006,
             -0.0016, -0.0027, -0.0017],
  "cw_mm": [0.0001, 0.0008, 0.001, -0.0009, -0.0008, 0.0001, 0.0021, 0.0027, 0.001,
            -0.0012, -0.0014, -0.0004]}})";

constexpr const char* kPositioningExample = R"({
  "axis": "X", "readings": {"unit": "um",
    "q_mm":  [0, 57, 121, 178, 243, 300, 0, 57, 121, 178, 243, 300, 0, 57, 121, 178, 243, 300,
              0, 57, 121, 178, 243, 300, 0, 57, 121, 178, 243, 300],
    "plus":  [0.0, 2.3, 4.6, 6.1, 8.4, 10.2, 0.3, 2.6, 4.4, 6.5, 8.9, 10.6,
              -0.2, 2.1, 4.9, 6.3, 8.2, 10.1, 0.4, 2.8, 4.7, 6.8, 8.6, 10.9,
              0.1, 2.4, 4.2, 6.2, 8.8, 10.4],
    "minus": [3.9, 6.1, 8.2, 10.3, 12.1, 13.8, 4.2, 6.6, 8.5, 10.0, 12.6, 14.1,
              3.7, 6.0, 8.9, 10.4, 12.3, 14.4, 4.1, 6.4, 8.1, 10.8, 12.0, 13.9,
              4.4, 6.2, 8.6, 10.1, 12.4, 14.2]},
  "write_comp_file": {"type": 0, "unit": "mm"}})";

constexpr const char* kSambaExample = R"({
  "strategy": {
    "indexations_deg": [[0, 0], [60, 40], [-50, 150], [30, -110]],
    "balls_seen": [[1, 2, 3], [1, 2, 3], [1, 2, 3], [1, 2, 3]],
    "balls_mm": [[-150, 0, 40], [150, 0, 40], [20, 160, 180]], "scale_bar_mm": 300.002},
  "parameters": ["EC0Y", "EA0Y", "EB0Z", "EXX1", "EYY1", "EZZ1", "EAY1"]})";

constexpr const char* kCompareExample = R"({
  "a": {"name": "ball bar", "parameters": [
    {"name": "EXX", "group": "scale", "unit": "um", "runs": [-7.76, -7.26, -6.05, 2.48]},
    {"name": "EYY", "group": "scale", "unit": "um", "runs": [-1.67, -0.39, 1.83, 10.24]}]},
  "b": {"name": "balls", "parameters": [
    {"name": "EXX", "group": "scale", "unit": "um", "runs": [-4, -5.23, -4.74, -4.74]},
    {"name": "EYY", "group": "scale", "unit": "um", "runs": [1.85, -0.14, -0.75, -0.85]}]}})";

constexpr const char* kCompensateExample = R"({
  "chain": "wCfZXt", "axes": [
    {"name": "C"}, {"name": "Z", "sq": {"EB0Z": 2e-5}},
    {"name": "X", "err": {"EXX": {"c": [0, 0.003, 0, 0], "b": -0.001}}}],
  "diameter": true, "start_mm": [50, 0, 50], "decimals": 4,
  "program": ["G0 X42 Z2", "G1 X40 F0.2", "Z-30", "G2 X50 Z-35 R5", "G0 X60", "M30"]})";
constexpr const char* kStabilityExample = R"({
  "model": "milling", "teeth": 2, "Kt_MPa": 600, "Kn_MPa": 200, "radial_immersion": 0.1,
  "direction": "down", "modes": [
    {"axis": "x", "frequency_Hz": 922, "damping_ratio": 0.011, "mass_kg": 0.03993}],
  "ap_max_mm": 6, "speeds_rpm": {"from": 17000, "to": 19000, "count": 3},
  "points": [{"n_rpm": 5000, "ap_mm": 1}]})";

// Four teeth at 6000/min, and 730 Hz: 0.22 s of 16 bits at 4 kHz.
constexpr const char* kListenExample =
    R"({"n_rpm": 6000, "teeth": 4, "wav": ")"
    "UklGRgQHAABXQVZFZm10IBAAAAABAAEAoA8AAEAfAAACABAAZGF0YeAGAACNFUQ9rDV6E3r+"
    "rgQ2Cx35r9hEzsDxNSnoRZsuS/3I4Trn6fae7zvbq9sMANQwdD1cGHzhXcd2147zf/zV8ZH0"
    "ixO6Nyc2EAhY0i3CNOIiDJ8cNBAmCyEdHDEmJBr1DMbUxUfx4iHLLoMZUwSQCBUUCAbz2x+8"
    "ysnnAIUwuzFWDsHv2O7t+Nzz/dfZyA3jZRtGQ582kwd14XrhkPYf+8XukuhBA9ozM0qaLJ/0"
    "Js8m2PD4QwubApj7Ag9ILtg24A2m1C64vc/w/ekXuw7d/6QHJRuvGbTxesKltl/fbBbeLm0f"
    "aAUWAjcPfQwU68jKec5AAeY4GUU8JRn+MfLc/X0A/OwN2DDlwBaRQnU/jg/E3w/UWef69sDv"
    "+eM18+AcDDv1KUHycMNKxKzmIwSsBbz7hgYdJc407xmZ4TG+fs9BAhAlPyOiEXsPOR6sJLAF"
    "l9YBwdXeSBgEOMkrNgwO+nkDfAUw7czKvsQL7U4lxj1CIdv0yt6O6Ybzxupw1iLcFQgAORtD"
    "pxnI5ZHSseWH/jYCdPWt/eQfvEHqOmMICdTkxxPokg31FGkH7AZsG98uLhtW5U67eL8B77Aa"
    "syHKDGH+MQjNEVkABNSGuJXO4wc/M6szXBA6+Gb7vAWo+sLdiNC0724nNkrJOcEIwebk6YL7"
    "7/uD6WTlxgNTNNVEzCJG6rLIkdTL8qL+s/V/8hwLKy3KMBYFMc1AuH7UdwIAF3UNQQKXEpon"
    "5CC19dTH4sIr7mUi1zRlIikLKwtaF+wOv+lIyQrQrwSdNrk9vRsm95zuffm79nLe6ctd3pYT"
    "3Dy8NC0Ft9lV1CXpI/aH6u3hNPlRJpNDlyzv81rLKNLg82gMfAlSATUQjjCzO0AawOF0wUnU"
    "/gRSIMsbkgojDCwdtR1c+lnI3rdh2CESzS0FIO4B8PfaAVYDYOeXxWXF+vKKLVlAJiIt+r/o"
    "avUi/o7vCNy75fMT8ENxRyscFujy1//ryAAs/HPvXfoPIG4/YzGu+n7IjsLY4+wEqwhY/OL/"
    "/hhwKg0Vjt4xt1PBCvMfHMUfpgygBOYT3R09BV3YoL9b2+sVjDt8NeEUaf+8BI8K8Pkl2RnP"
    "0PFrKXZFey2R/Sji8uaG9FXwQdqw27b/djAgPmQYpOHtxivX0/NJ+1fxvPTvE+s37jdkCD3S"
    "CMJO4twNsRstEO0KhRvCME0kHfPNxv3FAPJiIlgt4ximBWYKHBXgBcTbZrsJyuwAKzAFMlEQ"
    "qPBe7un5+PME2E7IbuMDGyNCIjeZBmPiyOFK9zv9rO1D6ekDTDKhSkcu7vNjz9XY8PkxC1ID"
    "VPwrDfouLDbYDNzUebnez/L9GBZGDjoA0Qc6G/QZ2vGfwre3o94JFl8vqR6gBTsCdw6tCjHr"
    "zcrtzgACnDeOReck7P1J8Lb9VwG46/HWSuWXFqBBOj9ADgngVNOB5yX4du5K4irzpxwjOnEo"
    "6fBAw6jDouhvBCwG0vpBBoAj+jN/GZvhqL3RznAAMyVYI0kRnA7UHRckjQUO1m/AiN51FTU4"
    "/CtsCkr6QQGgBUbuLstTxP3t+SV5PKgiK/Th3tjonPW56gfWc9yLCNQ4AEOQGpzmM9Kx5Af/"
    "HQO29Vb7IyESQlc6dQfv0W7IZ+jKDD4VOQgSB4wbCC9NG8zm0LoGv+ztAhtHIroLb/80CK8T"
    "6f//01C5iM4CB+gzeDLwEJj2BfqhBbb6RdzWzkfwZigFShA6WgkI6NbqEvzg+kjp++S0BP8z"
    "gkSaIvTohcgZ1MPxGv7m9JzxBQvXK9svtQWly0y3XtMwAuYVPgyTA1sRvCftIU/2UsefwiTu"
    "DCOkMxYiRQvYC5cX9w7Z6fbH/9CxA981DT27GQb2Ku6y+F32Md6+yu3fsBPoOyk01QNJ2aTU"
    "3ekl9UnrieLs+fwl4ELsKz/zkMtp0J30kg5RClsC9hBRLzI8axo44WDATtM+BVsi7xvUCaIL"
    "ThyRHhf6YMhKtyra+BEMLgkglgFp948B1wNt6OXFTcRP8+ks6T9IJFP5Jurm9fH8o++624nl"
    "ThT2RCFHiht+52DX7+ugAEb8QfCG+scfQD9RMef71cn5wrzjMgQjCJD8GP+BGl8qiRRj30G4"
    "zsGu8yYeEiGmC8MFXRVfHEcG+NZXwWPaPhXsPNkzDRNj/7AD2gtt+WvZ283R8DMqr0aMLm/+"
    "weG05p/01O8Z2wHadwCGMMc9vRev4E/HsNe486L7AfI59PMTSTbGNhAJhtL1wgrjoQsRG5UR"
    "rwn+G9ExuCQf9JfFcsa58fwh1CwXGScFvAkfFaoFFttHu3rKXwEKL9oxKQ+p8MntPPpr9JnY"
    "38ia48IbHkOpNYMHZ+EO4ff1Jfyr7g=="
    R"("})";

constexpr const char* kOverhangExample = R"({
  "spindle": [{"axis": "x", "modes": [
    {"frequency_Hz": 600, "damping_ratio": 0.04, "stiffness_N_mm": 40000, "pivot_mm": 150},
    {"frequency_Hz": 1500, "damping_ratio": 0.03, "stiffness_N_mm": 60000,
     "pivot_mm": -90}]}],
  "holder": [{"length_mm": 60, "diameter_mm": 40, "E_MPa": 205000, "density_kg_m3": 7850,
              "loss_factor": 0.01}],
  "tool": [{"diameter_mm": 12, "E_MPa": 580000, "density_kg_m3": 14300},
           {"length_mm": 26, "diameter_mm": 9.6, "E_MPa": 580000, "density_kg_m3": 14300}],
  "overhangs_mm": [45, 60], "from_Hz": 200, "to_Hz": 4000,
  "cut": {"model": "milling", "teeth": 2, "Kt_MPa": 600, "Kn_MPa": 200,
          "radial_immersion": 0.1, "direction": "down", "ap_max_mm": 8,
          "speeds_rpm": {"from": 8000, "to": 16000, "count": 5}}})";

constexpr const char* kMultipassExample = R"({
  "dt_mm": 8, "cost": "literal", "PU": 4, "T": [25, 45], "n_max": 6})";

constexpr const char* kImportExample = R"({
  "name": "Pin", "material": "C45", "machine": "lathe-small", "general": "ISO 2768-mK",
  "stock": {"kind": "bar", "diameter_mm": 52, "length_mm": 76, "left_allowance_mm": 2},
  "text": "d50 h7 x 40 Ra1.6; 1x45; d30 k6 x 32 Ra0.8"})";

constexpr const char* kImportToolsExample = R"({
  "groups": ["P", "K"],
  "text": "insert;holder;RE;KAPR\nCNMG 120408;DCLNL 2525M 12;0,8;95\nDNMG 150604;;0,4;93"})";

constexpr const char* kCalibrateExample = R"({
  "material": "C45", "id": "C45-lot-17", "name": "C45, lot 17",
  "tool": {"name": "CNMG 120408, VB = 0.3 mm", "re_mm": 0.8, "kapr_deg": 95, "rake_deg": 6},
  "cuts": [
    {"vc_m_min": 200, "f_mm_rev": 0.15, "ap_mm": 2, "Fc_N": 768, "T_min": 76},
    {"vc_m_min": 200, "f_mm_rev": 0.3, "ap_mm": 2, "Fc_N": 1271, "T_min": 33},
    {"vc_m_min": 260, "f_mm_rev": 0.15, "ap_mm": 2, "Fc_N": 752, "T_min": 29},
    {"vc_m_min": 260, "f_mm_rev": 0.3, "ap_mm": 2, "Fc_N": 1263, "T_min": 11.5},
    {"vc_m_min": 320, "f_mm_rev": 0.2, "ap_mm": 2, "Fc_N": 941, "T_min": 8.6}]})";

constexpr const char* kLearnExample = R"({
  "characteristics": [
    {"id": "seat", "nominal_mm": 30, "upper_mm": 30.015, "lower_mm": 30.002}],
  "csv": ["part,time_s,edge,seat",
    "1,240,1,30.0072", "2,480,1,30.0069", "3,720,1,30.0081", "4,960,1,30.0088",
    "5,1200,1,30.0085", "6,2340,1,30.0094", "7,2580,1,30.0101", "8,2820,1,1.1815",
    "9,3060,2,30.0090", "10,3300,2,30.0083", "11,3540,2,30.0098", "12,3780,2,30.0101",
    "13,4020,2,30.0099", "14,4260,2,30.0110"]})";

struct Planned {
  document::PreparedDocument part;
  planning::ProcessPlan plan;
};

// Moved out of the documents, of which a request may leave hundreds open.
std::vector<planning::Candidate> to_plan(document::Candidates& all) {
  std::vector<planning::Candidate> candidates;
  for (auto& [name, document, without, unless_within] : all.usable)
    candidates.push_back({name, std::move(document.part), std::move(document.what_if),
                          std::move(without), unless_within});
  return candidates;
}

// The best of what the request leaves open.
Planned planned(document::Candidates&& all,
                const planning::Judge& judge = nc::refuse_unprogrammed) {
  auto candidates = to_plan(all);
  auto choice = planning::choose(candidates, judge);
  auto& chosen = all.usable[choice.chosen].document;
  chosen.part = std::move(candidates[choice.chosen].part);
  for (const auto& [name, why] : all.refused)
    choice.plan.alternatives.push_back(
        {.name = name,
         .why = why,
         .sentence = say("{}: cannot be planned: {}", name, why)});
  return {std::move(chosen), std::move(choice.plan)};
}

ordered_json plan(const json& request, const Context& context) {
  const auto [part, plan] =
      planned(document::prepared_candidates(request, context.catalogue, "plan"));
  return document::plan_result(plan, part);
}

ordered_json predict(const json& request, const Context& context) {
  const auto part = document::prepared_part(request, context.catalogue, "predict",
                                            document::Purpose::predict);
  return document::plan_result(planning::predict(part.part), part);
}

ordered_json quote(const json& request, const Context& context) {
  auto quoted = document::load_quote(request, context.catalogue);
  std::vector<planning::Candidate> all;
  for (auto& part : quoted.parts)
    std::ranges::move(to_plan(part), std::back_inserter(all));
  auto made = planning::judged_plans(all, nc::refuse_unprogrammed);
  auto done = all.begin();
  for (auto& part : quoted.parts)
    for (auto& way : part.usable) way.document.part = std::move((done++)->part);
  std::vector<std::vector<planning::ProcessPlan>> plans;
  auto next = std::make_move_iterator(made.begin());
  for (const auto& part : quoted.parts) {
    const auto end = next + std::ssize(part.usable);
    plans.emplace_back(next, end);
    next = end;
  }
  return document::quote_result(quoted, plans);
}

std::string quote_example() {
  return "{\"parts\": [" + std::string(kPlanExample) +
         R"(], "batches": [1, 10, 100, 1000], "currency": "EUR",
  "stock": {"price_per_bar": 24, "bar_length_mm": 3000, "kerf_mm": 3, "remnant_mm": 100},
  "charges": {"setter_per_min": 0.8, "overhead_pct": 15, "margin_pct": 10},
  "energy": {"idle_kW": 1.2, "kg_CO2_per_kWh": 0.38}})";
}

std::string nc_example() { return "{\"part\": " + std::string(kPlanExample) + "}"; }

ordered_json nc_programs(const json& request, const Context& context) {
  auto [candidates, settings] = document::load_nc_request(request, context.catalogue);
  // The only plan is an answer even if it cannot be programmed: `cannot` says why.
  planning::Judge judge = nc::refuse_unprogrammed;
  if (candidates.usable.size() == 1) judge = [](const auto&, auto&) {};
  const auto [part, plan] = planned(std::move(candidates), judge);
  auto programs = nc::programs(part.part, plan);
  nc::fit_to_control(programs.setups, settings, part.part.machine);
  return document::to_json(programs, plan, settings);
}

std::string nc_text(const ordered_json& result) {
  std::string all;
  for (const auto& program : result["programs"])
    all += program["text"].get<std::string>();
  for (const auto& why : result["cannot"]) all += why.get<std::string>() + '\n';
  return all;
}

// A review uses the clampings of the plan it is compared with.
planning::PreparedPart clamped_as(const planning::PreparedPart& part,
                                  const planning::ProcessPlan& plan) {
  planning::PlanRequest request = part;
  for (std::size_t s = 0; s < plan.setups.size(); ++s)
    request.setups[s].clampings = {plan.setups[s].clamping};
  return planning::prepare(std::move(request), part);
}

// The operations of the programs, predicted as if a request had given them.
document::ReviewedPlan predicted(const planning::PreparedPart& part,
                                 const document::ReviewInput& input,
                                 review::Reconstruction all, planning::ProcessPlan plan) {
  document::ReviewedPlan out{std::move(plan)};
  if (all.cannot.empty()) {
    auto result = planning::predict(
        review::with_operations(part, std::move(all.operations), input.tools));
    if (!result.tolerances.empty()) {
      out.predicted = std::move(result);
      return out;
    }
    for (const auto& conflict : result.conflicts) all.cannot.push_back(conflict.sentence);
  }
  out.cannot = std::move(all.cannot);
  return out;
}

// The programs with the speeds and feeds of least cost for their own passes, reviewed anew.
document::CorrectedPrograms corrected(const planning::PreparedPart& part,
                                      document::ReviewRequest asked,
                                      const document::ReviewInput& input,
                                      const review::Review& reviewed,
                                      const review::Reconstruction& own,
                                      const document::Catalogue& catalogue) {
  document::CorrectedPrograms out;
  out.cannot = own.cannot;
  if (!out.cannot.empty()) return out;
  const auto best = review::best_of_passes(part, own.operations, input.tools);
  for (const auto& conflict : best.conflicts) out.cannot.push_back(conflict.sentence);
  if (best.status != planning::PlanStatus::ok) return out;
  for (std::size_t i = 0; i < input.programs.size(); ++i) {
    const auto& program = input.programs[i];
    const auto factors = review::word_factors(reviewed.setups[i], program.program,
                                              best.setups[program.setup]);
    auto& text = asked.programs[i].text;
    out.texts.push_back(review::corrected_text(text, asked.control, factors));
    text = out.texts.back().text;
  }
  const auto again = document::review_input(asked, part, catalogue);
  out.review = review::review(part, again.programs, again.tools);
  out.plan = predicted(part, again, review::reconstructed(part, out.review), {});
  return out;
}

ordered_json review_programs(const json& request, const Context& context) {
  auto asked = document::load_review_request(request, context.catalogue);
  auto [part, plan] = planned(std::move(asked.part));
  const auto input = document::review_input(asked, part.part, context.catalogue);
  const bool made = plan.status == planning::PlanStatus::ok;
  const auto held = made ? clamped_as(part.part, plan) : part.part;
  const auto reviewed = review::review(held, input.programs, input.tools);
  auto own = review::reconstructed(held, reviewed);
  std::optional<document::CorrectedPrograms> other;
  if (asked.correct)
    other = corrected(held, asked, input, reviewed, own, context.catalogue);
  return document::review_result(asked, part, input, reviewed,
                                 predicted(held, input, std::move(own), std::move(plan)),
                                 other);
}

std::string review_example() {
  return "{\"part\": " + std::string(kPlanExample) + R"(, "control": "fanuc",
  "tools": [{"number": 1, "id": "PCLNL-CNMG120408-PM"}],
  "programs": [{"setup": 0, "text": "G21 G40 G99\nT0101\nG50 S2500\nG96 S200 M3\nG0 X38. Z0.\nG1 X-1.6 F0.2\nG0 X30. Z2.\nG1 Z-49.8 F0.3\nX36.\nG0 Z2.\nX25.\nG1 Z-49.8\nX36.\nG0 X100. Z50.\nM30"}]})";
}

ordered_json drawing(const json& request, const Context& context) {
  auto result =
      document::drawing(document::prepared_part(request, context.catalogue, "drawing"));
  result["notation"] = document::part_notation(request);
  return result;
}

// The names and work offset under which the machine finds the programs.
report::ShopPrograms shop_programs(const nc::Programs& programs,
                                   const nc::Settings& settings) {
  report::ShopPrograms shop{{}, nc::work_offset(settings)};
  for (const auto& program : programs.setups)
    shop.files.push_back(document::file_name(program, settings.control));
  return shop;
}

Drawn drawn(const document::PreparedDocument& part, const planning::ProcessPlan& plan,
            const nc::Settings& settings) {
  Drawn all{document::plan_result(plan, part), {}, nc::programs(part.part, plan)};
  nc::fit_to_control(all.programs.setups, settings, part.part.machine);
  nc::number_tools(all.programs.setups, settings);
  all.sheets = report::setup_sheets(part.part, plan, all.programs,
                                    shop_programs(all.programs, settings));
  for (auto& svg : report::setup_drawings(part.part, plan))
    all.drawings.push_back(
        {"setup-" + std::to_string(all.drawings.size() + 1) + ".svg", std::move(svg)});
  auto paths = report::path_drawings(part.part, plan, all.programs);
  for (std::size_t i = 0; i < paths.size(); ++i)
    all.drawings.push_back(
        {"path-" + std::to_string(all.programs.setups[i].setup + 1) + ".svg",
         std::move(paths[i])});
  if (auto svg = report::budget_drawing(part.part, plan); !svg.empty())
    all.drawings.push_back({"budget.svg", std::move(svg)});
  for (const auto& setup : plan.setups)
    for (const auto& o : setup.operations) {
      if (o.window)
        all.drawings.push_back({"window-" + o.id + ".svg", report::window_drawing(o)});
      if (o.milled)
        all.drawings.push_back({"stability-" + o.id + ".svg", report::milled_drawing(o)});
    }
  return all;
}

std::string plan_report(std::string_view name, const Drawn& drawn) {
  return report::html(name, drawn.result, drawn.drawings, drawn.sheets);
}

Drawn drawn_plan(const json& request, const Context& context) {
  const auto [part, plan] =
      planned(document::prepared_candidates(request, context.catalogue, "plan", true));
  return drawn(part, plan, context.settings);
}

Drawn drawn_predict(const json& request, const Context& context) {
  const auto part = document::prepared_part(request, context.catalogue, "predict",
                                            document::Purpose::predict);
  return drawn(part, planning::predict(part.part), context.settings);
}

Drawn drawn_stability(const json& request, const Context& context) {
  Drawn all{document::stability(request, context.catalogue, context.stop, context.tell),
            {}};
  if (auto svg = report::stability_chart(request, all.result); !svg.empty())
    all.drawings.push_back({"stability.svg", std::move(svg)});
  if (all.result.contains("frf"))
    for (const auto& response : all.result.at("frf"))
      all.drawings.push_back(
          {"stabilisation-" + response.at("axis").get<std::string>() + ".svg",
           report::stabilisation_drawing(response)});
  return all;
}

std::string stability_report(std::string_view name, const Drawn& drawn) {
  return report::stability_html(name, drawn.result, drawn.drawings);
}

Drawn drawn_geometry(const json& request, const Context&) {
  return {document::geometry(request),
          {{"errors.svg", report::error_map(document::geometry_machine(request))}}};
}

Drawn drawn_ball_bar(const json& request, const Context&) {
  return {document::ball_bar(request),
          {{"ballbar.svg", report::ball_bar_drawing(document::ball_bar_trace(request))}}};
}

Drawn drawn_positioning(const json& request, const Context&) {
  const auto [result, axis, values] = document::positioned(request);
  return {result, {{"positioning.svg", report::positioning_drawing(axis, values)}}};
}

Drawn drawn_compensate(const json& request, const Context&) {
  const auto [result, compensated] = document::compensated(request);
  return {result, {{"residual.svg", report::compensation_drawing(compensated)}}};
}

Drawn drawn_learn(const json& request, const Context& context) {
  Drawn all{document::learn(request, context.catalogue), {}};
  all.drawings = report::run_drawings(all.result);
  return all;
}

constexpr const char* kPredictExample = R"({
  "format": "turnwright-part/1", "name": "Pin", "material": "C45",
  "stock": {"kind": "bar", "diameter_mm": 35, "length_mm": 84, "left_allowance_mm": 2},
  "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 32},
            {"id": "d2", "kind": "cylinder", "length_mm": 50, "diameter_mm": 30,
             "fit": "h9", "Ra_um": 3.2}],
  "machine": "lathe-small",
  "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
             {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}],
  "operations": [
    {"id": "f1", "setup": 0, "kind": "face", "on": ["right"], "tool": "PCLNL-CNMG120408-PM",
     "conditions": {"passes": 1, "ap_mm": 2, "f_mm_rev": 0.2, "vc_m_min": 200}},
    {"id": "r2", "setup": 0, "kind": "rough", "on": ["d2"], "tool": "PCLNL-CNMG120408-PM",
     "conditions": {"passes": 1, "ap_mm": 2, "f_mm_rev": 0.3, "vc_m_min": 180}},
    {"id": "e2", "setup": 0, "kind": "finish", "on": ["d2"], "tool": "PDJNL-DNMG150604-PF",
     "conditions": {"passes": 1, "ap_mm": 0.5, "f_mm_rev": 0.15, "vc_m_min": 220}},
    {"id": "f2", "setup": 1, "kind": "face", "on": ["left"], "tool": "PCLNL-CNMG120408-PM",
     "conditions": {"passes": 1, "ap_mm": 2, "f_mm_rev": 0.2, "vc_m_min": 200}},
    {"id": "e1", "setup": 1, "kind": "finish", "on": ["d1"], "tool": "PDJNL-DNMG150604-PF",
     "conditions": {"passes": 1, "ap_mm": 1.5, "f_mm_rev": 0.2, "vc_m_min": 200}}]})";

}  // namespace

std::span<const Request> requests() {
  static const std::vector<Request> kTable{
      {"plan", to_translate("part plan -> certified cheapest process plan"), kPlanExample,
       plan, report::text, drawn_plan, plan_report},
      {"predict",
       to_translate("part plan with conditions given -> deviations and verdicts"),
       kPredictExample, predict, report::text, drawn_predict, plan_report},
      {"nc", to_translate("part plan -> turning program per setup (ISO 6983)"),
       nc_example(), nc_programs, nc_text},
      {"quote",
       to_translate("part plans, batches, stock and charges -> unit prices with a bound"),
       quote_example(), quote, report::quote_text},
      {"review",
       to_translate(
           "part plan, NC programs and tools -> forces, limits and times of each pass"),
       review_example(), review_programs, report::review_text},
      {"import", to_translate("STEP, DXF or a line of text -> part document for plan"),
       kImportExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::import(request, context.catalogue);
       }},
      {"import-tools",
       to_translate(
           "tool library of Fusion, MTConnect, FreeCAD or CSV -> documents of tools"),
       kImportToolsExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::import_tools(request);
       }},
      {"drawing",
       to_translate("part plan -> the part as it is read: surfaces, tolerances, setups"),
       kPlanExample, drawing},
      {"deflection",
       to_translate("shaft, clamping, load -> flexibilities, deflections, slopes"),
       kDeflectionExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::deflection(request);
       }},
      {"acceptance",
       to_translate("deviations over features and their tolerances -> verdicts"),
       kAcceptanceExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::acceptance(request);
       }},
      {"chuck", to_translate("test cuts -> chuck compliance with uncertainties"),
       kChuckExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::chuck(request);
       },
       report::chuck_text},
      {"thermal", to_translate("drift log -> model, prediction, residuals"),
       kThermalExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::thermal(request);
       },
       report::thermal_text},
      {"geometry",
       to_translate("kinematic chain with errors, positions -> tip and direction errors"),
       kGeometryExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::geometry(request);
       },
       nullptr, drawn_geometry},
      {"ballbar",
       to_translate(
           "error model -> circular traces; traces -> ISO 230-4 and decomposition"),
       kBallBarExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::ball_bar(request);
       },
       nullptr, drawn_ball_bar},
      {"positioning",
       to_translate("readings of a laser -> ISO 230-2; compensation file of LinuxCNC"),
       kPositioningExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::positioning(request);
       },
       report::positioning_text, drawn_positioning},
      {"samba",
       to_translate("probing strategy -> identifiability; readings -> parameters"),
       kSambaExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::samba(request);
       }},
      {"compare",
       to_translate("two calibrations with repeated runs -> agreement per parameter"),
       kCompareExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::compare(request);
       }},
      {"compensate",
       to_translate("NC program and error model -> corrected program and residual"),
       kCompensateExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::compensate(request);
       },
       nullptr, drawn_compensate},
      {"stability",
       to_translate("milling or turning dynamics -> limits per speed, verdict per point"),
       kStabilityExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::stability(request, context.catalogue, context.stop,
                                    context.tell);
       },
       report::stability_text, drawn_stability, stability_report},
      {"overhang",
       to_translate("spindle receptance, holder, tool, overhangs -> modes at the tip, "
                    "limits of a cut"),
       kOverhangExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::overhang(request, context.catalogue, context.stop,
                                   context.tell);
       },
       report::overhang_text},
      {"listen",
       to_translate("sound of a cut (.wav) -> chatter frequency, speeds without it"),
       kListenExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::listen(request, context.catalogue, context.stop);
       },
       report::listen_text},
      {"multipass",
       to_translate("the literature's multi-pass problem -> certified optimum"),
       kMultipassExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::multipass(request);
       },
       report::multipass_text},
      {"calibrate-material",
       to_translate("measured cuts -> kc1.1, mc, Taylor constants with intervals"),
       kCalibrateExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::calibrate_material(request, context.catalogue);
       },
       report::material_text},
      {"learn",
       to_translate(
           "measured parts -> capability, drift, wear, advice for the next part"),
       kLearnExample,
       [](const json& request, const Context& context) -> ordered_json {
         return document::learn(request, context.catalogue);
       },
       report::learn_text, drawn_learn},
  };
  return kTable;
}

}  // namespace turnwright::service
