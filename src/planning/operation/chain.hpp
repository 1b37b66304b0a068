#pragma once
#include <array>
#include <utility>
#include <vector>

#include "operation_model.hpp"
#include "planning/limits/check.hpp"
#include "planning/values/economy.hpp"
#include "yielding.hpp"

/// The operations that make one surface one after another, with the positions at which
/// its tolerances are imposed.
namespace turnwright::planning {

/// One position on the surface (z, or rho of a face) with its law in every pass.
struct Station {
  double at_mm = 0;
  std::vector<Law> passes;
};

/// Linear constraint of a tolerance at some positions: sum of weight_k e(station_k) <=
/// limit.
struct Functional {
  std::vector<std::pair<std::size_t, double>> terms;
  double limit = 0;
  std::size_t tolerance = 0;  ///< index into the drawing's tolerances
};

struct Chain {
  std::vector<OperationModel> operations;  ///< one or two
  catalogue::Range a;                      ///< finishing depth; lower == upper: fixed
  std::vector<Station> stations;
  std::vector<Functional> functionals;
  Economy weights;
};

/// Conditions of a chain: per operation speed and feed, and the finishing depth.
template <class T>
struct Choice {
  std::array<T, 2> v{}, f{};
  T a{};
};

/// The last pass of a chain at a station: its law, full depth and feed.
struct LastPass {
  Coefficients<double> law{};
  const cutting::Cut* cut = nullptr;
  double depth_mm = 0, f_mm_rev = 0;
};
LastPass last_pass(const Chain& chain, const Station& station,
                   const Choice<double>& choice);

/// Correction of the path of a last pass towards the material that leaves no error: the
/// law at the full depth, which is then really cut, s = law(full).  It is not -e, because
/// a deeper cut yields more.  On a face the depth has no influence.
double correction_mm(const LastPass& pass);
/// Error that remains with the path moved by s towards the material, by (2) with a depth
/// larger by s: y = law(full + s - y), e = y - s.
double corrected_error_mm(const LastPass& pass, double s_mm);

/// Error of the finished surface at a station after all passes.  Faces have no feedback:
/// yielding along the axis changes the length, not the depth.
template <class T>
Signed<T> error_mm(const Chain& chain, const Station& station, const Choice<T>& c,
                   const std::array<cutting::Forces<T>, 2>& F) {
  Signed<T> e(0.0);
  std::size_t k = 0;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const T ap = o.depth_mm(c.a);
    for (std::size_t p = 0; p < o.passes.size(); ++p, ++k)
      e = o.face ? law_mm<T>(at(station.passes[k], linear(c.a)), F[i])
                 : yielding_mm(station.passes[k], o.cut, c.a, ap, c.f[i], e);
  }
  return e;
}

/// Value and limit of every functional.
template <class T, class Sink>
void tolerance_checks(const Chain& chain, const Choice<T>& c,
                      const std::array<cutting::Forces<T>, 2>& F, const Sink& sink) {
  if (chain.functionals.empty()) return;
  std::vector<Signed<T>> e;
  e.reserve(chain.stations.size());
  for (const auto& s : chain.stations) e.push_back(error_mm(chain, s, c, F));
  for (std::size_t i = 0; i < chain.functionals.size(); ++i) {
    const auto& g = chain.functionals[i];
    Signed<T> sum = e[g.terms[0].first] * g.terms[0].second;
    for (std::size_t k = 1; k < g.terms.size(); ++k)
      sum = sum + e[g.terms[k].first] * g.terms[k].second;
    sink(i, Check::tolerance, false, sum, Signed<T>(g.limit));
  }
}

}  // namespace turnwright::planning
