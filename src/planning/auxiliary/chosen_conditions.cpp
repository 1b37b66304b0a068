#include "chosen_conditions.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

namespace turnwright::planning {
namespace {

using catalogue::ConditionsWindow;
using Trial = std::function<ConditionsTrial(const SpeedAndFeed&)>;

constexpr int kSections = 48;    // of the speed: 1e-10 of its range
constexpr int kBisections = 40;  // of the feed
constexpr int kDigits = 26;  // bits of ln v by Brent's method, whose error counts squared

class Search {
 public:
  Search(const ConditionsWindow& window, const Trial& trial)
      : window_(window), trial_(trial) {}

  // The best of the window if no limit counted, where it keeps them all.
  bool unlimited() {
    const auto [lowest, highest] = window_.vc_m_min;
    const auto [ln, value] = boost::math::tools::brent_find_minima(
        [&](double x) { return objective(trial(std::exp(x), wanted_feed(std::exp(x)))); },
        std::log(lowest), std::log(highest), kDigits);
    for (const double vc : {std::exp(ln), lowest, highest}) {
      const double f = wanted_feed(vc);
      const auto t = trial(vc, f);
      if (objective(t) > value || !t.feasible) continue;
      best_ = {vc, f};
      return true;
    }
    return false;
  }

  // The best of the speeds of one range of the spindle.
  void section(double from, double to) {
    double a = std::log(from), b = std::log(to);
    constexpr double kShare = std::numbers::phi - 1;
    double left = b - kShare * (b - a), right = a + kShare * (b - a);
    double at_left = least(std::exp(left)), at_right = least(std::exp(right));
    for (int i = 0; i < kSections; ++i)
      if (at_left <= at_right) {  // beyond speeds that are not allowed no others are
        b = right, right = left, at_right = at_left;
        at_left = least(std::exp(left = b - kShare * (b - a)));
      } else {
        a = left, left = right, at_left = at_right;
        at_right = least(std::exp(right = a + kShare * (b - a)));
      }
    least(from);
    least(to);
  }

  // The lowest speed and feed as long as nothing is found.
  const SpeedAndFeed& best() const { return best_; }

 private:
  ConditionsTrial trial(double vc, double f) const { return trial_({vc, f}); }
  static double objective(const ConditionsTrial& t) { return t.of_time + t.of_edges; }

  // The best feed of a speed if no limit counted, Eq. (1).
  double wanted_feed(double vc) const {
    const auto [lowest, highest] = window_.f_mm_rev;
    const double y = window_.life_feed;
    if (!(lowest < highest && y > 1)) return highest;
    const auto slow = trial(vc, lowest), fast = trial(vc, highest);
    const double A = (slow.of_time - fast.of_time) / (1 / lowest - 1 / highest);
    const double B = slow.of_edges / std::pow(lowest, y - 1);
    if (!(B > 0)) return highest;  // edges cost nothing
    return std::clamp(std::pow(A / ((y - 1) * B), 1 / y), lowest, highest);
  }

  double largest_allowed(double vc, double allowed, double wanted) const {
    if (trial(vc, wanted).feasible) return wanted;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (allowed + wanted) / 2;
      (trial(vc, middle).feasible ? allowed : wanted) = middle;
    }
    return allowed;
  }

  // The least objective of a speed.
  double least(double vc) {
    const double lowest = window_.f_mm_rev.lower;
    if (!trial(vc, lowest).feasible) return INFINITY;
    const double f = largest_allowed(vc, lowest, wanted_feed(vc));
    const double value = objective(trial(vc, f));
    if (value < least_) {
      least_ = value;
      best_ = {vc, f};
    }
    return value;
  }

  const ConditionsWindow& window_;
  const Trial& trial_;
  double least_ = INFINITY;
  SpeedAndFeed best_ = {window_.vc_m_min.lower, window_.f_mm_rev.lower};
};

}  // namespace

SpeedAndFeed best_conditions(const ConditionsWindow& window, std::vector<double> breaks,
                             const Trial& trial) {
  const double lowest = window.vc_m_min.lower, highest = window.vc_m_min.upper;
  Search search(window, trial);
  if (search.unlimited()) return search.best();
  if (!trial(search.best()).feasible) return search.best();  // the lowest speed and feed
  std::erase_if(breaks, [&](double v) { return v <= lowest || v >= highest; });
  breaks.push_back(highest);
  std::sort(breaks.begin(), breaks.end());
  double from = lowest;
  for (const double to : breaks) {
    search.section(from, to);
    from = to;
  }
  return search.best();
}

}  // namespace turnwright::planning
