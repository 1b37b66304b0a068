#pragma once
#include <cmath>
#include <vector>

#include "turnwright/base/random.hpp"
#include "turnwright/learning/series.hpp"

/// Batches of parts from known truth.
namespace turnwright::learning {

/// Seeded draws.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double uniform() { return uniform_draw(splitmix64(seed_, k_++)); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {
    const double u = uniform();
    return normal_draw(u, uniform());
  }
  /// Chi-squared of few degrees of freedom.
  double chi_squared(int degrees) {
    double sum = 0;
    for (int k = 0; k < degrees; ++k) sum += std::pow(normal(), 2);
    return sum;
  }

 private:
  std::uint64_t seed_, k_ = 0;
};

struct Truth {
  double mu_mm = 25, s_mm = 0.002;
  double drift_mm_h = 0.003, wear_mm = 2e-4, edges_mm = 0.002;
  int edges = 8, parts_per_edge = 25;
  double missing = 0.03, outliers = 0.01;
  double offset_every = 0;  ///< parts between corrections; 0: none
  bool even_times = false;  ///< one part every four minutes, without breaks
};

struct Batch {
  Series series;
  double mean_mm = 0;     ///< expected mean of the parts in it
  double overall_mm = 0;  ///< root of the expected variance of the parts in it
  double next_mm = 0;     ///< expected value of the next part of the last edge
  Observation next;
  std::vector<std::size_t> wrong;  ///< outliers planted
};

inline Batch simulated(const Truth& truth, Draw& draw) {
  Batch b;
  std::vector<double> expected;
  double hours = 0, offset = 0, level = 0;
  int made = 0;
  const auto next_part = [&] {
    hours += truth.even_times ? 4 / 60.0 : draw.uniform(3, 6) / 60;
    if (!truth.even_times && draw.uniform() < 0.02) hours += draw.uniform(0.3, 1);
  };
  const auto at = [&](int age) {
    return truth.mu_mm + truth.drift_mm_h * hours + truth.wear_mm * age + offset;
  };
  for (int edge = 0; edge < truth.edges; ++edge) {
    level = truth.edges_mm * draw.normal();
    for (int age = 0; age < truth.parts_per_edge; ++age) {
      next_part();
      ++made;
      if (truth.offset_every > 0 && std::fmod(made, truth.offset_every) == 0)
        offset -= 0.001;
      double y = at(age) + level + truth.s_mm * draw.normal();
      const bool wrong = draw.uniform() < truth.outliers;
      if (wrong) y += (draw.uniform() < 0.5 ? -1 : 1) * truth.s_mm * draw.uniform(10, 40);
      if (draw.uniform() < truth.missing) continue;
      if (wrong) b.wrong.push_back(b.series.size());
      b.series.push_back(
          {y, offset, hours, static_cast<std::size_t>(edge), static_cast<double>(age)});
      if (!wrong) expected.push_back(at(age) + level);
    }
  }
  next_part();
  b.next = {0, offset, hours, static_cast<std::size_t>(truth.edges - 1),
            static_cast<double>(truth.parts_per_edge)};
  b.next_mm = at(truth.parts_per_edge) + level;
  const auto n = static_cast<double>(expected.size());
  double sum2 = 0;
  for (const double m : expected) b.mean_mm += m / n;
  for (const double m : expected) sum2 += std::pow(m - b.mean_mm, 2);
  b.overall_mm = std::sqrt(std::pow(truth.s_mm, 2) + sum2 / (n - 1));
  return b;
}

inline bool holds(const Estimate& e, double truth) {
  return e.lower <= truth && truth <= e.upper;
}

}  // namespace turnwright::learning
