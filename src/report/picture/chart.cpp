#include "chart.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::report {
namespace {

constexpr double kTick = 1, kText = 3.6;

/// Decimals that tell multiples of a round step apart.
int decimals(double step) {
  return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

double step_of(const Scale& s, int count) {
  return round_below((s.high - s.low) / count * 1.0001);
}

}  // namespace

double round_below(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= x * (1 + 1e-12)) return factor * power;
  return power;
}

std::vector<double> ticks(const Scale& s, int count) {
  const double step = step_of(s, count);
  std::vector<double> out;
  const double slack = 1e-9 * (s.high - s.low);
  for (double k = std::ceil((s.low - slack) / step); k * step <= s.high + slack; ++k)
    out.push_back(k * step);
  return out;
}

void frame(Svg& svg, const Scale& x, const Scale& y, const std::string& x_name,
           const std::string& y_name, int x_ticks, int y_ticks) {
  svg.polyline(
      "",
      {{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}, {x.from, y.from}});
  const int dx = decimals(step_of(x, x_ticks)), dy = decimals(step_of(y, y_ticks));
  for (const double t : ticks(x, x_ticks)) {
    const double at = x.place(t);
    svg.line("thin", {at, y.from}, {at, y.from - kTick});
    svg.text({at, y.from + kText}, Anchor::middle, plain(t, dx));
  }
  for (const double t : ticks(y, y_ticks)) {
    const double at = y.place(t);
    svg.line("leader", {x.from, at}, {x.to, at});
    svg.text({x.from - 1, at + 1}, Anchor::end, plain(t, dy));
  }
  svg.text({(x.from + x.to) / 2, y.from + 2 * kText}, Anchor::middle, x_name);
  svg.text_upwards({x.from - 11, (y.from + y.to) / 2}, Anchor::middle, y_name);
}

}  // namespace turnwright::report
