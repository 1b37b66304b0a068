#include "turnwright/chatter/coherence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace turnwright::chatter {

std::vector<double> errors_by_coherence(std::span<const std::complex<double>> value,
                                        std::span<const double> coherence) {
  constexpr double kOfLine = 0.003, kOfHighest = 0.001;
  constexpr std::size_t kBeside = 4;
  double top = 0;  // of |Y|^2
  std::vector<double> noise, out;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double g = coherence[i], square = std::norm(value[i]);
    noise.push_back(square * (1 - g) / g);
    top = std::max(top, square);
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::size_t from = i - std::min(i, kBeside),
                      to = std::min(i + kBeside + 1, value.size());
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) sum += noise[k];
    out.push_back(std::sqrt(sum / static_cast<double>(to - from) +
                            kOfLine * kOfLine * std::norm(value[i]) +
                            kOfHighest * kOfHighest * top));
  }
  return out;
}

}  // namespace turnwright::chatter
