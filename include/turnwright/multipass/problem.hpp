#pragma once
#include <optional>
#include <string>
#include <vector>

/// The literature's multi-pass turning problem, [Shin 1992] in the form of [Chen 1996]:
/// n equal roughing passes and a finishing pass remove the depth dt from a bar.  Speed,
/// feed and depth of both are chosen for the least cost per piece.
namespace turnwright::multipass {

/// How tool wear is counted: t/Tp with the mean life Tp = theta Tr + (1 - theta) Ts of
/// the literature, or the sum of t/T over the passes.
enum class Cost { literal, physical };

struct Range {
  double lower = 0, upper = 0;
};

/// Units are the literature's: mm, m/min, mm/rev, min, kgf, kW, degC, um.
///
///     UC = k0 t + k0 (tc + (h1 L + h2)(n + 1)) + (k0 te + kt) N                     (1)
///     t = n tr + ts,  tr = K/(Vr fr),  ts = K/(Vs fs),  K = pi D L/1000             (2)
///     N = t/(theta Tr + (1 - theta) Ts)  |  n tr/Tr + ts/Ts                         (3)
///     T = C0/(V^p f^q d^r)                                                          (4)
///     F = kf f^mu d^nu <= FU,  P = F V/(6120 eta) <= PU                             (5)
///     V^lambda f d^nu2 >= SC,  Q = kq V^tau f^phi d^delta <= QU                     (6)
///     1000 fs^2/(8 R) <= SRu                                                        (7)
///     Vs >= k3 Vr,  fr >= k4 fs,  dr >= k5 ds,  n dr + ds = dt                      (8)
///
/// and the ranges of V, f, d, T.  (4) to (6) hold for roughing and for finishing.  A
/// factor k3, k4, k5 or a limit SC of zero imposes nothing.
/// Source: the equations and the values below are those that the literature repeats,
/// recalled from memory; the papers were not opened.
struct Problem {
  double D_mm = 50, L_mm = 300, dt_mm = 6;
  Cost cost = Cost::literal;
  Range V{50, 500}, f{0.1, 0.9}, d{1, 3}, T{25, 45};
  double k0 = 0.5, kt = 2.5, h1 = 7e-4, h2 = 0.3, tc = 0.75, te = 1.5;
  double p = 5, q = 1.75, r = 0.75, C0 = 6e11;
  double kf = 108, mu = 0.75, nu = 0.95, eta = 0.85, FU = 200, PU = 5;
  double lambda = 2, nu2 = -1, SC = 140;
  double kq = 132, tau = 0.4, phi = 0.2, delta = 0.105, QU = 1000;
  double R_mm = 1.2, SRu_um = 10;
  double k3 = 1, k4 = 2.5, k5 = 1, theta = 0.8;
  int n_max = 6;
  std::optional<double> VrU;  ///< an upper speed for roughing alone
};

struct Pass {
  double V = 0, f = 0, d = 0;
};

/// Tool life, force, power, stability and temperature of a pass.
struct Load {
  double T = 0, F = 0, P = 0, stability = 0, Q = 0;
};
Load load(const Problem& problem, const Pass& pass);

/// The cost per piece by Eq. (1).
double unit_cost(const Problem& problem, int n, const Pass& rough, const Pass& finish);

/// A limit with its value at the chosen passes.
struct Limit {
  std::string name;  ///< "rough:PU", "finish:T_min", "k4"
  double value = 0, limit = 0;
  double margin = 0;  ///< ln(limit/value) of an upper limit; < 0: violated
  bool binding = false;
  double price = 0;  ///< d ln UC / d ln limit; 0 where it does not bind
};

/// Optimum for one number of roughing passes.
struct PassCount {
  enum class Status { optimal, infeasible, unsettled };
  int n = 0;
  Status status = Status::infeasible;
  std::optional<double> UC;  ///< none if infeasible, or if no feasible point was found
  double lower_bound = 0;    ///< without meaning if infeasible
  Pass rough, finish;        ///< the passes that cost UC
  long nodes = 0;
};

/// Relaxation of one limit of a conflict: the value that the number of the request would
/// need, for roughing and finishing alike, with all other numbers as they are.
struct Relief {
  std::string limit;
  double now = 0;
  std::optional<double> needed;  ///< none: relaxing this limit alone never suffices
};

/// The answer to a problem; an infeasible one has no `best` and a conflict.
struct Answer {
  std::optional<PassCount> best;
  std::vector<PassCount> per_count;  ///< n = 1 .. n_max
  std::vector<Limit> limits;         ///< at the best
  double lower_bound = 0;            ///< of UC over every n
  double gap = 0;                    ///< (UC - lower_bound)/UC; certified within kGap
  long nodes = 0;
  std::vector<Relief> conflict;  ///< irreducible
};

/// Relative gap of a certificate.
inline constexpr double kGap = 1e-6;
/// A limit is kept if ln(value/limit) is at most this.
inline constexpr double kFeasibility = 1e-9;

/// The global optimum with its proof.
///
/// In logarithms of V, f, d all limits are linear.  UC is a convex sum of exponentials
/// (physical) or, with the mean tool life, not convex (literal), and the depths must add
/// up to dt.  For each n a best-first search splits ranges of ln dr and, if literal, of
/// s = ln(Ts/Tr).  On each part ln ds lies between the chord and three tangents of the
/// concave ln(dt - n exp(ln dr)), and
///
///     ln(theta + (1 - theta) exp(s)) <= its chord alpha + beta s                   (9)
///
/// so UC is bounded below by the optimum of a sum of exponentials under linear limits,
/// for which optimise::minimise gives a proved bound.  Both errors shrink with the square
/// of the range.  With fixed ln dr and the tangent of (9) instead of its chord the same
/// program gives feasible points; the best is refined by optimise::local_minimum on (1).
/// Source: derived here; independent searches in multipass tests.
/// @throws std::domain_error if the problem is not finite and in range.
Answer optimum(const Problem& problem);

}  // namespace turnwright::multipass
