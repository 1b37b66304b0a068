#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "force_shares.hpp"
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
  friend bool operator==(const Functional&, const Functional&) = default;
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

/// Error of the surface at a station after some of its passes, or all of them.  Faces have
/// no feedback: yielding along the axis changes the length, not the depth.
template <class T>
Signed<T> error_mm(const Chain& chain, const Station& station, const Choice<T>& c,
                   const std::array<cutting::Forces<T>, 2>& F, std::size_t passes) {
  Signed<T> e(0.0);
  std::size_t k = 0;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const T ap = o.depth_mm(c.a);
    for (std::size_t p = 0; p < o.passes.size() && k < passes; ++p, ++k)
      e = o.face ? law_mm<T>(at(station.passes[k], linear(c.a)), F[i])
                 : yielding_mm(station.passes[k], o.cut, c.a, ap, c.f[i], e);
  }
  return e;
}
template <class T>
Signed<T> error_mm(const Chain& chain, const Station& station, const Choice<T>& c,
                   const std::array<cutting::Forces<T>, 2>& F) {
  return error_mm(chain, station, c, F, station.passes.size());
}

/// The errors of some stations, for sums of them.
template <class T>
class StationErrors {
 public:
  StationErrors(const Chain& chain, const Choice<T>& c,
                const std::array<cutting::Forces<T>, 2>& F) {
    for (const auto& s : chain.stations) e_.push_back(error_mm(chain, s, c, F));
  }
  T sum(const Functional& g) const {
    T sum = e_[g.terms[0].first] * g.terms[0].second;
    for (std::size_t k = 1; k < g.terms.size(); ++k)
      sum = sum + e_[g.terms[k].first] * g.terms[k].second;
    return sum;
  }

 private:
  std::vector<T> e_;
};

/// Over a box a sum of errors is enclosed as a sum of enclosures and by (6) of the last
/// pass; on a face by one law, the sum of their laws.
template <int N>
class StationErrors<LogDual<N>> {
 public:
  using Error = Dual<Interval, N>;
  StationErrors(const Chain& chain, const Choice<LogDual<N>>& c,
                const std::array<cutting::Forces<LogDual<N>>, 2>& F)
      : F_(F[chain.operations.size() - 1]), face_(chain.operations.back().face) {
    const auto& o = chain.operations.back();
    const LogDual<N> ap = o.depth_mm(c.a), f = c.f[chain.operations.size() - 1];
    for (const auto& s : chain.stations) {
      const auto& law = s.passes.back();
      if (face_)
        last_.push_back({{}, at(law, linear(c.a)), {}, {}});
      else
        last_.push_back(yielded(law, o.cut, c.a, ap, f,
                                error_mm(chain, s, c, F, s.passes.size() - 1)));
    }
    if (!face_) shares_ = ForceShares<N>::of(o.cut, ap, f, F_, last_);
  }
  Error sum(const Functional& g) const {
    if (face_) return of_face(g);
    Error all(0.0);
    for (const auto& [station, weight] : g.terms) all = all + last_[station].e * weight;
    if (!shares_) return all;
    const Error together = shares_->sum(g.terms);
    all.v = intersect(all.v, together.v);
    for (std::size_t j = 0; j < N; ++j) all.d[j] = intersect(all.d[j], together.d[j]);
    return all;
  }

 private:
  Error of_face(const Functional& g) const {
    Coefficients<Error> law{};
    for (const auto& [station, weight] : g.terms) {
      const auto& own = last_[station].law;
      law = {law.p + own.p * weight, law.q + own.q * weight, law.s + own.s * weight,
             law.r + own.r * weight};
    }
    return law_mm<LogDual<N>>(law, F_);
  }

  cutting::Forces<LogDual<N>> F_;
  bool face_ = false;
  std::vector<Yielded<N>> last_;
  std::optional<ForceShares<N>> shares_;
};

/// Value and limit of every functional.
template <class T, class Sink>
void tolerance_checks(const Chain& chain, const Choice<T>& c,
                      const std::array<cutting::Forces<T>, 2>& F, const Sink& sink) {
  if (chain.functionals.empty()) return;
  const StationErrors<T> errors(chain, c, F);
  for (std::size_t i = 0; i < chain.functionals.size(); ++i) {
    const auto& g = chain.functionals[i];
    sink(i, Check::tolerance, false, errors.sum(g), Signed<T>(g.limit));
  }
}

}  // namespace turnwright::planning
