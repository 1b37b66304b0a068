#include <algorithm>
#include <cmath>

#include "machined_surface.hpp"
#include "planning/budget/uncertain_limits.hpp"
#include "planning/operation/bar_tip.hpp"
#include "planning/operation/chebyshev.hpp"
#include "planning/operation/evaluate.hpp"

namespace turnwright::planning {
namespace {

constexpr int kPlaces = 33;
constexpr double kNearWorst = 0.9;  // of the largest: may be the largest at another depth
constexpr int kParts = 4;           // of the ranges of depth and feed

// Divisor of a static compliance that gives the compliance of regeneration at any speed.
double damped(const PreparedPart& p, double zeta) {
  return 2 * zeta * (1 + zeta) * p.chatter_times * chatter_factor(p);
}

double largest(const std::vector<double>& c) {
  return *std::max_element(c.begin(), c.end());
}

// An upper bound of the gain over the operation's depths and feeds, where the radial
// compliance is at most C_ww.
double most_gain(const OperationModel& o, const catalogue::Range& a, double ww_mm_N) {
  using L = LogDual<2>;
  const auto [low, high] = std::minmax({o.depth_mm(a.lower), o.depth_mm(a.upper)});
  const Interval depth(std::log(low), std::log(high));
  const Interval feed(std::log(o.f.lower), std::log(o.f.upper));
  const auto part = [](const Interval& x, int k) {
    const double h = width(x) / kParts;
    return Interval(x.lo + h * k, k + 1 < kParts ? x.lo + h * (k + 1) : x.hi);
  };
  double most = 0;
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; j < kParts; ++j) {
      const Interval y = part(depth, i), z = part(feed, j);
      const L::Half half{width(y) / 2, width(z) / 2};
      const L ap = L::variable(y, 0, half), f = L::variable(z, 1, half);
      const auto K = cutting::chatter_stiffnesses_N_mm(o.cut, ap, f);
      const double along =
          K.zz.v.hi * o.chatter_zz_mm_N +
          2 * std::max(K.wz.v.hi, -K.wz.v.lo) * std::abs(o.chatter_wz_mm_N);
      most = std::max(
          most, std::max(K.ww.v.hi, -o.chatter_inwards * K.ww.v.lo) * ww_mm_N + along);
    }
  return most;
}

// Whether p >= q everywhere.
bool covers(const Polynomial& p, const Polynomial& q) {
  double least = 0;
  for (std::size_t k = 0; k < std::max(p.c.size(), q.c.size()); ++k) {
    const double d = (k < p.c.size() ? p.c[k] : 0) - (k < q.c.size() ? q.c[k] : 0);
    least += k == 0 ? d : -std::abs(d);
  }
  return least >= 0;
}

// Adds a position unless an existing one dominates it; removes those that it dominates.
void add_place(double at_mm, Polynomial c, OperationModel& o) {
  auto& all = o.chatter_mm_N;
  if (std::any_of(all.begin(), all.end(), [&](auto& k) { return covers(k, c); })) return;
  for (std::size_t k = all.size(); k-- > 0;)
    if (covers(c, all[k])) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
      o.chatter_at_mm.erase(o.chatter_at_mm.begin() + static_cast<std::ptrdiff_t>(k));
    }
  all.push_back(std::move(c));
  o.chatter_at_mm.push_back(at_mm);
}

}  // namespace

// Error per passive force, each compliance divided by its 2 zeta (1 + zeta), at positions
// of a pass.  What a body yields more than one that is all but rigid is its bending.
std::vector<double> MachinedSurface::chatter_yields(
    const OperationModel& o, double left_mm, double uncut_mm,
    const std::vector<double>& places) const {
  const auto& m = plan_->machine;
  const double work = 1 / damped(*plan_, plan_->damping_ratio),
               machine = 1 / damped(*plan_, plan_->machine_damping_ratio);
  const bool alike = plan_->damping_ratio == plan_->machine_damping_ratio;
  const auto together = [&](double whole, double rigid) {
    return work * (whole - rigid) + machine * rigid;
  };
  std::vector<double> c(places.size());
  if (is_face()) {
    const auto body = bodies_[0].shaft(), stiff = stiffer(body);
    std::vector<deflection::Flexibility> r(1), t(1);
    yields(body, body, bodies_[0], {face_x_}, r, t);
    auto s = r;
    if (!alike) yields(stiff, stiff, bodies_[0], {face_x_}, s, t);
    const BarTip tip = by_bar() ? tip_of(*o.tool->bar) : BarTip{};
    const double bar = by_bar() ? (tip.z + tip.a) * of_bar(o) : 0;
    for (std::size_t k = 0; k < c.size(); ++k)
      c[k] = together(r[0].f_pp_rad_Nmm, s[0].f_pp_rad_Nmm) * sqr(places[k]) +
             machine * axial_mm_N() + bar;
    return c;
  }
  std::vector<double> x(places.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = x_mm(o, places[k]);
  std::vector<deflection::Flexibility> r(x.size()), t(x.size());
  yields(o, left_mm, uncut_mm, x, r, t);
  auto s = r;
  if (!alike) yields(o, left_mm, uncut_mm, x, s, t, true);
  const double bar = by_bar() ? tip_of(*o.tool->bar).w * of_bar(o) : 0;
  for (std::size_t k = 0; k < c.size(); ++k)
    c[k] = together(r[k].f_ww_mm_N, s[k].f_ww_mm_N) + machine * m.tool_rr_mm_N + bar;
  return c;
}

// Share of a bar's static compliances that counts.
double MachinedSurface::of_bar(const OperationModel& o) const {
  const auto& zeta = o.tool->bar->damping_ratio;
  return 1 / damped(*plan_, zeta.value_or(plan_->machine_damping_ratio));
}

// C_zz and C_wz of (1).
void MachinedSurface::yield_along_feed(OperationModel& o) const {
  const auto& m = plan_->machine;
  const double machine = 1 / damped(*plan_, plan_->machine_damping_ratio);
  if (m.tool_zz_mm_N)
    o.chatter_zz_mm_N =
        machine * (is_face() ? m.tool_rr_mm_N : *m.tool_zz_mm_N + axial_mm_N());
  if (!by_bar()) return;
  const auto bar = tip_of(*o.tool->bar);
  o.chatter_zz_mm_N += of_bar(o) * (is_face() ? bar.w : bar.z);
  o.chatter_wz_mm_N = -(is_face() ? 1 : feed_sign(o)) * of_bar(o) * bar.p;
}

std::vector<double> MachinedSurface::last_yields(
    const OperationModel& o, double a_mm, const std::vector<double>& places) const {
  const double left = o.passes.back().left_mm(a_mm);
  return chatter_yields(o, left, left + o.depth_mm(a_mm), places);
}

std::vector<double> MachinedSurface::chatter_places() const {
  const double high = is_face() ? D_large_ / 2 : high_;
  std::vector<double> places;
  for (int k = 0; k < kPlaces; ++k)
    places.push_back(low_ + (high - low_) * k / (kPlaces - 1));
  return places;
}

std::vector<double> MachinedSurface::chatter_limits_N_mm(const Chain& chain,
                                                         double a_mm) const {
  std::vector<double> limits;
  for (const auto& o : chain.operations)
    limits.push_back(1 / largest(last_yields(o, a_mm, chatter_places())));
  return limits;
}

double MachinedSurface::chatter_share(const Chain& chain, const Choice<double>& c) const {
  const auto limits = chatter_limits_N_mm(chain, c.a);
  double most = 0;
  for (std::size_t i = 0; i < limits.size(); ++i)
    most = std::max(most, chatter_gain(chain.operations[i], c.f[i], c.a, 1 / limits[i]));
  return most;
}

void MachinedSurface::limit_chatter_alike(const Chain& other, double a_mm,
                                          Chain& chain) const {
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    auto& o = chain.operations[i];
    o.chatter_at_mm = other.operations[i].chatter_at_mm;
    o.chatter_mm_N.clear();
    if (o.chatter_at_mm.empty()) continue;
    for (const double c : last_yields(o, a_mm, o.chatter_at_mm))
      o.chatter_mm_N.push_back({0, 1, {c}});
  }
}

// More material never makes a body yield more, so the finished body bounds every pass,
// and the last pass of an operation is the worst.
void MachinedSurface::limit_chatter(Chain& chain, std::optional<double> a_mm) const {
  const catalogue::Range a{a_mm.value_or(chain.a.lower), a_mm.value_or(chain.a.upper)};
  const double centre = (a.lower + a.upper) / 2, half = (a.upper - a.lower) / 2;
  const auto places = chatter_places();
  for (auto& o : chain.operations) {
    if (most_gain(o, a, largest(chatter_yields(o, 0, 0, places))) < 1) continue;
    if (!(half > 0) || is_face()) {
      const auto c = last_yields(o, centre, places);
      for (std::size_t k = 0; k < c.size(); ++k) add_place(places[k], {0, 1, {c[k]}}, o);
      continue;
    }
    std::vector<double> some;
    std::vector<bool> near(places.size(), false);
    for (const double depth : {a.lower, centre, a.upper}) {
      const auto c = last_yields(o, depth, places);
      for (std::size_t k = 0; k < c.size(); ++k)
        if (c[k] >= kNearWorst * largest(c)) near[k] = true;
    }
    for (std::size_t k = 0; k < places.size(); ++k)
      if (near[k]) some.push_back(places[k]);
    const Eigen::MatrixXd c = following([&](double u) {
      const auto all = last_yields(o, centre + half * u, some);
      return Eigen::VectorXd(
          Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size())));
    });
    for (std::size_t k = 0; k < some.size(); ++k)
      add_place(some[k], polynomial(c.col(static_cast<Eigen::Index>(k)), centre, half),
                o);
  }
}

}  // namespace turnwright::planning
