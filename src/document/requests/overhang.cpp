#include "turnwright/document/overhang.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "frequency_response.hpp"
#include "mode_reader.hpp"
#include "stability_request.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/receptance_coupling.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::chatter;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kOverhangs = 50, kSegments = 50, kSpindleModes = 20;
constexpr std::size_t kMostSpeeds = 10'000;  // over all overhangs
constexpr long kUsualLines = 400;
constexpr double kRigid = std::numeric_limits<double>::infinity();  // pivot: no tilt
const Bounds kPivot = within(-1e5, 1e5, "mm"), kBand = within(1, 1e5, "Hz");

struct TiltingMode {
  Mode mode;
  double pivot_mm = kRigid;
};

/// The spindle along one axis: modes, or a fitted response.
struct Spindle {
  Axis axis = Axis::x;
  std::vector<TiltingMode> modes;
  std::optional<MeasuredAxis> measured;
  double pivot_mm = kRigid;  ///< of the measured response

  EndReceptance at(double w) const {
    if (measured) return tilting(receptance_mm_N(measured->fit, w), pivot_mm);
    EndReceptance sum;
    for (const auto& [m, pivot] : modes) {
      const double r = w / m.wn_rad_s;
      sum = sum + tilting(1 / m.k_N_mm / std::complex(1 - r * r, 2 * m.zeta * r), pivot);
    }
    return sum;
  }
};

struct OverhangRequest {
  std::vector<Spindle> spindle;
  std::vector<BeamSegment> holder, tool;  ///< the first of the tool without its length
  BeamTheory theory = BeamTheory::timoshenko;
  std::vector<double> overhangs_mm;
  double from_Hz = 0, to_Hz = 0;
  long lines = kUsualLines;
  std::optional<int> modes;
  bool tell_response = false;
  bool turning = false;
  ordered_json assumed = ordered_json::array();

  /// Holder and tool with an overhang, from the spindle to the tip.
  std::vector<BeamSegment> with(double overhang_mm) const {
    auto all = holder;
    all.insert(all.end(), tool.begin(), tool.end());
    all[holder.size()].length_mm = overhang_mm - rest_mm();
    return all;
  }
  /// Length of the tool's segments but the first.
  double rest_mm() const {
    double sum = 0;
    for (std::size_t i = 1; i < tool.size(); ++i) sum += tool[i].length_mm;
    return sum;
  }
};

/// Distance to the point about which a mode tilts, which is not 0.
double read_pivot(Reader& r) {
  const auto pivot = r.optional_number("pivot_mm", kPivot);
  if (pivot && std::abs(*pivot) < 1)
    r.problem_at("pivot_mm", tr("at least 1 mm before or behind the face"), "range");
  return pivot.value_or(kRigid);
}

Spindle read_spindle_axis(Reader r, bool turning, OverhangRequest& q) {
  r = r.as_object();
  Spindle out;
  if (!turning) out.axis = r.choice<Axis>("axis", {{"x", Axis::x}, {"y", Axis::y}});
  bool tilts = true;
  for (const Reader& item : r.optional_items("modes", 1, kSpindleModes)) {
    Reader mode = item.as_object();
    const double pivot = read_pivot(mode);
    out.modes.push_back({read_mode(mode, out.axis), pivot});
    tilts = tilts && pivot != kRigid;
  }
  if (auto response = r.find("frf")) {
    out.pivot_mm = read_pivot(r);
    tilts = out.pivot_mm != kRigid;
    out.measured = read_frequency_response(*response, AxisKey::none);
  }
  if (r.has("modes") == r.has("frf"))
    r.problem_at("modes", tr("either modes or frf"),
                 r.has("frf") ? "exclusive" : "missing");
  if (!tilts)
    q.assumed.push_back({{"pointer", r.pointer() + "/pivot_mm"},
                         {"value", "none"},
                         {"why", tr("the face of the spindle does not tilt, so that long "
                                    "tools are too stiff")}});
  r.finish();
  return out;
}

void read_spindle_axes(Reader& r, OverhangRequest& q) {
  for (const Reader& item : r.items("spindle", 1, q.turning ? 1 : 2)) {
    auto axis = read_spindle_axis(item, q.turning, q);
    const bool twice = std::ranges::any_of(
        q.spindle, [&](const Spindle& s) { return s.axis == axis.axis; });
    if (twice) Reader(item).problem_at("axis", tr("an axis once"), "duplicate");
    q.spindle.push_back(std::move(axis));
  }
}

BeamSegment read_segment(Reader r, bool length) {
  r = r.as_object();
  const Bounds size = above_up_to(0, 1e4, "mm");
  BeamSegment s;
  if (length) s.length_mm = r.number("length_mm", size);
  s.diameter_mm = r.number("diameter_mm", size);
  s.bore_mm = r.number_or("bore_mm", within(0, 1e4, "mm"), 0);
  if (s.bore_mm >= s.diameter_mm)
    r.problem_at("bore_mm", tr("a bore less than the diameter"), "range");
  s.E_MPa = r.number("E_MPa", within(1e3, 2e6, "MPa"));
  s.nu = r.number_or("poisson", within(0, 0.49), 0.3);
  s.density_kg_m3 = r.number("density_kg_m3", within(100, 3e4, "kg/m3"));
  s.loss_factor = r.number_or("loss_factor", within(0, 1), 0);
  r.finish();
  return s;
}

void read_beams(Reader& r, OverhangRequest& q) {
  for (const Reader& item : r.optional_items("holder", 1, kSegments))
    q.holder.push_back(read_segment(item, true));
  for (const Reader& item : r.items("tool", 1, kSegments))
    q.tool.push_back(read_segment(item, !q.tool.empty()));
  q.theory = r.choice_or<BeamTheory>("theory",
                                     {{"timoshenko", BeamTheory::timoshenko},
                                      {"euler-bernoulli", BeamTheory::euler_bernoulli}},
                                     BeamTheory::timoshenko);
  const double rest = q.rest_mm();
  for (const Reader& item : r.items("overhangs_mm", 1, kOverhangs)) {
    q.overhangs_mm.push_back(item.as_number(above_up_to(0, 1e4, "mm")));
    if (q.overhangs_mm.back() <= rest)
      item.problem(say("more than the {} of the tool's other segments", mm_text(rest)),
                   "range");
  }
}

void read_lines(Reader& r, OverhangRequest& q) {
  q.from_Hz = r.number("from_Hz", kBand);
  q.to_Hz = r.number("to_Hz", kBand);
  if (q.to_Hz <= q.from_Hz)
    r.problem_at("to_Hz", tr("a frequency above from_Hz"), "range");
  q.lines = r.integer_or("lines", 50, 2000, kUsualLines);
  if (const auto modes = r.optional_integer("modes", 1, kMostModes))
    q.modes = static_cast<int>(*modes);
  q.tell_response = r.boolean_or("response", false);
}

/// The request of `stability` for modes at the tip.
json with_modes(json cut, const std::vector<std::pair<Axis, Mode>>& modes, bool turning) {
  for (const auto& [axis, m] : modes) {
    json mode{{"frequency_Hz", m.wn_rad_s / (2 * units::kPi)},
              {"damping_ratio", m.zeta},
              {"stiffness_N_mm", m.k_N_mm}};
    if (!turning) mode["axis"] = axis == Axis::x ? "x" : "y";
    cut["modes"].push_back(std::move(mode));
  }
  return cut;
}

/// Checks "cut" with a mode in place of those of the tip.
void read_cut(Reader& r, const json& request, const Catalogue& catalogue,
              Problems& problems, OverhangRequest& q) {
  Reader cut = r.object("cut");
  if (!cut.is_object()) return;
  const json& document = request.at("cut");
  const auto model = cut.choice<bool>("model", {{"milling", false}, {"turning", true}});
  q.turning = model;
  for (const char* key :
       {"modes", "frf", "method", "uncertainty", "depths", "speed_variation"})
    if (cut.has(key))
      cut.problem_at(key, tr("no such key in the cut of an overhang"), "exclusive");
  if (problems.list.size() > 0) return;
  read_below(cut, problems, [&] {
    const Mode any{.axis = Axis::x, .wn_rad_s = 1000, .zeta = 0.03, .k_N_mm = 1e4};
    const auto asked = stability_request::read(
        with_modes(document, {{Axis::x, any}}, q.turning), catalogue);
    if (asked.speeds_rpm.size() * std::max<std::size_t>(1, q.overhangs_mm.size()) >
        kMostSpeeds)
      cut.problem_at("speeds_rpm",
                     say("at most {} speeds over all overhangs", kMostSpeeds), "range");
  });
}

OverhangRequest read_overhang_request(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "overhang"};
  OverhangRequest q;
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-overhang/1");
  if (!r.broken()) {
    read_beams(r, q);
    read_lines(r, q);
    read_cut(r, request, catalogue, problems, q);
    read_spindle_axes(r, q);
    r.finish();
  }
  problems.throw_if_any();
  return q;
}

FrequencyResponse at_the_tip(const OverhangRequest& q, const Spindle& spindle,
                             double overhang_mm, double to_Hz) {
  const auto segments = q.with(overhang_mm);
  FrequencyResponse out;
  for (long i = 0; i < q.lines; ++i) {
    const double f = q.from_Hz + (to_Hz - q.from_Hz) * static_cast<double>(i) /
                                     static_cast<double>(q.lines - 1);
    const double w = 2 * units::kPi * f;
    out.w_rad_s.push_back(w);
    out.value.push_back(at_the_end(spindle.at(w), segments, q.theory, w).H_mm_N);
  }
  return out;
}

ordered_json described(const FrequencyResponse& response) {
  ordered_json out{{"frequency_Hz", ordered_json::array()},
                   {"real_mm_N", ordered_json::array()},
                   {"imaginary_mm_N", ordered_json::array()}};
  for (std::size_t i = 0; i < response.value.size(); ++i) {
    out["frequency_Hz"].push_back(response.w_rad_s[i] / (2 * units::kPi));
    out["real_mm_N"].push_back(response.value[i].real());
    out["imaginary_mm_N"].push_back(response.value[i].imag());
  }
  return out;
}

double rest(const ModalFit& fit) { return fit.rms_left / fit.rms_measured; }

/// The modes of a response without noise: the fewest that leave a hundredth of it, else the
/// best fit that leaves a tenth.
std::optional<ModalFit> modes_of(const FrequencyResponse& response,
                                 std::optional<int> asked, const std::stop_token& stop) {
  constexpr double kEnough = 0.01, kSome = 0.1;
  constexpr int kInVain = 3;  // numbers of modes, one after the other, that are no better
  std::optional<ModalFit> best;
  const int last = asked.value_or(kMostModes);
  for (int n = asked.value_or(1), vain = 0; n <= last && vain < kInVain; ++n) {
    leave_if(stop);
    auto found = modal_fit(response, n);
    auto* fit = std::get_if<ModalFit>(&found);
    vain = fit && !(best && rest(*fit) >= rest(*best)) ? 0 : vain + 1;
    if (vain > 0) continue;
    best = std::move(*fit);
    if (rest(*best) <= kEnough) break;
  }
  return best && (asked || rest(*best) <= kSome) ? best : std::nullopt;
}

struct Tip {
  double to_Hz = 0;  ///< end of the band in which modes were fitted
  FrequencyResponse response;
  std::optional<ModalFit> fit;
};

/// A mode slightly above the band can neither be fitted nor left out: then the band goes
/// on by a quarter, up to twice its end.
Tip fitted_tip(const OverhangRequest& q, const Spindle& spindle, double overhang_mm,
               const std::stop_token& stop) {
  constexpr double kFurther = 1.25;
  Tip out;
  for (double to_Hz = q.to_Hz; !out.fit && to_Hz <= 2 * q.to_Hz; to_Hz *= kFurther) {
    out.to_Hz = to_Hz;
    out.response = at_the_tip(q, spindle, overhang_mm, to_Hz);
    out.fit = modes_of(out.response, q.modes, stop);
  }
  return out;
}

/// The peak of the response, and its modes, which are added to `modes`.
ordered_json described_tip(const OverhangRequest& q, const Spindle& spindle,
                           const Tip& tip, std::vector<std::pair<Axis, Mode>>& modes) {
  const FrequencyResponse& response = tip.response;
  const auto peak = std::ranges::max_element(
      response.value, {}, [](const std::complex<double>& h) { return std::abs(h); });
  const auto i = static_cast<std::size_t>(peak - response.value.begin());
  ordered_json out;
  if (!q.turning) out["axis"] = spindle.axis == Axis::x ? "x" : "y";
  out["peak"] = {{"frequency_Hz", response.w_rad_s[i] / (2 * units::kPi)},
                 {"receptance_mm_N", std::abs(*peak)}};
  out["modes"] = ordered_json::array();
  if (tip.fit) {
    for (const FittedMode& m : tip.fit->modes) {
      out["modes"].push_back({{"frequency_Hz", m.wn_rad_s.value / (2 * units::kPi)},
                              {"damping_ratio", m.zeta.value},
                              {"stiffness_N_mm", m.k_N_mm.value}});
      modes.emplace_back(spindle.axis, Mode{.axis = spindle.axis,
                                            .wn_rad_s = m.wn_rad_s.value,
                                            .zeta = m.zeta.value,
                                            .k_N_mm = m.k_N_mm.value});
    }
    out["relative_rest"] = rest(*tip.fit);
    out["to_Hz"] = tip.to_Hz;
  }
  if (q.tell_response) out["response"] = described(response);
  return out;
}

/// What the charts assume of the cut, the same for each overhang.
ordered_json assumed_of_the_cut(const json& chart) {
  ordered_json out = chart.at("assumed");
  for (auto& a : out) a["pointer"] = "/cut" + a["pointer"].get<std::string>();
  return out;
}

/// What the chart of an overhang says.
void add_chart(const json& chart, ordered_json& out) {
  if (chart.contains("speeds")) {
    double least = kRigid;
    for (const auto& s : chart.at("speeds")) {
      out["limits"].push_back({{"n_rpm", s.at("n_rpm")}, {"limit_mm", s.at("limit_mm")}});
      if (!s.at("limit_mm").is_null())
        least = std::min(least, s.at("limit_mm").get<double>());
    }
    out["least_mm"] = least < kRigid ? ordered_json(least) : ordered_json();
  }
  for (const char* key : {"best", "points", "undecided"})
    if (chart.contains(key)) out[key] = chart.at(key);
}

ordered_json with_overhang(const OverhangRequest& q, const json& cut, double overhang_mm,
                           const Catalogue& catalogue, const std::stop_token& stop,
                           ordered_json& assumed) {
  ordered_json out{{"overhang_mm", overhang_mm}, {"tip", ordered_json::array()}};
  std::vector<std::pair<Axis, Mode>> modes;
  for (const Spindle& s : q.spindle)
    out["tip"].push_back(described_tip(q, s, fitted_tip(q, s, overhang_mm, stop), modes));
  if (std::ranges::any_of(out["tip"],
                          [](const auto& tip) { return tip.at("modes").empty(); })) {
    out["why"] =
        tr("no modes of positive stiffness inside the band, or up to twice its end, "
           "explain nine tenths of the response; ask for a band that holds its peaks");
    return out;
  }
  try {
    const json chart = stability(with_modes(cut, modes, q.turning), catalogue, stop);
    add_chart(chart, out);
    if (assumed.empty()) assumed = assumed_of_the_cut(chart);
  } catch (const ModelRangeError& e) {
    out["why"] = e.what();
  }
  return out;
}

}  // namespace

ordered_json overhang(const json& request, const Catalogue& catalogue,
                      const std::stop_token& stop, const StabilityProgress& tell) {
  const OverhangRequest q = read_overhang_request(request, catalogue);
  ordered_json out{{"format", "turnwright-overhang-result/1"}};
  for (const Spindle& s : q.spindle)
    if (s.measured) out["frf"].push_back(described(*s.measured));
  ordered_json of_cut = ordered_json::array();
  for (const double length : q.overhangs_mm) {
    leave_if(stop);
    out["overhangs"].push_back(
        with_overhang(q, request.at("cut"), length, catalogue, stop, of_cut));
    if (tell) tell(out["overhangs"].size(), q.overhangs_mm.size());
  }
  out["assumed"] = q.assumed;
  for (auto& a : of_cut) out["assumed"].push_back(std::move(a));
  out["warnings"] = ordered_json::array();
  for (const Spindle& s : q.spindle)
    if (s.measured)
      for (const std::string& doubt : doubts(*s.measured))
        out["warnings"].push_back(doubt);
  return out;
}

}  // namespace turnwright::document
