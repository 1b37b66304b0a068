#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "turnwright/tolerance/acceptance.hpp"

/// Error budget of a tolerance: the effect of uncertain sources in addition to the cut's
/// deviation.  Their sum
///
///     S = sum_i s_i X_i                                                       (1)
///
/// shifts the whole surface (size, located profile) or widens its zone (all other kinds).
/// s_i is the sensitivity of the independent source X_i with value a, [um]:
///
///     distribution  X                  mean          sigma             reach
///     normal        sigma a            0             a                 -3 a .. 3 a
///     uniform       half-width a       0             a/sqrt 3          -a .. a
///     triangular    half-width a       0             a/sqrt 6          -a .. a
///     arcsine       half-width a       0             a/sqrt 2          -a .. a
///     fixed         a known bias a     a             0                 a
///     rayleigh      length of a vector a sqrt(pi/2)  a sqrt(2 - pi/2)  0 .. 3.635 a
///
/// arcsine is a sine at a random phase, such as a slow swing of temperature.  The
/// rayleigh vector has two normal components of sigma a, such as an eccentricity of
/// random direction.  The reach is the whole range, or the value that 0.135 % exceed (3
/// sigma of a normal).  Then, upwards and downwards alike:
///
///     worst case     W = sum_i of the reach of s_i X_i                        (2)
///     root of sum of squares
///                    R = mean S +- sqrt(sum_i (reach - mean of s_i X_i)^2)    (3)
///     share          s_i^2 sigma_i^2 / sum_j s_j^2 sigma_j^2                  (4)
///
/// A case of acceptance.hpp conforms for  down <= S <= up:
///
///     diameter, length        down = l - low,               up = u - high
///     profile by datums       down = -t/2 - e_min cos alpha, up = t/2 - e_max cos alpha
///     all others              no lower end,                 up = t - measured (5)
///
/// with the least and largest deviation low, high of the size by (1)-(3) there.  Results:
///
///     conformance    P = P(down <= S <= up)                                   (6)
///     index          min[ (up - Q50)/(Q99.865 - Q50), (Q50 - down)/(Q50 - Q0.135) ],
///                    for zones the first alone                                (7)
///     acceptance     (6) with the room narrowed by U at each end              (8)
///
/// Q are percentiles of S, and U is the expanded uncertainty of the measurement that has
/// to prove conformity.  A source that scales the deviation itself (a relative
/// uncertainty r of force or stiffness) is entered as normal with value r and the largest
/// deviation of the size or zone as sensitivity.  This is on the safe side, because the
/// end of the surface that deviates less is moved as much as the other (derived here,
/// checked in budget_test).
///
/// The sources are independent, and S does not change e.  Symmetrical sources can make a
/// zone negative, which is impossible for a form; only percentiles below the median are
/// affected.
/// Sources: (2), (3) common practice; (7) the percentile method of ISO 22514-2/-4 as
/// Minitab's help quotes it (pinzhi.org, "ISO method for nonnormal capability analysis");
/// (8) the rule of ISO 14253-1, from general knowledge.
namespace turnwright::tolerance {

enum class Distribution { normal, uniform, triangular, arcsine, fixed, rayleigh };

struct Source {
  std::string name;
  Distribution distribution = Distribution::normal;
  double value_um = 0;     ///< a; >= 0 except of a fixed bias
  double sensitivity = 1;  ///< of the size (2 for a radius on a diameter) or zone
};

/// From `down` up to `up`; `down` is -infinity where there is no lower end.
struct Span {
  double down_um = 0, up_um = 0;
};

/// The range of S in which the case conforms, (5).
Span room_um(const Verdict& v);

struct Draws {
  std::uint64_t seed = 1;
  std::size_t count = 100'000;  ///< > 0; P's error falls with its square root
  unsigned threads = 1;         ///< affects only the time; 0: all cores, at most 64
};

/// Draws of S in rising order, the same for the same sources, draws and seed.
///
/// Draw k of source i is a function of (seed, i, k) alone: it uses the numbers 2 k and
/// 2 k + 1 of SplitMix64, started at number i of the sequence of `seed`, 53 bits of each
/// as a number in (0, 1); normal and rayleigh follow by Box and Muller.  So a draw
/// depends neither on the threads nor on the number of draws.  The streams of two sources
/// are parts of one cycle of 2^64 at random positions: any two of 100 sources with 10^7
/// draws overlap with probability 1e-8.
/// @throws std::domain_error if a value is negative or not finite (fixed: not finite), a
///   sensitivity is not finite, or draws is 0; Cancelled if the thread is asked to leave.
std::vector<double> rising_sum_um(std::span<const Source> sources, const Draws& draws);

/// The p-quantile of rising draws, interpolated linearly at the rank (n - 1) p.  With
/// p = (1 + P)/2 and (1 - P)/2 (zones: P) these are the limits for a conformance P.
/// @throws std::domain_error if there are no draws or p is not in [0, 1].
double quantile_um(std::span<const double> rising_um, double p);

/// Share of rising draws within the range `room`, both ends included.
double share_within(std::span<const double> rising_um, const Span& room);

/// The reach of S by the root of the sum of squares, (3).
/// @throws std::domain_error as rising_sum_um().
Span rss_um(std::span<const Source> sources);

/// Eq. (6) in closed form where the sources allow it.  Of n uniform sources with half
/// widths w and a normal sum with standard deviation sigma,
///
///     P(S <= x) = sum over the 2^n signs e of  prod(e) I_n(x + e w) / (2^n prod w)   (9)
///     I_k(t) = (t I_{k-1}(t) + sigma^2 I_{k-2}(t))/k,
///     I_0 = Phi(t/sigma),  I_{-1} = phi(t/sigma)/sigma
///
/// and of one rayleigh vector a with a normal sum, s^2 = a^2 + sigma^2,
///
///     P(S <= x) = Phi(x/sigma) - (a/s) exp(-x^2/(2 s^2)) Phi(x a/(sigma s))         (10)
///
/// A triangular source is two uniform ones; a width below 1e-3 of the whole reach counts
/// with its variance as normal, which is 5e-5 of P at most.  Other sums are drawn, once for any number
/// of rooms, what is normal or fixed apart: with a standard deviation of at most
/// sqrt(P (1 - P)/draws), 4e-4 at P = 0.9973 with 20 000.
/// Source: derived here, checked in budget_test against draws.
class Spread {
 public:
  /// @throws std::domain_error as rising_sum_um().
  explicit Spread(std::span<const Source> sources,
                  const Draws& draws = {.count = 20'000});

  /// P(down <= S + N <= up) with a further normal source N.
  double within(const Span& room, double further_sigma_um = 0) const;

 private:
  bool closed() const { return drawn_um_.empty(); }
  double below(double x_um, double variance_um2) const;

  double mean_um_ = 0, variance_um2_ = 0;
  std::vector<double> uniform_um_;  // half widths, in closed form
  double rayleigh_um_ = 0;          // likewise
  std::vector<double> drawn_um_;    // rising
  std::vector<double> means_um_;  // of twenty neighbours each, for what a normal smooths
};

/// Decision about a lot by the rule of ISO 14253-1.
enum class Decision {
  conforms,         ///< (8) reaches the required conformance
  not_proven,       ///< neither of the two
  does_not_conform  ///< (6) does not reach it even with the limits widened by U
};

struct BudgetDemand {
  std::vector<Source> sources;
  double conformance = 0.9973;  ///< required (6), in [0, 1]
  double measurement_U_um = 0;  ///< expanded uncertainty, >= 0
  Draws draws = {};
};

struct SourceShare {
  std::string name;
  double worst_case_um = 0;   ///< largest |s X| within reach
  double variance_share = 0;  ///< (4); 0 for all if no source spreads
};

struct Budget {
  Span room_um;                  ///< (5)
  Span worst_case_um = {};       ///< (2)
  Span rss_um = {};              ///< (3)
  bool worst_case_fits = false;  ///< within the room
  bool rss_fits = false;
  double mean_um = 0, sigma_um = 0;      ///< of S, in closed form
  std::vector<SourceShare> shares = {};  ///< in the order of the sources
  double P_conform = 0;                  ///< (6)
  double P_low = 0, P_high = 0;          ///< 95 % interval of P_conform, [Wilson 1927]
  double P_accept = 0;                   ///< (8)
  double Q0_135_um = 0, Q50_um = 0, Q99_865_um = 0;
  std::optional<double> index = {};  ///< (7); none if S does not spread
  Decision decision = Decision::not_proven;
};

/// The budget of a tolerance in which the sources may use the range `room`.
/// @throws std::domain_error as rising_sum_um(), or if the required conformance or U is
///   out of range, or if an end of `room` is NaN.
Budget budget(const BudgetDemand& demand, const Span& room);

}  // namespace turnwright::tolerance
