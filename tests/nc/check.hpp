#pragma once
#include <fmt/format.h>

#include <map>

#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "removal.hpp"
#include "sizes.hpp"
#include "ways.hpp"

/// Whether ways of tools, wherever they come from, make the part of a plan with the
/// plan's conditions.
namespace turnwright::nc::test {

class Check : private Sizes {
 public:
  explicit Check(const Planned& p)
      : Sizes(p),
        outer_(-kBeside, length() + kBeside, p.part.drawing.stock.outer_mm / 2),
        inner_(-kBeside, length() + kBeside, -p.part.drawing.stock.inner_mm / 2) {
    const auto& stock = p.part.drawing.stock;
    for (std::size_t i = 0; i < outer_.size(); ++i)
      if (outer_.z(i) < -stock.left_allowance_mm - 1e-9 ||
          outer_.z(i) > stock.length_mm - stock.left_allowance_mm + 1e-9)
        outer_.remove(i);
    put_outline(stock);
    remove_gone();
  }

  void setup(std::size_t s, const std::vector<Way>& ways) {
    setup_ = s;
    left_ = p_.part.setups[s].hold == part::End::left;
    for (const auto& way : ways) follow(way);
  }

  /// The contour against the drawing with the plan's corrections, all setups done.
  void contour() {
    const auto& d = p_.part.drawing;
    contour(outer_, 1, d.outer);
    contour(inner_, -1, d.inner);
    for (const auto& e : d.outer) thread(e, 1);
    for (const auto& e : d.inner) thread(e, -1);
    for (const double z : {-0.02, length() + 0.02})
      if (faced(z < 0) && std::isfinite(at(outer_, z)))
        fault(fmt::format("the face at {:.2f} is not made", z));
  }

  const Faults& faults() const { return faults_; }

 private:
  // The outline of a casting or forging at its largest.
  void put_outline(const part::Stock& stock) {
    double from = -stock.left_allowance_mm;
    for (const auto& piece : stock.outline) {
      const double slope = (piece.right_mm - piece.left_mm) / piece.length_mm;
      for (std::size_t i = 0; i < outer_.size(); ++i)
        if (const double by = outer_.z(i) - from; by >= 0 && by <= piece.length_mm)
          outer_.put(i, (piece.left_mm + slope * by + stock.outline_limits.upper_mm) / 2);
      from += piece.length_mm;
    }
  }
  static constexpr double kBeside = 3, kTolerance = 1e-4, kWall = 1e3;

  void fault(const std::string& text) {
    if (faults_.size() < 20) faults_.push_back(text);
  }
  static double at(const Material& m, double z) {
    return m[static_cast<std::size_t>(std::lround((z - m.z(0)) / kGrid_mm))];
  }
  const planning::OperationPlan* operation(const std::string& id) const {
    for (const auto& o : p_.plan.setups[setup_].operations)
      if (o.id == id) return &o;
    return nullptr;
  }

  struct Tool {
    Outline outline;
    bool inner = false, drill = false, thread = false;
    double D = 0, point = 0;
    double slope = 0;  ///< of a countersink
  };
  Tool tool(const planning::OperationPlan& o) const {
    const auto e = part::extent(p_.part.drawing, o.on[0]);
    const bool inner = e && e->inner;
    for (const auto& t : p_.part.tools)
      if (t.id == o.tool)
        return {{t.re_mm, t.minor_kapr_deg * M_PI / 180, 0},
                t.bar.has_value(),
                false,
                false,
                0,
                0};
    for (const auto& t : p_.part.fixed_tools) {
      if (t.id != o.tool) continue;
      using enum catalogue::FixedUse;
      if (t.use == centring || t.use == drilling)
        return {{},
                true,
                true,
                false,
                2 * o.passes[0].ap_mm,
                t.use == centring
                    ? catalogue::tip_depth_mm(t, 2 * o.passes[0].ap_mm)
                    : o.passes[0].ap_mm / std::tan(t.point_deg * M_PI / 360)};
      if (t.use == countersinking) return countersink(o, t);
      if (t.use == counterboring || t.use == reaming || t.use == tapping)
        return behind_lead(o, t);
      if (t.use == grooving || t.use == parting)
        return {{0, 0, o.passes[0].ap_mm}, inner, false, false, 0, 0};
      if (t.use == threading) return {{0, M_PI / 3, 0, 1.5}, inner, false, true, 0, 0};
      if (t.use == knurling) return {{0, 0, o.passes[0].ap_mm}, inner, false, true, 0, 0};
      return {{t.re_mm, part::kProfilingClears_rad, 0, 4}, inner, false, false, 0, 0};
    }
    return {};
  }

  Tool countersink(const planning::OperationPlan& o,
                   const catalogue::FixedTool& t) const {
    const auto& inner = p_.part.drawing.inner;
    const auto& e = *std::ranges::find(inner, o.on[0], &part::InnerElement::id);
    const bool left_is_free = p_.part.setups[setup_].hold == part::End::right;
    const auto& c = left_is_free ? e.left_chamfer : e.right_chamfer;
    const double D = e.left_mm + 2 * c->radial_mm;
    return {{},
            true,
            true,
            false,
            *std::ranges::lower_bound(t.sizes_mm, D),
            0,
            std::tan(t.point_deg * M_PI / 360)};
  }

  // A reamer or a tap: like a drill whose point is as long as the lead.
  Tool behind_lead(const planning::OperationPlan& o,
                   const catalogue::FixedTool& t) const {
    const auto& inner = p_.part.drawing.inner;
    const auto& e = *std::ranges::find(inner, o.on[0], &part::InnerElement::id);
    const bool taps = t.use == catalogue::FixedUse::tapping;
    return {{},
            true,
            true,
            taps,
            taps ? 0 : e.left_mm,
            taps ? t.lead * e.cut->pitch_mm : t.lead};
  }

  void conditions(const Way& w, const planning::OperationPlan& o) {
    const auto& p = o.passes[0];
    if (!(std::abs(w.f_mm_rev - p.f_mm_rev) <= 1.001e-4) ||
        w.f_mm_rev > p.f_mm_rev * (1 + 1e-9))
      fault(fmt::format("{}: feed {} where {} is planned", o.id, w.f_mm_rev, p.f_mm_rev));
    const auto& m = p_.part.machine;
    const bool chuck =
        p_.plan.setups[setup_].clamping != planning::Clamping::between_centres;
    const double most = chuck ? std::min(m.n_max_rpm, m.chuck.n_max_rpm) : m.n_max_rpm;
    if (w.n_max_rpm == 0) {
      if (!(std::abs(w.S - p.n_rpm) <= 0.02) || !(w.S <= most))
        fault(fmt::format("{}: {} 1/min where {} are planned", o.id, w.S, p.n_rpm));
      if (o.kind != planning::OperationKind::fixed)
        fault(o.id + ": without constant surface speed");
      return;
    }
    if (!(std::abs(w.S - p.vc_m_min) <= 0.0101))
      fault(fmt::format("{}: {} m/min where {} are planned", o.id, w.S, p.vc_m_min));
    double n = 0;
    for (const auto& pass : o.passes) n = std::max(n, pass.n_rpm);
    if (!(w.n_max_rpm <= most && w.n_max_rpm >= std::floor(n)))
      fault(fmt::format("{}: spindle limit {} where {} are planned and {} allowed", o.id,
                        w.n_max_rpm, n, most));
  }

  void follow(const Way& w) {
    const auto* o = operation(w.operation);
    if (!o) return fault("no operation " + w.operation);
    const auto t = tool(*o);
    if (!w.rapid) conditions(w, *o);
    const auto frame = [&](double z) { return left_ ? z - length() : -z; };
    if (t.drill && t.thread) return tapped(*o, w, t.point);
    if (t.drill) {
      if (w.x0 == 0 && w.x1 == 0 && !w.rapid && t.slope > 0)
        inner_.countersink(t.slope, t.D, std::min(w.z0, w.z1), frame);
      else if (w.x0 == 0 && w.x1 == 0 && !w.rapid)
        inner_.drill(t.D, std::min(w.z0, w.z1) + t.point, frame);
      return;
    }
    const double root = left_
                            ? planning::root_z_mm(p_.part, setup_, clamping()) - length()
                            : -planning::root_z_mm(p_.part, setup_, clamping());
    if (!t.inner && std::min(w.z0, w.z1) < root - 1e-4)
      fault(fmt::format("{}: into the jaws at Z{}", w.operation, std::min(w.z0, w.z1)));
    auto& m = t.inner ? inner_ : outer_;
    const double sign = t.inner ? -1 : 1;
    if (w.thread) {
      threads_[o->on[0]] =
          std::min(threads_.contains(o->on[0]) ? threads_[o->on[0]] : 1e9, sign * w.x1);
      return;
    }
    if (w.rapid) {
      const double taken =
          m.would_cut(t.outline, frame, sign * w.x0, w.z0, sign * w.x1, w.z1);
      if (taken > 2e-4 && !t.thread)
        fault(fmt::format("{}: rapid from X{} Z{} to X{} Z{} cuts {} mm", w.operation,
                          w.x0, w.z0, w.x1, w.z1, taken));
      return;
    }
    if (t.thread) {  // a knurl is pressed
      auto& deepest = threads_.emplace(o->on[0], w.x1).first->second;
      deepest = std::min(deepest, w.x1);
      return;
    }
    m.cut(t.outline, frame, sign * w.x0, w.z0, sign * w.x1, w.z1);
    remove_gone();
  }

  // The whole thread passes the element's end.
  void tapped(const planning::OperationPlan& o, const Way& w, double lead) {
    if (!w.thread) return;
    const auto e = *part::extent(p_.part.drawing, o.on[0]);
    const double end = left_ ? e.z0_mm - length() : -e.z1_mm;
    const auto& inner = p_.part.drawing.inner;
    const auto& cut = std::ranges::find(inner, o.on[0], &part::InnerElement::id)->cut;
    if (w.x0 != 0 || w.x1 != 0 || w.f_mm_rev != cut->pitch_mm)
      return fault(o.id + ": a tap off the axis or with another lead");
    if (std::abs(w.z1 + lead - end) < kTolerance)
      threads_[o.on[0]] = -cut->drawn.left_mm / 2;
  }

  template <class Element>
  void thread(const Element& e, double sign) {
    if (!e.cut ||
        (e.cut->kind != part::CutKind::thread && e.cut->kind != part::CutKind::knurl))
      return;
    const double root = sign * e.cut->core.left_mm / 2;
    if (!threads_.contains(e.id) || !(std::abs(threads_[e.id] - root) <= kTolerance))
      fault(e.id + ": its thread or knurl is not made to its depth");
  }

  // Where no wall is left between outside and hole, what lies outwards falls off.
  void remove_gone() {
    const auto gone = [&](std::size_t i) { return outer_[i] <= -inner_[i] + 1e-9; };
    for (std::size_t i = 0; i < outer_.size(); ++i) {
      if (!gone(i)) continue;
      const bool left = outer_.z(i) < length() / 2;
      for (std::size_t k = left ? 0 : i; k < (left ? i + 1 : outer_.size()); ++k) {
        outer_.remove(k);
        inner_.remove(k);
      }
      if (!left) break;
    }
  }

  planning::Clamping clamping() const { return p_.plan.setups[setup_].clamping; }

  // Height of an element at a share of its length, with its chamfers.
  template <class Element>
  double height(double sign, const Element& e, double u, double z) const {
    const auto [from, to] = straight(e);
    const double z0 = z - u * e.length_mm;
    return sign * (drawn(e, u) + correction(e.id, std::clamp(z, z0 + from, z0 + to))) -
           part::chamfered_mm(e, u * e.length_mm) - undercut(e, u * e.length_mm);
  }

  // Drawn height at a place, or if it is at an edge the highest beside it.
  template <class Element>
  double height(double sign, const std::vector<Element>& all, double z) const {
    const bool through = z < 0 || z > length();
    double h = sign > 0 || through ? -INFINITY : -p_.part.drawing.stock.inner_mm / 2;
    bool made = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double u = (z - begin(all[k], k)) / all[k].length_mm;
      if (u < -1e-9 || u > 1 + 1e-9) continue;
      const double own = height(sign, all[k], std::clamp(u, 0.0, 1.0), z);
      h = made ? std::max(h, own) : own;
      made = true;
    }
    return h;
  }

  // Of the largest corner that the plan turns a side with.
  double corner_mm(bool inner) const {
    double r = 0;
    for (const auto& s : p_.plan.setups)
      for (const auto& o : s.operations) {
        const auto t = tool(o);
        if (t.inner == inner && !t.drill) r = std::max(r, t.outline.re_mm);
      }
    return r;
  }

  // What a corner that rolls over the contour cannot take off.
  static std::vector<double> rolled(const std::vector<double>& contour, double r) {
    const auto n = static_cast<std::ptrdiff_t>(contour.size());
    const auto reach = static_cast<std::ptrdiff_t>(r / kGrid_mm);
    std::vector<double> rise;
    for (std::ptrdiff_t k = 0; k <= reach; ++k)
      rise.push_back(std::sqrt(r * r - std::pow(kGrid_mm * static_cast<double>(k), 2)));
    const auto sweep = [&](const std::vector<double>& from, double sign) {
      std::vector<double> to(from.size(), -INFINITY);
      for (std::ptrdiff_t i = 0; i < n; ++i)
        for (std::ptrdiff_t k = std::max(i - reach, std::ptrdiff_t{0});
             k <= std::min(i + reach, n - 1); ++k)
          to[static_cast<std::size_t>(i)] =
              std::max(to[static_cast<std::size_t>(i)],
                       sign * from[static_cast<std::size_t>(k)] +
                           rise[static_cast<std::size_t>(std::abs(i - k))]);
      for (double& h : to) h *= sign;
      return to;
    };
    return sweep(sweep(contour, 1), -1);
  }

  template <class Element>
  void contour(const Material& m, double sign, const std::vector<Element>& all) {
    const double r = corner_mm(sign < 0);
    std::vector<double> drawn_here;
    for (std::size_t i = 0; i < m.size(); ++i)
      drawn_here.push_back(height(sign, all, m.z(i)));
    const double hole = p_.part.drawing.stock.inner_mm / 2;
    for (std::size_t i = 0; sign < 0 && hole > 0 && i < m.size(); ++i)
      if (m.z(i) > 0.05 && m.z(i) < length() - 0.05 && drawn_here[i] == -hole &&
          m[i] < -hole - kTolerance)
        return fault(fmt::format("the tube's hole is cut at {:.2f}", m.z(i)));
    for (std::size_t k = 0; k < all.size(); ++k) {
      // A wall counts as high, however low it is, and what falls as level: the corner stays
      // on the element's own line.
      const double z0 = begin(all[k], k), z1 = z0 + all[k].length_mm;
      const auto beside = [&](double z, double beyond) -> std::optional<double> {
        const double own = height(sign, all, 2 * z - beyond);
        const double step = height(sign, all, beyond) - own;
        if (std::abs(step) < 1e-3) return std::nullopt;
        return step > 0 ? kWall : own;
      };
      const auto left = beside(z0, z0 - 1e-5), right = beside(z1, z1 + 1e-5);
      auto walled = drawn_here;
      for (std::size_t i = 0; i < m.size(); ++i) {
        if (left && m.z(i) < z0) walled[i] = std::max(walled[i], *left);
        if (right && m.z(i) > z1) walled[i] = std::max(walled[i], *right);
      }
      element(m, sign, all, k, rolled(walled, r));
    }
  }

  // How far undercuts of the elements beside element k go into it, at its left and
  // its right end: there a height above the axis says nothing.
  template <class Element>
  static std::pair<double, double> recesses(const std::vector<Element>& all,
                                            std::size_t k) {
    std::pair<double, double> both{0, 0};
    if constexpr (requires { all[k].left_undercut; }) {
      if (k > 0 && all[k - 1].right_undercut)
        both.first = all[k - 1].right_undercut->recess_mm + kGrid_mm;
      if (k + 1 < all.size() && all[k + 1].left_undercut)
        both.second = all[k + 1].left_undercut->recess_mm + kGrid_mm;
    }
    return both;
  }

  template <class Element>
  void element(const Material& m, double sign, const std::vector<Element>& all,
               std::size_t k, const std::vector<double>& left) {
    const auto& e = all[k];
    const auto [from, to] = recesses(all, k);
    const double L = e.length_mm, left_z = begin(e, k), step = 1e-6;
    double low = 0, high = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
      const double z = m.z(i) - left_z;
      if (!(z > 1e-6 && z < L - 1e-6) || z < from || z > L - to) continue;
      const double u0 = std::max(0.0, z / L - step), u1 = std::min(1.0, z / L + step);
      const auto at = [&](double u) { return height(sign, e, u, m.z(i)); };
      const double slope = (at(u1) - at(u0)) / (u1 - u0) / L;
      const double steep = std::sqrt(1 + slope * slope);
      const double contour = at(z / L);
      // An edge to what another setup makes may break by the step of the corrections.
      if (!corrected(e.id) || std::min(z, L - z) > 0.05)
        low = std::min(low, (m[i] - contour) / steep);
      const double allowed = std::max({left[i - 1], left[i], left[i + 1]});
      high = std::max(high, (m[i] - allowed) / steep);
    }
    // Radii of corrections are rounded to half the last decimal of a diameter.
    const double tolerance = kTolerance + (corrected(e.id) ? 0.25e-3 : 0);
    if (!(low >= -tolerance) || !(high <= tolerance))
      fault(fmt::format("{}: from {:.5f} to {:.5f} mm off its contour", e.id, low, high));
  }

  std::size_t setup_ = 0;
  bool left_ = true;
  Material outer_, inner_;
  std::map<std::string, double> threads_;
  Faults faults_;
};

}  // namespace turnwright::nc::test
