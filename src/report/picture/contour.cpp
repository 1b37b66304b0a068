#include "contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turnwright::report {
namespace {

using part::End;
using planning::Assignment;
using planning::PreparedPart;

constexpr double kNothing_mm = 1e-9;  // shorter runs are rounding of sums of lengths

constexpr int kArcChords = 12;  // of an arc, of a rounded edge

// Points of an arc are M + t e +- n (sqrt(R^2 - t^2) - d), M the middle of its chord, t
// along it, d = sqrt(R^2 - c^2/4) the centre's distance from it.
Runs chords(const part::Cut& arc, double z, double length) {
  const double r0 = arc.drawn.left_mm / 2, r1 = arc.drawn.right_mm / 2;
  const double c = std::hypot(length, r1 - r0), R = arc.radius_mm;
  const double e_z = length / c, e_r = (r1 - r0) / c, side = arc.convex ? 1 : -1;
  const double d = std::sqrt(std::max(0.0, R * R - c * c / 4));
  Runs all;
  Run run{z, z, r0, r0};
  for (int k = 1; k <= kArcChords; ++k) {
    const double t = c * (static_cast<double>(k) / kArcChords - 0.5);
    const double off = side * (std::sqrt(std::max(0.0, R * R - t * t)) - d);
    run.z1 = z + length / 2 + t * e_z - off * e_r;
    run.r1 = (r0 + r1) / 2 + t * e_r + off * e_z;
    all.push_back(run);
    run = {run.z1, run.z1, run.r1, run.r1};
  }
  return all;
}

template <class Element>
bool has_edges(const Element& e) {
  if constexpr (requires { e.left_undercut; })
    if (e.left_undercut || e.right_undercut) return true;
  return e.left_chamfer || e.right_chamfer;
}

// A cylinder with its chamfers, rounded edges and undercuts; out: 1 outside, -1 in a bore.
template <class Element>
Runs with_edges(const Element& e, double z, double out) {
  std::vector<double> at{0, e.length_mm};
  const auto edge = [&](const std::optional<part::Chamfer>& c, double from, double to) {
    if (!c) return;
    const int chords = c->round ? kArcChords : 1;
    for (int i = 1; i <= chords; ++i) {
      const double turned = std::numbers::pi / 2 * i / chords;
      at.push_back(from + to * c->axial_mm * (i < chords ? 1 - std::cos(turned) : 1));
    }
  };
  edge(e.left_chamfer, 0, 1);
  edge(e.right_chamfer, e.length_mm, -1);
  if constexpr (requires { e.left_undercut; }) {
    const auto add = [&](const std::optional<part::Undercut>& u, double from, double to) {
      if (!u) return;
      at.push_back(from + to * u->width_mm);
      at.push_back(from + to * (u->width_mm - part::fall_mm(*u)));
    };
    add(e.left_undercut, 0, 1);
    add(e.right_undercut, e.length_mm, -1);
  }
  std::sort(at.begin(), at.end());
  const auto radius = [&](double x) {
    double r = e.left_mm / 2 - out * part::chamfered_mm(e, x);
    if constexpr (requires { e.left_undercut; }) r -= part::undercut_mm(e, x);
    return r;
  };
  Runs all;
  for (std::size_t k = 0; k + 1 < at.size(); ++k)
    all.push_back({z + at[k], z + at[k + 1], radius(at[k]), radius(at[k + 1])});
  return all;
}

template <class Element>
Runs runs(const Element& e, double z, double out) {
  if (has_edges(e)) return with_edges(e, z, out);
  if (e.cut && e.cut->kind == part::CutKind::arc) return chords(*e.cut, z, e.length_mm);
  const bool groove = part::is_groove(e);
  const auto ends = groove ? e.cut->drawn : part::Ends{e.left_mm, e.right_mm};
  return {{z, z + e.length_mm, ends.left_mm / 2, ends.right_mm / 2}};
}

// A stub beyond the last element is cut with it.
void add_stubs(Runs& outer, double left_z, double right_z, double L) {
  const Run first = outer.front(), last = outer.back();
  if (left_z < -kNothing_mm) outer.insert(outer.begin(), {left_z, 0, first.r0, first.r0});
  if (right_z > L + kNothing_mm) outer.push_back({L, right_z, last.r1, last.r1});
}

Runs bores(const part::Drawing& d, const std::vector<bool>& finished, double left_z,
           double right_z) {
  const double hole = d.stock.inner_mm / 2;
  Runs cut;
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (finished[i])
      for (const auto& run : inner_runs(d, i)) cut.push_back(run);
  std::sort(cut.begin(), cut.end(),
            [](const Run& a, const Run& b) { return a.z0 < b.z0; });
  Runs all;
  double z = left_z;
  for (auto run : cut) {
    if (run.z0 > z + kNothing_mm) all.push_back({z, run.z0, hole, hole});
    all.push_back(run);
    z = run.z1;
  }
  if (right_z > z + kNothing_mm) all.push_back({z, right_z, hole, hole});
  return all;
}

// The stock over an outer element.
Runs uncut_runs(const part::Drawing& d, std::size_t i) {
  const double from = part::left_z_mm(d, i);
  return between(stock_runs(d.stock), from, from + d.outer[i].length_mm);
}

}  // namespace

Runs stock_runs(const part::Stock& stock) {
  Runs all;
  for (const auto& line : part::stock_lines(stock, -INFINITY, INFINITY))
    all.push_back({line.z0_mm, line.z1_mm, line.left_mm / 2, line.right_mm / 2});
  return all;
}

Runs outer_runs(const part::Drawing& d, std::size_t i) {
  return runs(d.outer[i], part::left_z_mm(d, i), 1);
}

Runs inner_runs(const part::Drawing& d, std::size_t i) {
  return runs(d.inner[i], part::inner_left_z_mm(d, i), -1);
}

Contour contour_after(const PreparedPart& p, std::size_t setup) {
  const auto& d = p.drawing;
  const auto finished = planning::finished_after(p, setup);
  const double L = part::length_mm(d);
  const double left_z = 0 - planning::face_stock_after_mm(p, setup, End::left);
  const double right_z = L + planning::face_stock_after_mm(p, setup, End::right);
  Contour c;
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const auto all = finished.outer[i] ? outer_runs(d, i) : uncut_runs(d, i);
    c.outer.insert(c.outer.end(), all.begin(), all.end());
  }
  add_stubs(c.outer, left_z, right_z, L);
  c.inner = bores(d, finished.inner, left_z, right_z);
  return c;
}

double radius_mm(const Run& run, double z) {
  return run.r0 + (run.r1 - run.r0) * (z - run.z0) / (run.z1 - run.z0);
}

Runs between(const Runs& runs, double from_z, double to_z) {
  Runs part;
  for (const auto& run : runs) {
    const double z0 = std::max(run.z0, from_z), z1 = std::min(run.z1, to_z);
    if (z1 - z0 > kNothing_mm)
      part.push_back({z0, z1, radius_mm(run, z0), radius_mm(run, z1)});
  }
  return part;
}

}  // namespace turnwright::report
