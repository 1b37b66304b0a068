// The rectangle of greatest area in the unit circle: min -ln(x y) with x^2 + y^2 <= 1.
#include <cmath>
#include <cstdio>
#include <vector>

#include "turnwright/optimise/local.hpp"

int main() {
  using namespace turnwright::optimise;
  const Problem problem{.lower = {-3, -3},  // of ln x and ln y
                        .upper = {0, 0},
                        .constraints = 1,
                        .evaluate = [](std::span<const double> y, Values& out) {
                          const double x2 = std::exp(2 * y[0]), y2 = std::exp(2 * y[1]);
                          out.f = -y[0] - y[1];
                          out.df = {-1, -1};
                          out.g = {std::log(x2 + y2)};
                          out.dg = {2 * x2 / (x2 + y2), 2 * y2 / (x2 + y2)};
                        }};
  const auto found = local_minimum(problem, std::vector<double>{-1, -2});
  std::printf("%.6f by %.6f, multiplier %.3f\n", std::exp(found.y[0]),
              std::exp(found.y[1]), found.multipliers[0]);
}
