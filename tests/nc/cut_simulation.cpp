#include "cut_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planning/clamping/jaws.hpp"
#include "planning/clamping/positions.hpp"

namespace turnwright::nc::test {
namespace {

constexpr double kFar_mm = 1000;
constexpr double kMade_mm = 1e-3;  // a surface is finished within this
// A start so far inside a finished surface counts; in an inner corner the tool's corner,
// which touches both sides, may touch that much more.
constexpr double kInside_mm = 0.1;
constexpr double kBeforeWall_mm = 0.2;  // that a knurl may end before what stands there
constexpr double kBeside_mm = 0.02;     // next to a wall's plane, in the material

Polygon placed(const Polygon& tool, double side, double sign) {
  Polygon all;
  for (const auto& p : tool) all.push_back({side * p.x, sign * p.z});
  return hull(std::move(all));
}

// The place on a line next to another where a surface goes on.
std::optional<double> goes_on(const Intervals& line, double at, double by) {
  for (const auto& a : line)
    for (const double end : {a.from, a.to})
      if (std::abs(end - at) <= by) return end;
  return std::nullopt;
}

}  // namespace

const char* name(Fault fault) {
  switch (fault) {
    case Fault::gouge:
      return "gouge";
    case Fault::left:
      return "stock left";
    case Fault::lean:
      return "wall leans";
    case Fault::rapid:
      return "rapid in material";
    case Fault::holder:
      return "holder in material";
    case Fault::jaws:
      return "in the jaws";
    case Fault::centre:
      return "in the centre";
    case Fault::start:
      return "starts on a finished surface";
    case Fault::again:
      return "enters the contour again";
    case Fault::thread:
      return "thread or knurl not made";
  }
  return "";
}

CutSimulation::CutSimulation(const Planned& p, double pitch_mm,
                             const Tolerances& tolerances)
    : p_(p),
      tolerances_(tolerances),
      drawn_(p),
      material_(
          {0, -p.part.drawing.stock.left_allowance_mm - 1},
          {p.part.drawing.stock.outer_mm / 2 + 1,
           p.part.drawing.stock.length_mm - p.part.drawing.stock.left_allowance_mm + 1},
          pitch_mm),
      least_(material_),
      full_(material_) {
  review::Polygon stock;
  for (const auto& [x, z] : part::half_section(p.part.drawing.stock))
    stock.push_back({x, z});
  material_.fill(stock);
  least_.fill(drawn_.least());
  full_.fill(drawn_.full());
  for (std::size_t s = 0; s < p.plan.setups.size(); ++s)
    for (const auto& o : p.plan.setups[s].operations)
      if (const auto hole = drilled(p, s, o)) {
        const bool left = p.part.setups[s].hold == part::End::left;
        const auto tool = placed(cutter(p, o).edge, 1, left ? 1 : -1);
        const double tip = hole->depth_mm + hole->point_mm;
        const Spot at{0, left ? part::length_mm(p.part.drawing) - tip : tip};
        least_.cut(swept(tool, at, at));
      }
}

const planning::OperationPlan* CutSimulation::operation(const std::string& id) const {
  for (const auto& o : p_.plan.setups[setup_].operations)
    if (o.id == id) return &o;
  return nullptr;
}

Spot CutSimulation::place(double x, double z) const { return {x, free_z_ + sign_ * z}; }

const CutSimulation::Body& CutSimulation::body(const planning::OperationPlan& o) {
  const auto found = bodies_.find(o.id);
  if (found != bodies_.end()) return found->second;
  Body b;
  b.cutter = cutter(p_, o);
  const double side = b.cutter.inner && !b.cutter.drills ? -1 : 1;
  b.edge = placed(b.cutter.edge, side, sign_);
  b.small_edge = eroded(b.edge, tolerances_.touch);
  for (const auto& piece : b.cutter.holder)
    b.small_holder.push_back(eroded(placed(piece, side, sign_), tolerances_.touch));
  return bodies_.emplace(o.id, std::move(b)).first->second;
}

void CutSimulation::setup(std::size_t s, const std::vector<Way>& ways) {
  setup_ = s;
  const bool left = p_.part.setups[s].hold == part::End::left;
  sign_ = left ? 1 : -1;
  free_z_ = left ? part::length_mm(p_.part.drawing) : 0;
  bodies_.clear();
  entered_.clear();
  centred_ = in_pass_ = touched_ = false;
  add_obstacles();
  for (const auto& way : ways) follow(way);
  material_.drop_loose(part::length_mm(p_.part.drawing) / 2);
}

// The jaws, or the driver at the headstock's centre, fill everything beyond the end of the
// length held.
void CutSimulation::add_obstacles() {
  obstacles_.clear();
  const auto clamping = p_.plan.setups[setup_].clamping;
  const double root = planning::root_z_mm(p_.part, setup_, clamping) - sign_ * 1e-4;
  const double r = planning::grip_diameter_mm(p_.part, setup_, clamping) / 2;
  const double far = root - sign_ * kFar_mm;
  obstacles_.push_back(
      {Fault::jaws, hull({{r, root}, {kFar_mm, root}, {kFar_mm, far}, {r, far}}), true});
}

// The tailstock's centre sits in the countersink of the free end.
void CutSimulation::add_centre() {
  const auto& c = p_.part.machine.live_centre;
  double r = c.point_mm / 8;
  for (const auto& o : p_.plan.setups[setup_].operations)
    if (const auto hole = drilled(p_, setup_, o)) r = hole->D_mm / 2;
  const double full = (c.point_mm / 2 - r) / std::tan(M_PI / 6);
  const double body = c.point_length_mm - r / std::tan(M_PI / 6);
  const auto at = [&](double x, double z) { return place(x, z + 1e-4); };
  const auto add = [&](double radius, double from, double to) {
    obstacles_.push_back(
        {Fault::centre, hull({at(0, from), at(radius, from), at(radius, to), at(0, to)}),
         false});
  };
  obstacles_.push_back({Fault::centre,
                        hull({at(0, 0), at(r, 0), at(c.point_mm / 2, full), at(0, full)}),
                        false});
  add(c.point_mm / 2, full, body);
  add(c.body_mm / 2, body, kFar_mm);
}

void CutSimulation::follow(const Way& w) {
  const auto* o = operation(w.operation);
  if (!o) return;
  if (w.centred && !centred_) add_centre();
  centred_ = w.centred;
  const auto& b = body(*o);
  const auto from = place(w.x0, w.z0), to = place(w.x1, w.z1);
  if (w.rapid) {
    if (in_pass_) material_.drop_loose(part::length_mm(p_.part.drawing) / 2);
    in_pass_ = touched_ = false;
    const double depth = material_.depth(swept(b.small_edge, from, to));
    if (depth > 0) find(Fault::rapid, w.operation, depth, to);
  } else {
    const auto sweep = swept(b.edge, from, to);
    in_pass_ = true;
    if (!touched_ && !b.cutter.drills && !b.cutter.threads)
      first_touch(b, w, sweep, from, to);
    material_.cut(sweep);
  }
  if (w.thread && b.cutter.drills) {
    tap(w, *o);
  } else if (w.thread) {
    const double h = b.cutter.inner ? -w.x1 : w.x1;
    auto& deepest = threads_.emplace(o->on[0], h).first->second;
    deepest = std::min(deepest, h);
  } else if (!w.rapid && b.cutter.threads) {
    press(w, *o);
  }
  collide(w, b, from, to);
}

// A knurl lies where the wheel has been as deep as it goes.
void CutSimulation::press(const Way& w, const planning::OperationPlan& o) {
  const auto& [id, width] = std::pair{o.on[0], o.passes[0].ap_mm};
  const auto deepest = threads_.emplace(id, w.x1).first;
  if (w.x1 > deepest->second) return;
  const bool first = w.x1 < deepest->second || !pressed_.contains(id);
  deepest->second = w.x1;
  auto& [from, to] = pressed_[id];
  if (first) from = kFar_mm, to = -kFar_mm;
  for (const double z : {w.z1, w.z1 + width}) {
    from = std::min(from, place(0, z).z);
    to = std::max(to, place(0, z).z);
  }
}

// A tap cuts a thread whole if its full diameter reaches the thread's end.
void CutSimulation::tap(const Way& w, const planning::OperationPlan& o) {
  const auto e = *part::extent(p_.part.drawing, o.on[0]);
  const auto& all = p_.part.drawing.inner;
  const auto& cut = *std::ranges::find(all, o.on[0], &part::InnerElement::id)->cut;
  const double end = sign_ > 0 ? e.z0_mm : e.z1_mm;
  if (std::abs(place(0, w.z1 + cut.lead_mm).z - end) < tolerances_.gouge)
    threads_[o.on[0]] = -cut.drawn.left_mm / 2;
}

void CutSimulation::collide(const Way& w, const Body& b, const Spot& from,
                            const Spot& to) {
  const auto against_obstacles = [&](const Polygon& sweep) {
    for (const auto& obstacle : obstacles_)
      if (overlap(sweep, obstacle.body)) find(obstacle.fault, w.operation, 0, to);
  };
  against_obstacles(swept(b.small_edge, from, to));
  for (const auto& piece : b.small_holder) {
    const auto sweep = swept(piece, from, to);
    const double depth = material_.depth(sweep);
    if (depth > 0) find(Fault::holder, w.operation, depth, to);
    against_obstacles(sweep);
  }
}

bool CutSimulation::made(const Lines& lines, std::size_t i, double surface) const {
  return goes_on(lines.on(i), surface, kMade_mm).has_value();
}

// Where a pass touches the drawn contour first, and how far inside a surface that was
// finished before.
void CutSimulation::first_touch(const Body& b, const Way& w, const Polygon& sweep,
                                const Spot& from, const Spot& to) {
  struct Touch {
    const Lines *drawn, *material;
    std::size_t line;
    double at, after;
  };
  std::optional<Touch> first;
  const auto way = to - from;
  for (const auto& [drawn, material] :
       {std::pair{&full_.columns, &material_.columns}, {&full_.rows, &material_.rows}})
    drawn->for_each(sweep, [&](std::size_t i, const Interval& span) {
      for (const auto& a : drawn->on(i))
        for (const auto& [surface, tool] :
             {std::pair{a.to, span.from}, {a.from, span.to}}) {
          if (std::abs(surface - tool) > kMade_mm) continue;
          const auto spot = drawn->spot(i, surface) - from;
          const double after = spot.x * way.x + spot.z * way.z;
          if (!first || after < first->after)
            first = Touch{drawn, material, i, surface, after};
        }
    });
  if (!first) return;
  touched_ = true;
  const auto spot = first->drawn->spot(first->line, first->at);
  entered(b, w, spot);
  const double pitch = first->drawn->at(1) - first->drawn->at(0);
  const auto finished_for = [&](int step) {
    double at = first->at;
    auto i = first->line;
    for (int n = 0;; ++n) {
      if (!made(*first->material, i, at)) return n * pitch;
      if (n * pitch > 10 || (step < 0 && i == 0) || i + 1 >= first->drawn->size())
        return n * pitch;
      i += static_cast<std::size_t>(step);
      const auto next = goes_on(first->drawn->on(i), at, 1.2 * pitch);
      if (!next) return n * pitch;
      at = *next;
    }
  };
  const double inside = std::min(finished_for(1), finished_for(-1));
  const double allowed = kInside_mm + (b.cutter.finishes ? b.cutter.re_mm : 0) +
                         drawn_.along_face_mm(spot, kMade_mm);
  if (inside > allowed && !b.cutter.plunges)
    find(Fault::start, w.operation, inside, spot);
}

void CutSimulation::entered(const Body& b, const Way& w, const Spot& at) {
  if (!b.cutter.finishes) return;
  const int times = entered_[{operation(w.operation)->tool, b.cutter.inner}]++;
  if (times > 0) find(Fault::again, w.operation, times, at);
}

void CutSimulation::compare() {
  compare(material_.columns, least_.columns, full_.columns);
  compare(material_.rows, least_.rows, full_.rows);
  compare_walls();
  compare_threads();
}

void CutSimulation::compare(const Lines& material, const Lines& least,
                            const Lines& full) {
  const auto each = [&](const Intervals& all, double least_mm, std::size_t i,
                        const auto& f) {
    for (const auto& a : all)
      if (a.to - a.from > least_mm)
        for (const double at : {a.from, (a.from + a.to) / 2, a.to})
          f(material.spot(i, at));
  };
  for (std::size_t i = 0; i < material.size(); ++i) {
    each(without(least.on(i), material.on(i)), tolerances_.gouge, i, [&](const Spot& p) {
      const double mm = drawn_.depth_mm(p);
      if (mm > tolerances_.gouge) find(Fault::gouge, drawn_.surface_at(p), mm, p);
    });
    each(without(material.on(i), full.on(i)), tolerances_.left, i, [&](const Spot& p) {
      const double mm = drawn_.beyond_mm(p);
      if (mm > tolerances_.left) find(Fault::left, drawn_.surface_at(p), mm, p);
    });
  }
}

void CutSimulation::compare_walls() {
  const auto& rows = material_.rows;
  for (const auto& wall : drawn_.walls())
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double x = rows.at(i), side = wall.material_right ? 1 : -1;
      if (x < wall.from_x || x > wall.to_x) continue;
      const double inside = wall.z + side * kBeside_mm;
      for (const auto& a : rows.on(i)) {
        if (inside < a.from || inside > a.to) continue;
        const double end = wall.material_right ? a.from : a.to;
        const double mm = std::abs(end - wall.z);
        if (mm > tolerances_.lean) find(Fault::lean, wall.name, mm, {x, end});
      }
    }
}

void CutSimulation::compare_threads() {
  const auto check = [&](const auto& e, double sign) {
    if (!e.cut ||
        (e.cut->kind != part::CutKind::thread && e.cut->kind != part::CutKind::knurl))
      return;
    const double root = sign * e.cut->core.left_mm / 2;
    const auto cut = threads_.find(e.id);
    const double off = cut == threads_.end() ? kFar_mm : std::abs(cut->second - root);
    if (off > tolerances_.gouge) find(Fault::thread, e.id, off, {sign * root, 0});
    if (e.cut->kind != part::CutKind::knurl) return;
    const auto at = *part::extent(p_.part.drawing, e.id);
    const auto [from, to] = pressed_[e.id];
    const double bare =
        std::max(0.0, from - at.z0_mm) + std::max(0.0, at.z1_mm - to) - kBeforeWall_mm;
    if (bare > tolerances_.gouge) find(Fault::thread, e.id, bare, {sign * root, from});
  };
  for (const auto& e : p_.part.drawing.outer) check(e, 1);
  for (const auto& e : p_.part.drawing.inner) check(e, -1);
}

void CutSimulation::find(Fault fault, const std::string& where, double mm,
                         const Spot& at) {
  auto& worst =
      findings_.try_emplace({fault, where}, Finding{fault, where, mm, at}).first->second;
  if (mm > worst.mm) worst = {fault, where, mm, at};
}

std::vector<Finding> CutSimulation::findings() const {
  std::vector<Finding> all;
  for (const auto& [key, finding] : findings_) all.push_back(finding);
  return all;
}

std::string listed(const std::vector<Finding>& findings) {
  std::string all;
  for (const auto& f : findings)
    all += fmt::format("{}: {} by {:.5f} mm at radius {:.3f}, {:.3f} from the left end\n",
                       f.where, name(f.fault), f.mm, f.at.x, f.at.z);
  return all;
}

// Whether the operation that enters the contour, from which others may run on, says why.
bool is_told(const Finding& f, const Programs& all) {
  if (f.fault != Fault::again) return false;
  const auto of_it = [&](const Step& s) {
    return !s.comments.empty() && s.comments[0].starts_with("operation " + f.where + ":");
  };
  const auto tells = [](const std::string& c) {
    return c.starts_with("enters the contour again: ");
  };
  const auto runs_on = [](const Step& s) {
    return !s.moves.empty() && s.moves.front().kind != Move::Kind::rapid;
  };
  for (const auto& p : all.setups) {
    auto step = std::ranges::find_if(p.steps, of_it);
    if (step == p.steps.end()) continue;
    while (step != p.steps.begin() && runs_on(*step)) --step;
    return std::ranges::any_of(step->comments, tells);
  }
  return false;
}

std::vector<Finding> simulated(const Planned& p, const Programs& all) {
  CutSimulation cut(p);
  for (const auto& program : all.setups)
    cut.setup(program.setup, ways_of(program, p.plan.setups[program.setup]));
  cut.compare();
  return cut.findings();
}

}  // namespace turnwright::nc::test
