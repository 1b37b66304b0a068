#include "calibrate_material_fits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/say.hpp"
#include "document/json/reader.hpp"

namespace turnwright::document::material_calibration {
namespace {

std::optional<cutting::ForceFit> forces(const Request& q) {
  if (std::ranges::none_of(q.cuts, &MeasuredCut::has_force)) return std::nullopt;
  std::vector<cutting::MeasuredCut> cuts;
  for (const MeasuredCut& c : q.cuts)
    cuts.push_back({c.ap_mm, c.f_mm_rev, c.F_N, c.lab, c.replica});
  return cutting::fit_forces(cuts, q.edge, q.options);
}

std::optional<Lives> lives(const Request& q) {
  Lives out;
  std::vector<cutting::LifePoint> points;
  bool of_edges = false;
  for (std::size_t i = 0; i < q.cuts.size(); ++i) {
    const MeasuredCut& c = q.cuts[i];
    if (!c.life) continue;
    points.push_back(
        {c.vc_m_min, c.f_mm_rev, c.ap_mm, c.life->T_min, c.life->longer, c.lab});
    out.cuts.push_back(i);
    out.censored += c.life->longer;
    of_edges = of_edges || c.life->longer || c.life->from_wear || c.edge;
  }
  if (points.empty()) return std::nullopt;
  out.fit = cutting::fit_taylor(points, q.given_a, q.given_b, q.options);
  if (of_edges && out.fit.n)
    out.scatter =
        cutting::scatter_of_lives(points, out.fit, q.given_a, q.given_b, q.options);
  out.fit.evidence.rename(out.cuts);
  return out;
}

std::optional<cutting::RoughnessFit> roughness(const Request& q) {
  std::vector<cutting::RoughnessPoint> points;
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < q.cuts.size(); ++i)
    if (const MeasuredCut& c = q.cuts[i]; c.has_roughness()) {
      points.push_back({c.f_mm_rev, c.Ra_um, c.Rz_um});
      cuts.push_back(i);
    }
  if (points.empty()) return std::nullopt;
  auto fit = cutting::fit_roughness(points, q.edge, q.options);
  fit.evidence.rename(cuts);
  return fit;
}

Problem undetermined(const Request& q, std::size_t cuts, const std::string& column,
                     const std::string& constants, const std::string& test) {
  return {q.cuts_pointer,
          say("{} cuts with {} that cannot tell {}", cuts, column, constants), test,
          "identifiability"};
}

std::size_t measured(const Request& q, std::size_t component) {
  return static_cast<std::size_t>(std::ranges::count_if(
      q.cuts, [&](const MeasuredCut& c) { return c.F_N[component].has_value(); }));
}

bool force_constants(const Request& q, Fits& all) {
  bool some = all.forces && all.forces->law != cutting::ThrustLaw::none;
  for (std::size_t k = 0; all.forces && k < kComponents.size(); ++k) {
    const auto& fit = all.forces->kienzle[k];
    const Component& c = kComponents[k];
    if (fit && !fit->m)
      all.undetermined.push_back(undetermined(q, measured(q, k), c.column,
                                              say("{} and {}", std::string(c.k11), c.m),
                                              fit->missing[0].test));
    some = some || (fit && fit->m);
  }
  return some;
}

bool life_constants(const Request& q, Fits& all) {
  if (!all.lives) return false;
  if (all.lives->fit.n) return true;
  const auto plain = [&](std::size_t i) {
    return !q.cuts[i].life->longer && !q.cuts[i].life->from_wear;
  };
  const std::string column =
      std::ranges::all_of(all.lives->cuts, plain) ? "T_min" : tr("a tool life");
  all.undetermined.push_back(undetermined(q, all.lives->cuts.size(), column,
                                          tr("n and C"), all.lives->fit.missing[0].test));
  return false;
}

bool roughness_constants(const Request& q, Fits& all) {
  if (!all.roughness) return false;
  if (all.roughness->hmin_mm) return true;
  all.undetermined.push_back(undetermined(q, 1, tr("Ra_um or Rz_um"), "hmin_mm",
                                          tr("a second cut with a roughness")));
  return false;
}

// Of the labs, those on whose constants nothing or little is known.
void warn_of_labs(const Request& q, const std::optional<cutting::Labs>& labs,
                  const std::string& column, std::vector<std::string>& warnings) {
  if (!labs) {
    warnings.emplace_back(
        say("the cuts with {} that tell a constant are of one lab; how labs differ is "
            "not known",
            column));
    return;
  }
  for (const auto& l : labs->each)
    if (l.measurements == 1)
      warnings.emplace_back(
          say("lab \"{}\" has one cut with {}, on which alone its factor rests",
              q.labs[l.lab], column));
}

void warn_of_forces(const Request& q, const cutting::ForceFit& f,
                    std::vector<std::string>& warnings) {
  if (f.law == cutting::ThrustLaw::none && measured(q, kFeed) + measured(q, kPassive) > 0)
    warnings.emplace_back(
        tr("not determined: the thrust force; it takes a known kc1.1 and three cuts with "
           "Fp_N that flow at less than 70 deg to the radius, or with Ff_N that flow at "
           "more than 20 deg"));
}

void warn_of_thrust(const cutting::ForceFit& f, std::vector<std::string>& warnings) {
  if (f.law == cutting::ThrustLaw::direction && f.thrust->scaled)
    warnings.emplace_back(
        tr("the cuts do not tell ratio and edge_N_mm of thrust apart: both are the given "
           "ones times one number; it takes cuts with Fp_N at feeds further apart"));
}

void warn_of_scatter(const cutting::LifeScatter& s, double confidence,
                     std::vector<std::string>& warnings) {
  if (!s.s_between)
    warnings.emplace_back(
        tr("the scatter between edges is not told apart from what the law of tool life "
           "misses; it takes two edges at the same speed, feed and depth"));
  if (s.lack_of_fit_p.value_or(1) < 1 - confidence)
    warnings.emplace_back(
        say("tool lives miss Taylor's law by more than edges scatter: by {} %, which has "
            "a chance of {}",
            rounded(100 * *s.s_lack_of_fit), rounded(*s.lack_of_fit_p)));
}

void warn_of_lives(const Request& q, const Lives& t, std::vector<std::string>& warnings) {
  for (const cutting::Missing& m : t.fit.missing)
    warnings.emplace_back(say("{} stays at its given {}; it takes {}", m.parameter,
                              rounded(m.parameter == "a" ? q.given_a : q.given_b),
                              m.test));
  if (t.scatter) warn_of_scatter(*t.scatter, q.options.confidence, warnings);
  if (q.labs.empty()) return;
  warn_of_labs(q, t.fit.labs, tr("a tool life"), warnings);
  for (std::size_t lab = 0; lab < q.labs.size(); ++lab) {
    const auto of_lab = [&](std::size_t i) { return q.cuts[i].lab == lab; };
    const auto ended = [&](std::size_t i) {
      return of_lab(i) && !q.cuts[i].life->longer;
    };
    if (std::ranges::any_of(t.cuts, of_lab) && std::ranges::none_of(t.cuts, ended))
      warnings.emplace_back(say(
          "lab \"{}\" has no tool life that ended; its lives are not used", q.labs[lab]));
  }
}

}  // namespace

std::string rounded(double x) { return fmt::format("{:.4g}", x); }

Fits fitted(const Request& q) {
  Fits all{.forces = forces(q),
           .lives = lives(q),
           .roughness = roughness(q),
           .undetermined = {}};
  const bool of_forces = force_constants(q, all), of_lives = life_constants(q, all),
             of_roughness = roughness_constants(q, all);
  if (of_forces || of_lives || of_roughness) return all;
  Problems problems{.document = "calibrate-material"};
  for (const Problem& p : all.undetermined) problems.add(p);
  problems.throw_if_any();
  return all;
}

std::vector<std::string> warnings_of(const Request& q, const Fits& fits) {
  std::vector<std::string> warnings;
  for (const Problem& p : fits.undetermined)
    warnings.emplace_back(say("not determined: {}; it takes {}", p.got, p.expected));
  if (fits.forces) warn_of_forces(q, *fits.forces, warnings);
  if (fits.lives && fits.lives->fit.n) warn_of_lives(q, *fits.lives, warnings);
  if (fits.forces) warn_of_thrust(*fits.forces, warnings);
  if (const auto& f = fits.forces; f && !q.labs.empty())
    for (std::size_t k = 0; k < kComponents.size(); ++k)
      if (const auto& fit = f->kienzle[k]; fit && fit->m)
        warn_of_labs(q, fit->labs, kComponents[k].column, warnings);
  if (fits.roughness && fits.roughness->below_corner)
    warnings.emplace_back(
        tr("hmin_mm is 0: the cuts are as smooth as the corner alone makes them, or "
           "smoother"));
  return warnings;
}

}  // namespace turnwright::document::material_calibration
