#include "machined_surface.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "planning/budget/uncertain_limits.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/clamping/clamping_speed.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/clamping/supports.hpp"
#include "planning/operation/bar_tip.hpp"
#include "planning/operation/chebyshev.hpp"
#include "planning/operation/evaluate.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "turnwright/deflection/rest.hpp"
#include "turnwright/deflection/thrust.hpp"

namespace turnwright::planning {
namespace {

constexpr int kTable = 33;  // places of a correction

// Pieces of equal length through exact values at Chebyshev points.
tolerance::PiecewisePolynomial through_exact(
    double low, double high, int pieces, std::size_t points,
    const std::function<std::vector<double>(const std::vector<double>&)>& errors) {
  const double h = (high - low) / pieces;
  std::vector<double> u, places;  // the points of a piece, on [0, 1]
  for (const double t : chebyshev(points)) u.push_back((1 - t) / 2);
  for (int k = 0; k < pieces; ++k)
    for (const double t : u) places.push_back(low + h * (k + t));
  const auto e = errors(places);
  tolerance::PiecewisePolynomial result;
  result.breaks_mm.push_back(low);
  for (int k = 0; k < pieces; ++k) {
    Eigen::MatrixXd values(static_cast<Eigen::Index>(points), 1);
    for (std::size_t i = 0; i < points; ++i)
      values(static_cast<Eigen::Index>(i), 0) =
          e[static_cast<std::size_t>(k) * points + i];
    const Eigen::MatrixXd c = through(u, values);
    std::vector<double> s;
    for (Eigen::Index j = 0; j < c.rows(); ++j)
      s.push_back(c(j, 0) / std::pow(h, static_cast<double>(j)));
    result.coefficients.push_back(std::move(s));
    result.breaks_mm.push_back(low + h * (k + 1));
  }
  return result;
}

// What stands when the elements before the one at `place` have been made.
Finished with(Finished finished, const std::vector<std::size_t>& elements,
              std::size_t place, std::vector<bool> Finished::*which) {
  for (std::size_t k = 0; k < place; ++k) (finished.*which)[elements[k]] = true;
  return finished;
}

std::size_t place_of(const std::vector<std::size_t>& elements, std::size_t index) {
  return static_cast<std::size_t>(std::find(elements.begin(), elements.end(), index) -
                                  elements.begin());
}

// Of everything that bends, by the thrust on the body as the setup leaves it, its most
// slender one.
double amplification(const PreparedPart& p, Clamping clamping, const SetupBody& body) {
  const double P = p.machine.tail_thrust_N;
  if (!has_tailstock(clamping) || !(P > 0)) return 1;
  return deflection::thrust_amplification(
      P, deflection::critical_thrust_N(body.shaft(), planes(p.machine, clamping).radial));
}

catalogue::Range overlap(const catalogue::Range& a, const catalogue::Range& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

// Eq. (2).
void face_outwards(const catalogue::Tool& tool, cutting::Cut& cut) {
  cut.corner =
      cutting::corner_of(tool.re_mm, units::rad_from_deg(90 + tool.minor_kapr_deg));
  cut.minor_kapr_rad = units::rad_from_deg(tool.kapr_deg - 90);
}

const part::Face* find_face(const PreparedPart& p, const std::string& id) {
  for (const auto& f : p.drawing.faces)
    if (f.id == id) return &f;
  return nullptr;
}

}  // namespace

MachinedSurface::MachinedSurface(const PreparedPart& plan, std::size_t setup,
                                 Clamping clamping, Kind kind, std::string surface,
                                 const GivenConditions& fixed)
    : plan_(&plan),
      setup_(setup),
      clamping_(clamping),
      kind_(kind),
      surface_(std::move(surface)),
      fixed_(fixed) {
  if (const auto* face = find_face(plan, surface_)) {
    Ra_um_ = face->Ra_um.value_or(0);
    Rz_um_ = face->Rz_um.value_or(0);
  }
}

MachinedSurface MachinedSurface::element(const PreparedPart& plan, std::size_t setup,
                                         Clamping clamping, const SetupWork& work,
                                         const Finished& before, std::size_t index,
                                         const GivenConditions& fixed) {
  const auto& e = plan.drawing.outer[index];
  MachinedSurface f(plan, setup, clamping, Kind::element, e.id, fixed);
  f.take(e, index, part::left_z_mm(plan.drawing, index));
  f.around_ = surroundings(plan, setup, clamping, work, {false, index});
  f.take_wall();
  const auto level = f.around_.level_behind;
  f.goes_on_ = e.cut || (level && !before.outer[*level]);
  const auto stock = part::stock_of(plan.drawing, index);
  f.stock_ = (stock.most_mm - f.D_small_) / 2;
  if (!plan.drawing.stock.outline.empty())
    f.everywhere_mm_ = (stock.least_mm - f.D_large_) / 2;
  for (const auto place : {place_of(work.elements, index), work.elements.size()})
    f.bodies_.emplace_back(plan, setup, clamping,
                           with(before, work.elements, place, &Finished::outer));
  f.amplification_ = amplification(plan, clamping, f.bodies_.back());
  return f;
}

MachinedSurface MachinedSurface::bore(const PreparedPart& plan, std::size_t setup,
                                      Clamping clamping, const SetupWork& work,
                                      const Finished& before, std::size_t index,
                                      const GivenConditions& fixed) {
  const auto& e = plan.drawing.inner[index];
  MachinedSurface f(plan, setup, clamping, Kind::bore, e.id, fixed);
  f.take(e, index, part::inner_left_z_mm(plan.drawing, index));
  f.around_ = surroundings(plan, setup, clamping, work, {true, index});
  f.take_wall();
  f.hole_mm_ = hole_mm(plan, index);
  f.stock_ = (f.D_large_ - f.hole_mm_) / 2;
  f.depth_mm_ =
      e.from == part::End::left ? f.high_ : part::length_mm(plan.drawing) - f.low_;
  // Bores come after everything outside.
  const auto outside =
      with(before, work.elements, work.elements.size(), &Finished::outer);
  for (const auto place : {place_of(work.bores, index), work.bores.size()})
    f.bodies_.emplace_back(plan, setup, clamping,
                           with(outside, work.bores, place, &Finished::inner));
  return f;
}

MachinedSurface MachinedSurface::end_face(const PreparedPart& plan, std::size_t setup,
                                          const Finished& before,
                                          const GivenConditions& fixed) {
  const bool left = plan.setups[setup].hold == part::End::right;
  MachinedSurface f(plan, setup, Clamping::chuck, Kind::end_face, left ? "left" : "right",
                    fixed);
  f.bodies_.emplace_back(plan, setup, Clamping::chuck, before);
  f.face_x_ = f.bodies_[0].length_mm();
  f.stock_ = face_stock_mm(plan, left ? part::End::left : part::End::right);
  f.D_small_ = plan.drawing.stock.inner_mm;
  f.D_large_ = end_stock_mm(plan, setup);
  // The face of the finished part ends at its outermost element.
  const auto& outer = plan.drawing.outer;
  f.low_ = free_bore_mm(plan, setup) / 2;
  f.high_ = (left ? outer.front().left_mm : outer.back().right_mm) / 2;
  return f;
}

MachinedSurface MachinedSurface::shoulder(const PreparedPart& plan, std::size_t setup,
                                          Clamping clamping, const SetupWork& work,
                                          const Finished& before, std::size_t index,
                                          const GivenConditions& fixed) {
  const auto& outer = plan.drawing.outer;
  MachinedSurface f(plan, setup, clamping, Kind::shoulder,
                    outer[index - 1].id + "|" + outer[index].id, fixed);
  f.bodies_.emplace_back(
      plan, setup, clamping,
      with(before, work.elements, work.elements.size(), &Finished::outer));
  f.amplification_ = amplification(plan, clamping, f.bodies_.back());
  // At the jaws themselves it may lie behind them by its last bits.
  f.face_x_ = std::max(0.0, f.bodies_[0].x_mm(part::left_z_mm(plan.drawing, index)));
  const std::size_t behind =
      outer[index - 1].right_mm > outer[index].left_mm ? index - 1 : index;
  f.take_shoulder(work, {false, index - 1 + index - behind}, {false, behind},
                  part::left_z_mm(plan.drawing, index), !before.outer[behind],
                  part::stock_of(plan.drawing, behind).most_mm);
  return f;
}

MachinedSurface MachinedSurface::inner_shoulder(const PreparedPart& plan,
                                                std::size_t setup, Clamping clamping,
                                                const SetupWork& work,
                                                const Finished& before, std::size_t wider,
                                                const GivenConditions& fixed) {
  const auto s = *part::shoulder_behind(plan.drawing, wider);
  MachinedSurface f(plan, setup, clamping, Kind::inner_shoulder, s.id, fixed);
  auto after = before;
  finish(after, work);
  f.bodies_.emplace_back(plan, setup, clamping, after);
  f.face_x_ = std::max(0.0, f.bodies_[0].x_mm(s.z_mm));
  f.take_shoulder(work, {true, wider}, {true, s.narrower}, s.z_mm,
                  !before.inner[s.narrower], hole_mm(plan, wider));
  f.depth_mm_ = -f.face_z_;
  f.around_.front = front_mm(plan, setup, work);
  return f;
}

// What a shoulder is between: the element that it stands behind, and the one whose edge
// it ends at, of the stock's diameter if no setup has made that yet.
void MachinedSurface::take_shoulder(const SetupWork& work, const Element& front,
                                    const Element& behind, double z, bool in_stock,
                                    double stock_mm) {
  const auto ring = *shoulder_ring(plan_->drawing, surface_);
  D_small_ = ring.small_mm;
  D_large_ = ring.large_mm;
  low_ = D_small_ / 2;
  high_ = D_large_ / 2;
  const bool stands = in_stock && !makes(work, behind);
  top_mm_ = (stands ? stock_mm : ring.inner ? D_small_ : D_large_) / 2;
  face_z_ = -std::abs(z - free_z_mm(*plan_, setup_));
  for (const auto& t : plan_->tools) around_.r_most = std::max(around_.r_most, t.re_mm);
  around_.fillet_mm = fillet_behind_mm(*plan_, setup_, front);
  around_.undercut = undercut_behind(*plan_, setup_, front);
  around_.wall_chamfer =
      makes(work, behind)
          ? part::Chamfer{}
          : front_chamfer(*plan_, setup_, behind).value_or(part::Chamfer{});
  around_.wall_in_stock = stands;
}

template <class OuterOrInner>
void MachinedSurface::take(const OuterOrInner& e, std::size_t index, double left_z_mm) {
  index_ = index;
  low_ = left_z_mm;
  high_ = left_z_mm + e.length_mm;
  double to_middle = 0;  // of the limits
  if (const auto* limits = turned_to_limits(plan_->drawing, e.id)) {
    const double half_width = (limits->upper_mm - limits->lower_mm) / 2;
    to_middle = (limits->lower_mm + limits->upper_mm) / 2;
    depth_slack_mm_ = std::max(std::abs(to_middle), half_width) / 2;
  }
  left_mm_ = e.left_mm + to_middle;
  right_mm_ = e.right_mm + to_middle;
  D_small_ = std::min(left_mm_, right_mm_);
  D_large_ = std::max(left_mm_, right_mm_);
  Ra_um_ = e.Ra_um.value_or(0);
  Rz_um_ = e.Rz_um.value_or(0);
}

// The wall that is made in one pass with an undercut, or with the bore before it.
const part::Face* MachinedSurface::own_wall() const {
  const auto& d = plan_->drawing;
  if (kind_ == Kind::bore) {
    const auto s = part::shoulder_behind(d, index_);
    return s && cut_with(d, s->id) == surface_ ? find_face(*plan_, s->id) : nullptr;
  }
  const std::size_t k = around_.mirrored ? index_ + 1 : index_;
  return around_.undercut ? find_face(*plan_, shoulder_id(d, k)) : nullptr;
}

// Such a wall is as smooth as the drawing asks.
void MachinedSurface::take_wall() {
  const auto* wall = own_wall();
  if (!wall) return;
  const auto smoother = [](double& own, const std::optional<double>& asked) {
    if (asked && !(own > 0 && own < *asked)) own = *asked;
  };
  smoother(Ra_um_, wall->Ra_um);
  smoother(Rz_um_, wall->Rz_um);
}

Holding MachinedSurface::holding() const {
  Holding h;
  h.n_max_rpm = clamping_rpm(*plan_, clamping_);
  if (clamping_ == Clamping::between_centres) return h;
  // End faces come first, before the jaws are eased.
  const bool eased = kind_ != Kind::end_face;
  h.roughing_N = jaw_force_N(*plan_, setup_, clamping_, Stage::roughing);
  h.finishing_N =
      jaw_force_N(*plan_, setup_, clamping_, eased ? Stage::finishing : Stage::roughing);
  h.d_grip_mm = grip_diameter_mm(*plan_, setup_, clamping_);
  return h;
}

OperationModel MachinedSurface::operation(const Recipe& recipe, bool finishing,
                                          const Economy& economy) const {
  const auto& tool = finishing ? *recipe.finish : *recipe.rough;
  const std::size_t range = finishing ? recipe.finish_range : recipe.rough_range;
  const auto& m = plan_->machine;
  const auto& want = finishing ? fixed_.finish : fixed_.rough;
  OperationModel o;
  o.tool = &tool;
  const auto& material = plan_->material;
  o.cut = cutting::cut_of(material, tool);
  if (kind_ == Kind::inner_shoulder) face_outwards(tool, o.cut);
  o.cut.hmin_mm *= roughness_factor(*plan_, material.hmin_uncertainty_pct);
  o.cut.land_Ra_um_mm *= roughness_factor(*plan_, material.land_Ra_uncertainty_pct);
  const auto& shop = plan_->shop;
  const bool finisher = finishing || !recipe.finish;
  if (shop.edge_wear_mm > 0 && (finisher ? due_.finish : due_.rough))
    o.cut = cutting::worn(o.cut, finisher ? shop.edge_wear_mm : shop.wear_land_mm,
                          shop.wear_land_mm);
  o.range = cutting::speed_ranges(m)[range];
  const Holding held = holding();
  const double force_N = finishing ? held.finishing_N : held.roughing_N;
  if (clamping_ != Clamping::between_centres)
    o.grip = {force_N, m.chuck.jaw_mass_radius_kg_m, m.chuck.friction, held.d_grip_mm};
  const double n_grip = grip_loss_rpm(*plan_, clamping_, force_N);
  o.n_cap_rpm = std::min({o.range.n_max_rpm, held.n_max_rpm, n_grip});
  o.n_cap_of_grip = o.n_cap_rpm == n_grip;
  o.n_min_rpm = o.range.n_min_rpm;
  o.feed_force_max_N = m.feed_force_max_N;
  o.economic_life_min = cutting::economic_life_min(
      o.cut, tool.change_min, economy.edge * tool.edge_cost / economy.minute);
  o.finishing = finishing;
  o.f_window = {
      tool.f_mm_rev.lower,
      std::min(tool.f_mm_rev.upper, 0.8 * tool.re_mm)};  // keeps the corner in the cut
  o.ap = {catalogue::least_depth_mm(tool), tool.ap_mm.upper};
  if (everywhere_mm_ && finisher)
    o.ap.upper = std::min(
        o.ap.upper,
        *everywhere_mm_ / (recipe.rough && recipe.finish ? recipe.finish_passes : 1));
  if (around_.undercut && (finishing || !recipe.finish))
    o.ap.upper -= around_.undercut->depth_mm;
  if (!tool.chip.empty()) {
    const auto& piece = tool.chip[finishing ? recipe.finish_piece : recipe.rough_piece];
    o.f_window = overlap(o.f_window, piece.f_mm_rev);
    o.ap = overlap(o.ap, piece.ap_mm);
    o.chip = piece.edges;
  }
  o.vc_window = tool.vc_m_min;
  o.f = o.f_window;
  o.vc = o.vc_window;
  if (want.f_mm_rev) o.f = {*want.f_mm_rev, *want.f_mm_rev};
  if (want.vc_m_min) o.vc = {*want.vc_m_min, *want.vc_m_min};
  o.T_min = tool.T_min;
  o.D_small_mm = D_small_;
  o.D_large_mm = D_large_;
  o.face = is_face();
  o.inner = kind_ == Kind::bore;
  o.least_D_mm = hole_mm_;
  double most = std::max(plan_->damping_ratio, plan_->machine_damping_ratio);
  if (by_bar()) most = std::max(most, tool.bar->damping_ratio.value_or(0));
  o.chatter_inwards = (1 + most) / (1 - most);
  yield_along_feed(o);
  o.tapered = o.face || D_small_ < D_large_;
  o.reaches_axis = o.face && !(D_small_ > 0);
  if (finisher) o.ring = ring(recipe, o);
  return o;
}

std::optional<Chain> MachinedSurface::chain(const Recipe& recipe, const Economy& economy,
                                            const std::vector<double>& stations,
                                            std::optional<double> a_mm) const {
  Chain c;
  c.weights = economy;
  const double nr = recipe.rough_passes, nf = recipe.finish_passes;
  double stock = stock_;
  const auto adds_up = [&](double given) {
    return std::abs(given - stock) <= depth_slack_mm_ + 1e-6 * stock;
  };
  if (recipe.rough) c.operations.push_back(operation(recipe, false, economy));
  if (recipe.finish) c.operations.push_back(operation(recipe, true, economy));
  for (const auto& o : c.operations)
    if (!(o.f.lower <= o.f.upper) || !enters(*o.tool))
      return {};  // no feed suits both corner and chip breaker
  if (!c.operations.empty()) {
    c.operations.back().Ra_um = Ra_um_;
    c.operations.back().Rz_um = Rz_um_;
  }
  if (!c.operations.empty() && !ends_before_jaws(*c.operations.back().tool)) return {};
  // The stock on a shoulder is taken as the least depth of cut of the tool that faces it.
  if (is_shoulder()) stock = c.operations.back().ap.lower;
  if (!(stock > 0)) return {};

  Affine rough, finish{0, 1};
  if (nr > 0 && nf > 0) {
    rough = {stock / nr, -nf / nr};
    const auto& ap = c.operations[1].ap;
    c.a = {0.95 * ap.lower, std::min(1.05 * ap.upper, stock / nf * 0.98)};
    if (fixed_.finish.ap_mm) c.a.lower = c.a.upper = *fixed_.finish.ap_mm;
    if (fixed_.rough.ap_mm)
      c.a.lower = c.a.upper = (stock - nr * *fixed_.rough.ap_mm) / nf;
    if (fixed_.finish.ap_mm && fixed_.rough.ap_mm &&
        !adds_up(nr * *fixed_.rough.ap_mm + nf * *fixed_.finish.ap_mm))
      return {};
    if (a_mm) c.a.lower = c.a.upper = *a_mm;
    if (!(c.a.lower > 0 && c.a.lower <= c.a.upper && c.a.upper * nf < stock)) return {};
    if (c.a.lower == c.a.upper) {
      rough = {rough(c.a.lower), 0};
      finish = {c.a.lower, 0};
    }
  } else {
    const double depth = stock / (nr + nf);
    const auto& want = nr > 0 ? fixed_.rough.ap_mm : fixed_.finish.ap_mm;
    if (want && !adds_up((nr + nf) * *want)) return {};
    rough = finish = {depth, 0};
    c.a.lower = c.a.upper = depth;
  }
  for (auto& o : c.operations) {
    o.depth_mm = o.finishing ? finish : rough;
    const int n = o.finishing ? recipe.finish_passes : recipe.rough_passes;
    for (int k = 1; k <= n; ++k) {  // what the passes after this one will take off
      const double later = n - k, after = o.finishing ? 0 : nf;
      o.passes.push_back({{later * o.depth_mm.c0 + after * finish.c0,
                           later * o.depth_mm.c1 + after * finish.c1},
                          {}});
    }
  }
  add_lengths(recipe, stock, c);
  c.stations.resize(stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) c.stations[i].at_mm = stations[i];
  add_laws(c, a_mm);
  return c;
}

bool MachinedSurface::ends_before_jaws(const catalogue::Tool& tool) const {
  return kind_ != Kind::element || goes_on_ || clears_jaws(around_, tool.re_mm);
}

bool MachinedSurface::enters(const catalogue::Tool& tool) const {
  if (!by_bar()) return true;
  if (!tool.bar) return false;
  // Facing begins with the bar's back towards the wider bore.
  const bool fits = kind_ == Kind::bore ? tool.bar->min_bore_mm <= hole_mm_
                                        : tool.kapr_deg > 90 &&
                                              tool.bar->min_bore_mm <=
                                                  top_mm_ - kAboveBore_mm + D_large_ / 2;
  return fits && catalogue::stick_out_mm(*tool.bar) >= depth_mm_ + kBefore_mm;
}

// A flexibility between the supports, with the tailstock's thrust and a follow rest.
deflection::Flexibility MachinedSurface::at_the_tool(const deflection::Flexibility& f,
                                                     double rest_mm_N) const {
  const deflection::Flexibility pressed{f.f_ww_mm_N * amplification_,
                                        f.f_wp_rad_N * amplification_,
                                        f.f_pp_rad_Nmm * amplification_};
  return clamping_ == Clamping::tailstock_follow && kind_ == Kind::element
             ? deflection::follow_rest(pressed, rest_mm_N)
             : pressed;
}

bool MachinedSurface::cut_to_chuck(const OperationModel& o) const {
  return (o.finishing ? fixed_.finish_direction : fixed_.rough_direction) ==
         Direction::to_chuck;
}

// Towards the chuck the feed force bends an outside away from the tool less.
double MachinedSurface::feed_sign(const OperationModel& o) const {
  return (cut_to_chuck(o) ? -1 : 1) * sign();
}

double MachinedSurface::axial_mm_N() const {
  return clamping_ == Clamping::between_centres ? 0 : plan_->machine.chuck.axial_mm_N;
}

double MachinedSurface::x_mm(const OperationModel& o, double at_mm) const {
  const auto& body = bodies_[o.finishing ? 1 : 0];
  return std::clamp(body.x_mm(at_mm), 0.0, body.length_mm());
}

void MachinedSurface::yields(const OperationModel& o, double left_mm, double uncut_mm,
                             const std::vector<double>& x,
                             std::vector<deflection::Flexibility>& radial,
                             std::vector<deflection::Flexibility>& tangential,
                             bool rigid) const {
  const auto& body = bodies_[o.finishing ? 1 : 0];
  const Element element{kind_ == Kind::bore, index_};
  const bool to_chuck = cut_to_chuck(o);
  const auto shaft = [&](double left) {
    const auto real = body.shaft(element, left);
    return rigid ? stiffer(real) : real;
  };
  yields(shaft(to_chuck ? uncut_mm : left_mm), shaft(to_chuck ? left_mm : uncut_mm), body,
         x, radial, tangential);
}

part::Shaft MachinedSurface::stiffer(part::Shaft shaft) {
  constexpr double kAllButRigid = 1000;
  shaft.E_MPa *= kAllButRigid;
  return shaft;
}

void MachinedSurface::yields(const part::Shaft& chuck_side, const part::Shaft& tail_side,
                             const SetupBody& body, const std::vector<double>& x,
                             std::vector<deflection::Flexibility>& radial,
                             std::vector<deflection::Flexibility>& tangential) const {
  const auto supports = planes(plan_->machine, clamping_);
  if (clamping_ != Clamping::chuck_steady) {
    const deflection::Beam left(chuck_side), right(tail_side);
    flexibilities(left, right, x, supports.radial, radial);
    flexibilities(left, right, x, supports.tangential, tangential);
    const auto& rest = plan_->machine.follow_rest;
    for (std::size_t k = 0; k < x.size(); ++k) {
      radial[k] = at_the_tool(radial[k], rest.radial_mm_N);
      tangential[k] = at_the_tool(tangential[k], rest.tangential_mm_N);
    }
    return;
  }
  const double z = body.x_mm(plan_->setups[setup_].steady_z_mm);
  const auto& rest = plan_->machine.steady_rest;
  const deflection::RestedBeam r(chuck_side, tail_side, supports.radial,
                                 {z, rest.radial_mm_N});
  const deflection::RestedBeam t(chuck_side, tail_side, supports.tangential,
                                 {z, rest.tangential_mm_N});
  for (std::size_t k = 0; k < x.size(); ++k) {
    radial[k] = r.at(x[k]).part;
    tangential[k] = t.at(x[k]).part;
  }
}

std::vector<std::vector<MachinedSurface::Values>> MachinedSurface::face_laws(
    const Chain& chain) const {
  const auto body = bodies_[0].shaft();
  std::vector<deflection::Flexibility> radial(1), tangential(1);
  yields(body, body, bodies_[0], {face_x_}, radial, tangential);
  const auto& f = radial[0];
  const double c_ax = axial_mm_N();
  std::vector<std::vector<Values>> all(chain.stations.size());
  for (const auto& o : chain.operations) {
    const BarTip bar = by_bar() ? tip_of(*o.tool->bar) : BarTip{};
    const double outwards = by_bar() ? 1 : -1;  // the feed, (1) and (4) of yielding.hpp
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double rho = chain.stations[i].at_mm;
      all[i].insert(all[i].end(), o.passes.size(),
                    {f.f_pp_rad_Nmm * rho * rho + c_ax + bar.z + bar.a,
                     outwards * f.f_wp_rad_N * rho - bar.p, 0, 0});
    }
  }
  return all;
}

std::vector<std::vector<MachinedSurface::Values>> MachinedSurface::laws_at(
    const Chain& chain, double a) const {
  if (is_face()) return face_laws(chain);
  const auto& m = plan_->machine;
  const std::size_t n = chain.stations.size();
  std::vector<std::vector<Values>> all(n);
  std::vector<double> x(n);
  std::vector<deflection::Flexibility> r(n), t(n);
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const BarTip bar = o.inner ? tip_of(*o.tool->bar) : BarTip{};
    for (std::size_t k = 0; k < n; ++k) x[k] = x_mm(o, chain.stations[k].at_mm);
    for (const auto& pass : o.passes) {
      const double left = pass.left_mm(a);
      yields(o, left, left + o.depth_mm(a), x, r, t);
      for (std::size_t k = 0; k < n; ++k) {
        const double u = (chain.stations[k].at_mm - low_) / (high_ - low_);
        const double D = std::max(
            left_mm_ + (right_mm_ - left_mm_) * u + sign() * 2 * left, o.least_D_mm);
        const double slip = t[k].f_ww_mm_N + bar.t;
        all[k].push_back({r[k].f_ww_mm_N + bar.w + m.tool_rr_mm_N,
                          feed_sign(o) * (r[k].f_wp_rad_N * D / 2 - bar.p),
                          sign() * m.tool_rt_mm_N, sign() * slip * slip / D});
      }
    }
  }
  return all;
}

void MachinedSurface::add_laws(Chain& chain, std::optional<double> a_mm) const {
  if (chain.stations.empty()) return;
  const double lower = a_mm.value_or(chain.a.lower), upper = a_mm.value_or(chain.a.upper);
  const bool open = lower < upper;
  const double centre = (lower + upper) / 2, half = open ? (upper - lower) / 2 : 1;
  std::size_t passes = 0;
  for (const auto& o : chain.operations) passes += o.passes.size();
  const auto laws = [&](double u) {
    Eigen::VectorXd all(static_cast<Eigen::Index>(4 * passes * chain.stations.size()));
    Eigen::Index column = 0;
    for (const auto& station : laws_at(chain, centre + half * u))
      for (const auto& v : station)
        for (const double value : {v.p, v.q, v.s, v.r}) all[column++] = value;
    return all;
  };
  const Eigen::MatrixXd c = open ? following(laws) : Eigen::MatrixXd(laws(0).transpose());
  Eigen::Index column = 0;
  const auto next = [&] { return polynomial(c.col(column++), centre, half); };
  for (auto& station : chain.stations)
    for (std::size_t k = 0; k < passes; ++k) {
      Law law;
      law.p = next();
      law.q = next();
      law.s = next();
      law.r = next();
      station.passes.push_back(std::move(law));
    }
}

std::vector<double> MachinedSurface::errors(const Recipe& recipe, const Economy& economy,
                                            const Choice<double>& choice,
                                            const std::vector<double>& places) const {
  const auto c = *chain(recipe, economy, places, choice.a);
  const auto F = forces(c, choice);
  std::vector<double> e;
  for (const auto& station : c.stations)
    e.push_back(sign() * error_mm(c, station, choice, F));
  return e;
}

Compensation::Table MachinedSurface::corrections(const Recipe& recipe,
                                                 const Economy& economy,
                                                 const Choice<double>& choice) const {
  std::vector<double> places;
  for (int k = 0; k < kTable; ++k)
    places.push_back(low_ + (high_ - low_) * k / (kTable - 1));
  const auto c = *chain(recipe, economy, places, choice.a);
  Compensation::Table table;
  for (const auto& station : c.stations)
    table.emplace_back(station.at_mm,
                       -sign() * correction_mm(last_pass(c, station, choice)));
  return table;
}

std::vector<double> MachinedSurface::corrected(const Recipe& recipe,
                                               const Economy& economy,
                                               const Choice<double>& choice,
                                               const std::vector<double>& places,
                                               const Compensation::Table& table) const {
  const auto c = *chain(recipe, economy, places, choice.a);
  std::vector<double> e;
  for (const auto& station : c.stations) {
    const auto pass = last_pass(c, station, choice);
    const double s = -sign() * interpolated(table, station.at_mm);
    e.push_back(sign() *
                (is_face() ? correction_mm(pass) - s : corrected_error_mm(pass, s)));
  }
  return e;
}

tolerance::PiecewisePolynomial MachinedSurface::profile(
    const Recipe& recipe, const Economy& economy, const Choice<double>& choice) const {
  return through_exact(low_, high_, is_face() ? 1 : 8, is_face() ? 3 : 9,
                       [&](const std::vector<double>& places) {
                         return errors(recipe, economy, choice, places);
                       });
}

tolerance::PiecewisePolynomial MachinedSurface::corrected_profile(
    const Recipe& recipe, const Economy& economy, const Choice<double>& choice,
    const Compensation::Table& table) const {
  return through_exact(low_, high_, kTable - 1, 5,
                       [&](const std::vector<double>& places) {
                         return corrected(recipe, economy, choice, places, table);
                       });
}

}  // namespace turnwright::planning
