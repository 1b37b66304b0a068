#include "turnwright/base/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace turnwright {

using namespace boost::math;

double normal_quantile(double p) { return quantile(normal(), p); }
double normal_probability(double z) { return cdf(normal(), z); }

double student_quantile(double p, double degrees) {
  return quantile(students_t(degrees), p);
}
double student_upper_quantile(double p, double degrees) {
  return quantile(complement(students_t(degrees), p));
}
double student_exceeds(double t, double degrees) {
  return cdf(complement(students_t(degrees), t));
}

double fisher_exceeds(double F, double of_numerator, double of_denominator) {
  return cdf(complement(fisher_f(of_numerator, of_denominator), F));
}

double chi_squared_quantile(double p, double degrees) {
  return quantile(chi_squared(degrees), p);
}
double chi_squared_upper_quantile(double p, double degrees) {
  return quantile(complement(chi_squared(degrees), p));
}

}  // namespace turnwright
