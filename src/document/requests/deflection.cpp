#include "turnwright/document/deflection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/finite.hpp"
#include "document/part/milled_shaft.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/deflection/boring_bar.hpp"
#include "turnwright/deflection/copying.hpp"
#include "turnwright/deflection/envelope.hpp"
#include "turnwright/deflection/face.hpp"
#include "turnwright/deflection/feedback.hpp"
#include "turnwright/deflection/response.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::deflection;
using nlohmann::json;

constexpr std::size_t kPositions = 100000;
const Bounds kOuter = above_up_to(0, 1e5, "mm"), kInner = within(0, 1e5, "mm"),
             kForce = within(-1e9, 1e9, "N"), kCompliance = within(0, 1, "mm/N");

struct Face {
  double z_mm = 0;
  Facing facing;
};

struct Steady {
  SteadyRest radial, tangential;
};

/// Successive passes, and the run-out of the blank.
struct Passes {
  std::vector<double> ap_mm;
  double runout_mm = 0;
};

struct DeflectionRequest {
  part::Shaft shaft;
  Clamping clamping;
  std::optional<Steady> steady;
  std::optional<BoringBar> bar;
  std::vector<double> positions_mm;
  std::optional<Load> load;
  std::optional<ForceLaw> force_law;
  std::optional<Passes> passes;
  std::optional<MilledShaft> milled;
  std::optional<Face> face;
  Workpiece::Options options;
};

Root read_root(Reader& chuck, std::string_view plane) {
  auto r = chuck.optional_object(plane);
  if (!r) return {};
  const Root root{
      .c0_mm_N = r->number_or("c0_mm_N", kCompliance, 0),
      .c1_rad_N = r->number_or("c1_rad_N", within(-1, 1, "rad/N"), 0),
      .c2_rad_Nmm = r->number_or("c2_rad_Nmm", within(0, 1, "rad/(N mm)"), 0)};
  r->finish();
  const bool read = !std::isnan(root.c0_mm_N + root.c1_rad_N + root.c2_rad_Nmm);
  if (read && !elastic(root))
    r->problem(tr("c0_mm_N times c2_rad_Nmm at least c1_rad_N squared"), "conflict");
  return root;
}

void read_centre(Reader& clamping, std::string_view key, double Supports::*compliance,
                 Clamping& c) {
  auto r = clamping.optional_object(key);
  if (!r) return;
  c.radial.*compliance = r->number_or("radial_mm_N", kCompliance, 0);
  c.tangential.*compliance = r->number_or("tangential_mm_N", kCompliance, 0);
  r->finish();
}

/// Checks that a steady rest stands between the ends of the shaft.
std::optional<Steady> read_steady(Reader& clamping, const Bounds& on_shaft) {
  auto r = clamping.optional_object("steady");
  if (!r) return std::nullopt;
  const double z = r->number("at_mm", on_shaft);
  const Steady steady{{z, r->number_or("radial_mm_N", kCompliance, 0)},
                      {z, r->number_or("tangential_mm_N", kCompliance, 0)}};
  r->finish();
  return steady;
}

double widest_mm(const part::Shaft& shaft) {
  double d = 0;
  for (const part::Segment& s : shaft.segments)
    d = std::max({d, s.outer_left_mm, s.outer_right_mm});
  return d;
}

/// The bar's tip points to the wall, so its widest section needs D/2 + f of the bore.
BoringBar read_bar(Reader& clamping, double widest_mm) {
  const BoringBar bar{.tip_offset_mm = clamping.number("tip_offset_mm", kInner),
                      .bore_diameter_mm = clamping.number("bore_diameter_mm", kOuter)};
  const double room = bar.bore_diameter_mm - widest_mm / 2;
  if (bar.bore_diameter_mm < widest_mm)
    clamping.problem_at(
        "bore_diameter_mm",
        say("{}, the bar's largest diameter", expected_number(at_least(widest_mm, "mm"))),
        "conflict");
  else if (bar.tip_offset_mm > room)
    clamping.problem_at("tip_offset_mm", expected_number(within(0, room, "mm")),
                        "conflict");
  return bar;
}

void read_clamping(Reader r, DeflectionRequest& q, const Bounds& inside) {
  enum class Hold { chuck, between_centres, chuck_tailstock, boring_bar };
  const auto hold = r.choice<Hold>("method", {{"chuck", Hold::chuck},
                                              {"between-centres", Hold::between_centres},
                                              {"chuck-tailstock", Hold::chuck_tailstock},
                                              {"boring-bar", Hold::boring_bar}});
  const Method method = hold == Hold::between_centres   ? Method::between_centres
                        : hold == Hold::chuck_tailstock ? Method::chuck_tailstock
                                                        : Method::chuck;
  q.clamping.radial.method = q.clamping.tangential.method = method;
  if (auto chuck = r.optional_object("chuck")) {
    q.clamping.radial.root = read_root(*chuck, "radial");
    q.clamping.tangential.root = read_root(*chuck, "tangential");
    chuck->finish();
  }
  if (hold == Hold::boring_bar) {
    q.bar = read_bar(r, widest_mm(q.shaft));
  } else {
    read_centre(r, "tail_centre", &Supports::tail_mm_N, q.clamping);
    read_centre(r, "head_centre", &Supports::head_mm_N, q.clamping);
    q.steady = read_steady(r, inside);
  }
  r.finish();
}

std::optional<Load> read_load(Reader& request) {
  auto r = request.optional_object("load");
  if (!r) return std::nullopt;
  const Load load{.Fr_N = r->number("Fr_N", kForce),
                  .Ft_N = r->number("Ft_N", kForce),
                  .Fa_N = r->number("Fa_N", kForce)};
  r->finish();
  return load;
}

std::optional<Passes> read_passes(Reader& law) {
  if (!law.has("passes_ap_mm")) {
    if (law.has("blank_runout_mm"))
      law.problem_at("blank_runout_mm", tr("nothing without passes_ap_mm"), "conflict");
    return std::nullopt;
  }
  Passes p;
  p.ap_mm = law.numbers("passes_ap_mm", within(0, 1e4, "mm"), 1, 100);
  const double first = p.ap_mm.empty() ? 0 : p.ap_mm.front();
  if (!p.ap_mm.empty() && !(first > 0))
    law.problem_at("passes_ap_mm", tr("a first pass that cuts: above 0 mm"), "range");
  // The tool must not leave the part in the first pass.
  p.runout_mm = law.number_or("blank_runout_mm",
                              at_least_below(0, first > 0 ? first : 1e4, "mm"), 0);
  return p;
}

std::optional<ForceLaw> read_force_law(Reader& request, std::optional<Passes>& passes) {
  auto r = request.optional_object("force_law");
  if (!r) return std::nullopt;
  const Bounds ratio = within(-1000, 1000);
  const ForceLaw law{.c_N = r->number("c_N", above_up_to(0, 1e9, "N")),
                     .x = r->number("x", above_up_to(0, 5)),
                     .Fa_over_Fr = r->number("Fa_over_Fr", ratio),
                     .Ft_over_Fr = r->number("Ft_over_Fr", ratio),
                     .ap_mm = r->number("ap_mm", above_up_to(0, 1e4, "mm"))};
  passes = read_passes(*r);
  r->finish();
  return law;
}

/// A number that exceeds its bounds only by the rounding of a sum becomes the bound.
double read_rounded(const Reader& r, const Bounds& bounds) {
  constexpr double kRounding = 1e-12;
  const double x = r.is_number() ? r.json().get<double>() : 0;
  if (x > bounds.upper && x <= bounds.upper * (1 + kRounding)) return bounds.upper;
  if (x < bounds.lower && x >= bounds.lower * (1 - kRounding)) return bounds.lower;
  return r.as_number(bounds);
}

double read_rounded(Reader& parent, std::string_view key, const Bounds& bounds) {
  return read_rounded(parent.at(key, expected_number(bounds)), bounds);
}

/// The radii that a face at z may have: at a step those of both sides.
Bounds face_radii(const part::Shaft& shaft, double z_mm) {
  double outer = 0, bore = std::numeric_limits<double>::infinity();
  const std::vector<double> ends = part::ends_mm(shaft.segments);
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    if (!(ends[i] <= z_mm && z_mm <= ends[i + 1])) continue;
    const part::Segment& s = shaft.segments[i];
    const double u = (z_mm - ends[i]) / (ends[i + 1] - ends[i]);
    outer = std::max(outer, std::lerp(s.outer_left_mm, s.outer_right_mm, u) / 2);
    bore = std::min(bore, std::lerp(s.inner_left_mm, s.inner_right_mm, u) / 2);
  }
  return outer > 0 ? at_least_below(bore, outer, "mm") : kInner;
}

std::optional<Face> read_face(Reader& request, const part::Shaft& shaft,
                              const Bounds& on_shaft) {
  auto r = request.optional_object("face");
  if (!r) return std::nullopt;
  const double z = read_rounded(*r, "z_mm", on_shaft);
  const Bounds radii = face_radii(shaft, z);
  const Face face{.z_mm = z,
                  .facing = {.rho_min_mm = read_rounded(*r, "rho_min_mm", radii),
                             .rho_max_mm = read_rounded(
                                 *r, "rho_max_mm", above_up_to(0, radii.upper, "mm")),
                             .Ff_N = r->number("Ff_N", kForce),
                             .Fp_N = r->number("Fp_N", kForce)}};
  r->finish();
  if (face.facing.rho_min_mm >= face.facing.rho_max_mm)
    r->problem_at(
        "rho_min_mm",
        expected_number(at_least_below(radii.lower, face.facing.rho_max_mm, "mm")),
        "conflict");
  return face;
}

std::optional<Cut> read_in_process(Reader& request) {
  auto r = request.optional_object("in_process");
  if (!r) return std::nullopt;
  const Cut cut{.ap_mm = r->number("ap_mm", within(0, 1e4, "mm")),
                .towards = r->choice<part::FeedTowards>(
                    "feed_towards", {{"chuck", part::FeedTowards::chuck},
                                     {"tail", part::FeedTowards::tail}})};
  r->finish();
  return cut;
}

DeflectionRequest read_deflection_request(const json& document) {
  Problems problems{.document = "deflection"};
  Reader r = Reader(document, problems).as_object();
  DeflectionRequest q;
  read_format(r, "turnwright-deflection/1");
  auto read = read_milled_shaft(r.object("shaft"));
  q.shaft = std::move(read.shaft);
  q.milled = std::move(read.milled);
  // Without a readable shaft the other members cannot be checked.
  const bool measured = problems.list.empty();
  if (!measured) q.shaft.segments.clear();
  const double length = part::length_mm(q.shaft.segments);
  const Bounds on_shaft = measured ? within(0, length, "mm") : at_least(0, "mm");
  Bounds inside = measured ? at_least_below(0, length, "mm") : at_least(0, "mm");
  inside.lower_open = true;
  read_clamping(r.object("clamping"), q, inside);

  // A bar has its tip and a face its place; everything else needs positions.
  if (r.has("positions_mm") || !(q.bar || r.has("face")))
    for (const Reader& place : r.items("positions_mm", 0, kPositions))
      q.positions_mm.push_back(read_rounded(place, on_shaft));

  if (q.bar) {
    for (const char* key : {"force_law", "face", "in_process", "shoulder_correction"})
      if (r.has(key))
        r.problem_at(key, tr("nothing: a boring bar is not turned"), "conflict");
  } else {
    q.force_law = read_force_law(r, q.passes);
    q.face = read_face(r, q.shaft, on_shaft);
    q.options = {.in_process = read_in_process(r),
                 .shoulder_correction = r.boolean_or("shoulder_correction", false)};
  }
  if (q.milled && (q.bar || q.steady))
    r.problem_at("shaft",
                 q.bar ? tr("a bar without slots") : tr("no slots with a steady rest"),
                 "conflict");
  q.load = read_load(r);
  if (q.load && r.has("force_law"))
    r.problem_at("force_law", tr("either load or force_law"), "conflict");
  if (!r.has("load") && !r.has("force_law") && (q.bar || !r.has("face")))
    r.problem_at("load", q.bar ? tr("a load") : tr("load or force_law"), "missing");
  r.finish();
  problems.throw_if_any();
  return q;
}

json flexibility(const Flexibility& f) {
  return {{"f_ww_mm_N", f.f_ww_mm_N},
          {"f_wp_rad_N", f.f_wp_rad_N},
          {"f_pp_rad_Nmm", f.f_pp_rad_Nmm}};
}

/// The part in its clamping: flexibilities of both planes at any positions.
struct Planes {
  std::vector<Flexibility> radial, tangential;
  std::vector<RestedFlexibility> rested;  ///< radial, with a steady rest
};

class Held {
 public:
  Held(const Workpiece& part, const DeflectionRequest& q)
      : part_(&part), clamping_(&q.clamping) {
    if (!q.steady) return;
    rested_.push_back(part.rested(q.clamping.radial, q.steady->radial));
    rested_.push_back(part.rested(q.clamping.tangential, q.steady->tangential));
  }

  Planes at(std::span<const double> a_mm) const {
    Planes f;
    if (!rested_.empty()) {
      for (const double a : a_mm) {
        f.rested.push_back(rested_[0].at(a));
        f.radial.push_back(f.rested.back().part);
        f.tangential.push_back(rested_[1].at(a).part);
      }
      return f;
    }
    f.radial.resize(a_mm.size());
    f.tangential.resize(a_mm.size());
    part_->at(a_mm, clamping_->radial, f.radial);
    part_->at(a_mm, clamping_->tangential, f.tangential);
    return f;
  }

 private:
  const Workpiece* part_;
  const Clamping* clamping_;
  std::vector<RestedBeam> rested_;  // radial and tangential, or none
};

json position(const Response& at) {
  return {{"a_mm", at.a_mm},
          {"radial", flexibility(at.radial)},
          {"tangential", flexibility(at.tangential)},
          {"delta_r_mm", at.delta_r_mm},
          {"delta_t_mm", at.delta_t_mm},
          {"theta_r_rad", at.theta_r_rad},
          {"radius_error_mm", at.radius_error_mm},
          {"tail_reaction_N", at.tail_reaction_N}};
}

json position(double a_mm, double D_mm, const Flexibility& radial,
              const Flexibility& tangential, const ForceLaw& law) {
  const Equilibrium e = equilibrium(D_mm, radial, tangential, law);
  json out = position(response(a_mm, D_mm, radial, tangential,
                               {.Fr_N = e.Fr_N,
                                .Ft_N = law.Ft_over_Fr * e.Fr_N,
                                .Fa_N = law.Fa_over_Fr * e.Fr_N}));
  out["Fr_N"] = e.Fr_N;
  out["radius_error_mm"] = e.radius_error_mm;
  out["radius_error_without_feedback_mm"] = e.radius_error_without_feedback_mm;
  out["loop_gain"] = e.loop_gain;
  return out;
}

/// At a position that has been answered.
Load load_at(const DeflectionRequest& q, const json& answered) {
  if (!q.force_law) return q.load.value_or(Load{});
  const double Fr = answered.at("Fr_N");
  return {.Fr_N = Fr,
          .Ft_N = q.force_law->Ft_over_Fr * Fr,
          .Fa_N = q.force_law->Fa_over_Fr * Fr};
}

/// The error after each pass, and the remaining run-out of the blank.
void add_passes(double D_mm, const Flexibility& radial, const Flexibility& tangential,
                const DeflectionRequest& q, json& out) {
  out["errors_of_passes_mm"] =
      radius_errors_of_passes(D_mm, radial, tangential, *q.force_law, q.passes->ap_mm);
  out["copied_runout_mm"] = copied_runout_of_passes(
      D_mm, radial, tangential, *q.force_law, q.passes->runout_mm, q.passes->ap_mm);
}

/// Two lobes of a part with slots, as it turns under the load.
json oval(const DeflectionRequest& q, double a_mm, const Load& load) {
  const OvalFlexibility f =
      oval_flexibility(*q.milled, q.shaft.E_MPa, q.clamping.radial, a_mm);
  return {{"mean_mm_N", f.mean_mm_N},
          {"lobe_mm_N", f.lobe_mm_N},
          {"softest_deg", f.softest_rad * 180 / units::kPi},
          {"amplitude_mm", oval_error(f, load.Fr_N, load.Ft_N).amplitude_mm}};
}

json positions(const Workpiece& part, const Held& held, const DeflectionRequest& q) {
  json list = json::array();
  const Planes f = held.at(q.positions_mm);
  for (std::size_t i = 0; i < q.positions_mm.size(); ++i) {
    leave_if_asked();
    const double a = q.positions_mm[i], D = part.diameter_mm(part.segment_at(a), a);
    list.push_back(q.force_law
                       ? position(a, D, f.radial[i], f.tangential[i], *q.force_law)
                       : position(response(a, D, f.radial[i], f.tangential[i],
                                           q.load.value_or(Load{}))));
    if (q.passes) add_passes(D, f.radial[i], f.tangential[i], q, list.back());
    const Load load = load_at(q, list.back());
    if (q.milled) list.back()["oval"] = oval(q, a, load);
    if (q.steady)
      list.back()["rest_reaction_N"] = f.rested[i].rest_per_N * load.Fr_N -
                                       f.rested[i].rest_per_Nmm * load.Fa_N * D / 2;
  }
  return list;
}

json largest_error(const Workpiece& part, const Held& held, const DeflectionRequest& q) {
  const Envelope e = envelope(part.ends_mm(), [&](std::size_t segment,
                                                  std::span<const double> a_mm,
                                                  std::span<double> e_mm) {
    leave_if_asked();
    const Planes f = held.at(a_mm);
    for (std::size_t i = 0; i < a_mm.size(); ++i) {
      const double D = part.diameter_mm(segment, a_mm[i]);
      e_mm[i] =
          q.force_law
              ? equilibrium(D, f.radial[i], f.tangential[i], *q.force_law).radius_error_mm
              : response(a_mm[i], D, f.radial[i], f.tangential[i],
                         q.load.value_or(Load{}))
                    .radius_error_mm;
    }
  });
  return {{"max_mm", e.max_mm}, {"at_mm", e.at_mm}};
}

json face(const Held& held, const DeflectionRequest& q) {
  const Planes f = held.at({&q.face->z_mm, 1});
  const FaceForm form = face_form(f.radial[0], q.face->facing);
  return {{"peak_to_valley_mm", form.peak_to_valley_mm},
          {"profile", {{"rho_mm", form.rho_mm}, {"g_mm", form.g_mm}}}};
}

json warnings(const DeflectionRequest& q) {
  json list = json::array();
  for (const std::size_t i : thin_walls(q.shaft.segments))
    list.push_back(
        say("/shaft/segments/{}: the wall is thinner than 0.2 of the radius; rings "
            "ovalise and the beam model is void",
            i));
  if (q.bar && q.bar->tip_offset_mm < widest_mm(q.shaft) / 2)
    list.push_back(
        tr("/clamping/tip_offset_mm: the bar's radius is larger; where it is widest it "
           "touches the bore before its tip does"));
  return list;
}

}  // namespace

json deflection(const json& request) {
  const DeflectionRequest q = read_deflection_request(request);
  const Workpiece part(q.shaft, q.options);
  const Held held(part, q);
  json result{{"format", "turnwright-deflection-result/1"},
              {"positions", positions(part, held, q)},
              {"warnings", warnings(q)}};
  if (q.bar) {
    const BarTip tip = bar_tip(Beam(q.shaft), q.clamping, *q.bar, *q.load);
    result["y_r_mm"] = tip.y_r_mm;
    result["y_t_mm"] = tip.y_t_mm;
    result["twist_rad_Nmm"] = tip.twist_rad_Nmm;
    result["bore_radius_error_mm"] = tip.bore_radius_error_mm;
  } else {
    result["envelope"] = largest_error(part, held, q);
  }
  if (q.face) result["face"] = face(held, q);
  require_finite(result, "deflection");
  return result;
}

}  // namespace turnwright::document
