#pragma once
#include <span>
#include <vector>

#include "turnwright/learning/series.hpp"

/// What measured parts say of the factors by which a model may be off.
///
/// Prior and likelihood of factors t that act linearly,
///
///     t_i ~ N(m_i, p_i^2),   z_j = sum_i h_ji t_i + e_j,   e_j ~ N(0, u_j^2)         (1)
///     C = (diag(1/p_i^2) + H' diag(1/u_j^2) H)^-1
///     posterior  t ~ N(m + C H' diag(1/u_j^2) (z - H m), C)                          (2)
///
/// and of a variance, with the scaled inverse chi-squared prior of nu_0 degrees of freedom,
///
///     s^2 ~ nu_0 s_0^2/chi^2_nu0,   SS ~ s^2 chi^2_nu
///     posterior  s^2 ~ (nu_0 s_0^2 + SS)/chi^2_(nu_0 + nu)                           (3)
///
/// A relative standard uncertainty r of s_0 is nu_0 = 1/(2 r^2), by which a chi-squared
/// variable spreads for many degrees of freedom.
/// Source: conjugate priors of the normal distribution [Gelman 2013], written out here;
/// factors_test compares (2) with a grid and simulates coverage of truths from the prior.
namespace turnwright::learning {

struct Prior {
  double mean = 0, sd = 0;  ///< sd > 0
};

/// One z_j: effects h_j of all factors, its value and its standard uncertainty > 0.
struct Evidence {
  std::vector<double> effects;
  double value = 0, u = 0;
};

struct Posterior {
  Estimate factor;
  bool identified = false;  ///< its uncertainty is less than 0.9 of that before
};

/// (2), for each factor its own distribution.
/// @throws std::domain_error unless every evidence has an effect of each factor.
std::vector<Posterior> posterior(std::span<const Prior> prior,
                                 std::span<const Evidence> evidence, double confidence);

/// Two values whose errors have the correlation rho as two with none: the second less what
/// the first says of it.
std::vector<Evidence> uncorrelated(const Evidence& first, Evidence second, double rho);

/// A standard deviation known by so many degrees of freedom.
struct ScatterPrior {
  double s = 0, degrees = 0;
};
ScatterPrior scatter_prior(double s, double relative_u);

/// (3).  @param sum_of_squares  of `degrees` degrees of freedom.
Posterior posterior(const ScatterPrior& prior, double sum_of_squares, double degrees,
                    double confidence);

}  // namespace turnwright::learning
