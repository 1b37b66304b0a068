#pragma once

namespace turnwright {

// Probabilities and quantiles of Boost.Math's distributions, whose templates are compiled in
// one source file alone.  Quantiles are of p in (0, 1), degrees of freedom are > 0.
// @throws std::domain_error  p or the degrees are outside.

/// z that a standard normal value stays below with probability p.
double normal_quantile(double p);
/// Probability that a standard normal value stays below z.
double normal_probability(double z);

/// t that Student's t stays below with probability p.
double student_quantile(double p, double degrees);
/// t that Student's t exceeds with probability p, also a tiny one.
double student_upper_quantile(double p, double degrees);
/// Probability that Student's t exceeds t.
double student_exceeds(double t, double degrees);

/// Probability that Fisher's F of these degrees of freedom exceeds F >= 0.
double fisher_exceeds(double F, double of_numerator, double of_denominator);

/// Value that chi squared stays below with probability p.
double chi_squared_quantile(double p, double degrees);
/// Value that chi squared exceeds with probability p.
double chi_squared_upper_quantile(double p, double degrees);

}  // namespace turnwright
