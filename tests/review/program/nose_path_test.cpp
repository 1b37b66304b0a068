#include "review/program/nose_path.hpp"

#include <cmath>
#include <random>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using Ways = std::vector<std::string>;

TurningProgram tip_of(const std::string& text, double r, bool inner = false,
                      Control control = Control::fanuc) {
  return with_nose_paths(read(control, "G99 G97 S500 M3\n" + text), [=](int) {
    return Nose{r, inner};
  });
}

// Cylinders and faces do not change; a cone of half angle a is shifted along Z by
// r (1 - tan(a/2)), which leaves r - r tan(a/2) at its thin end for 45 deg: 0.5858 r.
TEST(NosePath, ShiftsCones) {
  const std::string contour =
      "G0 X50. Z10.\nG42 G0 X16. Z2.\nG1 X20. Z0. F0.1\nX40. Z-10.\nZ-30.\nX60.\n"
      "G40 G0 X70. Z9.\n";
  const auto p = tip_of(contour, 0.8);
  expect_understood(p);
  const auto m = moves(p);
  const double shift = 0.8 * (1 - std::tan(M_PI / 8)), at = 0.8 * (1 - std::sqrt(0.5));
  ASSERT_EQ(m.size(), 8u);
  // Both pieces of the cone are one line, to beside its end; then around the corner.
  EXPECT_NEAR(m[2].x_mm - 10, -m[2].z_mm - shift, 1e-9);
  expect_at(m[3], 20 - at, -10 - at);
  EXPECT_EQ(m[4].kind, Move::Kind::arc);
  expect_at(m[4], 20, -10.8);
  expect_at(m[5], 20, -30);
  expect_at(m[6], 30 - 0.8, -30);
  EXPECT_EQ(ways(p).back(), "G0 35 9");
}

TEST(NosePath, LeavesProgramsWithoutItAlone) {
  const std::string text =
      "G0 X50. Z10.\nG0 X16. Z2.\nG1 X20. Z0. F0.1\nG3 X30. Z-5. R5.\nG0 X60.";
  EXPECT_EQ(ways(tip_of(text, 0.8)),
            ways(read(Control::fanuc, "G99 G97 S500 M3\n" + text)));
  // Nor has a tool without a nose any.
  const std::string with =
      "G0 X50. Z10.\nG42\nG0 X16. Z2.\nG1 X20. Z0. F0.1\nG40 G0 X60.";
  const auto plain = read(Control::fanuc, "G99 G97 S500 M3\n" + with);
  EXPECT_EQ(ways(tip_of(with, 0)), ways(plain));
  EXPECT_EQ(ways(with_nose_paths(plain, [](int) { return std::optional<Nose>(); })),
            ways(plain));
}

/// How far the nose's circle reaches over the contour at most, and what it leaves at least
/// somewhere of each of its lines.
struct Fit {
  double into_mm = 0, beside_mm = 0;
};
double distance(const toolpath::Point& p, const toolpath::Point& a,
                const toolpath::Point& b) {
  const double dx = b.h_mm - a.h_mm, dz = b.z_mm - a.z_mm;
  const double u = std::clamp(
      ((p.h_mm - a.h_mm) * dx + (p.z_mm - a.z_mm) * dz) / (dx * dx + dz * dz), 0.0, 1.0);
  return std::hypot(p.h_mm - a.h_mm - u * dx, p.z_mm - a.z_mm - u * dz);
}
Fit fit(const std::vector<toolpath::Point>& contour, const TurningProgram& tip, double r,
        double side) {
  std::vector<double> nearest(contour.size(), 1e9);
  Fit f;
  for (const auto& run : tip.runs)
    for (const auto& m : run.moves) {
      if (m.to.kind == Move::Kind::rapid) continue;
      for (int i = 0; i <= 400; ++i) {
        const double u = i / 400.0;
        toolpath::Point at{std::lerp(m.from->h_mm, m.to.x_mm, u),
                           std::lerp(m.from->z_mm, m.to.z_mm, u)};
        if (m.to.kind == Move::Kind::arc) {
          const auto& c = m.to.centre;
          const double R = std::hypot(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
          const double a = std::atan2(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
          const double turn = std::remainder(
              std::atan2(m.to.x_mm - c.h_mm, m.to.z_mm - c.z_mm) - a, 2 * M_PI);
          at = {c.h_mm + R * std::sin(a + u * turn), c.z_mm + R * std::cos(a + u * turn)};
        }
        const toolpath::Point centre{at.h_mm + side * r, at.z_mm + r};
        for (std::size_t k = 1; k < contour.size(); ++k) {
          const double d = distance(centre, contour[k - 1], contour[k]);
          f.into_mm = std::max(f.into_mm, r - d);
          nearest[k] = std::min(nearest[k], d - r);
        }
      }
    }
  for (std::size_t k = 1; k < contour.size(); ++k)
    f.beside_mm = std::max(f.beside_mm, nearest[k]);
  return f;
}

// Along any contour the nose touches each line and cuts into none.
TEST(NosePath, TouchesContoursDrawnAtRandom) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> length(2.5, 9), slope(-0.9, 1.2),
      radius(0.2, 1.2);
  for (int n = 0; n < 200; ++n) {
    const bool inner = n % 2 == 1;
    const double r = radius(random), side = inner ? -1 : 1;
    std::vector<toolpath::Point> contour{{40, 0}};
    std::string text = inner ? "G0 X60. Z10.\nG41 G0 X80. Z5. F0.1\nG1 Z0.\n"
                             : "G0 X90. Z10.\nG42 G0 X80. Z5. F0.1\nG1 Z0.\n";
    for (int k = 0; k < 6; ++k) {
      const double dz = -length(random);
      contour.push_back(
          {contour.back().h_mm - side * slope(random) * dz, contour.back().z_mm + dz});
      char line[64];
      std::snprintf(line, sizeof line, "X%.17f Z%.17f\n", 2 * contour.back().h_mm,
                    contour.back().z_mm);
      text += line;
    }
    text += inner ? "G40 G0 X30.\n" : "G40 G0 X120.\n";
    const auto p = tip_of(text, r, inner);
    expect_understood(p);
    const auto f = fit(contour, p, r, side);
    EXPECT_LT(f.into_mm, 1e-9) << text;
    EXPECT_LT(f.beside_mm, 1e-4) << text;  // between two samples
  }
}

TEST(NosePath, TellsWhatTheNoseCannotEnter) {
  const std::string begin = "G0 X50. Z10.\nG42 G0 X20. Z2. F0.1\nG1 Z-10.\n";
  const auto arc = tip_of(begin + "G2 X21. Z-10.5 R0.5\nG1 X40.\nG40 G0 X60.", 0.8);
  ASSERT_EQ(arc.unknown.size(), 1u);
  EXPECT_EQ(arc.unknown[0].line, 5u);
  // What is left meets as if the corner were sharp.
  EXPECT_EQ(ways(arc)[2], "G1 10 -10.5");
  const auto slot = tip_of(begin + "X18. Z-10.5\nX20. Z-11.\nZ-20.\nG40 G0 X60.", 0.8);
  EXPECT_FALSE(slot.unknown.empty());
  EXPECT_EQ(tip_of("G0 X50. Z10.\nG42 G0 X20. Z2. F0.1\nG32 Z-9. F1.\nG40 G0 X60.", 0.8)
                .unknown.size(),
            1u);
}

// An arc of the nose's own radius is a point of its centre's way.
TEST(NosePath, TurnsInAnArcOfItsOwnRadius) {
  const auto p = tip_of(
      "G0 X50. Z10.\nG42 G0 X20. Z2. F0.1\nG1 Z-10.\nG2 X21.6 Z-10.8 R0.8\nG1 X40.\n"
      "G40 G0 X60.",
      0.8);
  expect_understood(p);
  EXPECT_EQ(ways(p), (Ways{"G0 25 10", "G0 10 1.2", "G1 10 -10.8", "G1 19.2 -10.8",
                           "G0 30 -10.8"}));
}

}  // namespace
}  // namespace turnwright::review
