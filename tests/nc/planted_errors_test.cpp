// Programs written by hand that make their part, and the same with an error: the
// simulation of the cut finds it.
#include <gtest/gtest.h>

#include <functional>

#include "cut_simulation.hpp"
#include "paper_program.hpp"

namespace turnwright::nc {
namespace {

using namespace test;
using planning::Clamping;
using planning::OperationKind;

constexpr const char* kRougher = "PCLNL-CNMG120408-PM";   // 95 deg, 0.8 mm
constexpr const char* kFinisher = "PDJNL-DNMG150604-PF";  // 93 deg, 0.4 mm
constexpr const char* kFacer = "PCLNL-CNMG120404-PF";     // 95 deg, 0.4 mm
constexpr const char* kBar = "S16R-SCLCR-CCMT09T304-PF";  // 11 mm beside its axis
const double kTan = std::tan(M_PI / 8);                   // of half the turn at a chamfer

std::vector<Finding> found(const Paper& paper) {
  return simulated(paper.planned(), paper.programs());
}

double most(const std::vector<Finding>& findings, Fault fault) {
  double mm = -1;
  for (const auto& f : findings)
    if (f.fault == fault) mm = std::max(mm, f.mm);
  return mm;
}

void face(Paper& paper, double from_x, double z = 0) {
  paper.operation(OperationKind::face, {"right"}, kRougher).rapid(from_x, 2);
  paper.rapid(from_x, z).feed(-0.8, z).rapid(-0.8, 2).rapid(100, 2);
}

/// A shaft with a wall and two chamfers; the sizes and steps that errors change.
struct Shaft {
  double finish_x = 15;          // of d2
  double wall_up_to = INFINITY;  // x at which the finishing tool leaves the wall
  double wall_z = -30;
  double face_z = 0;
  double chamfer_mm = 1;
  double last_z = -61.5;
  double rough_x = 15.3;
  bool rapid_back = false;  // straight through the collar
  bool recut = false;       // d2 again, from its middle
};

nlohmann::json shaft_document() {
  return nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper shaft", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 122,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40},
              {"id": "c1", "kind": "cone", "length_mm": 1, "left_mm": 40, "right_mm": 38},
              {"id": "d2", "kind": "cylinder", "length_mm": 29, "diameter_mm": 30},
              {"id": "c2", "kind": "cone", "length_mm": 1, "left_mm": 30, "right_mm": 28}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})");
}

void rough(Paper& paper, const Shaft& s) {
  paper.operation(OperationKind::rough, {"d2"}, kRougher).rapid(24, 2).rapid(20.3, 2);
  paper.feed(20.3, -61.5).rapid(21.3, -60.5).rapid(21.3, 2);
  for (const double x : {17.6, s.rough_x})
    paper.rapid(x, 2).feed(x, -29.7).rapid(x + 0.5, -29.2).rapid(x + 0.5, 2);
  paper.rapid(100, 2);
}

// Along chamfer, cylinder, wall, chamfer, cylinder with a corner of 0.4 mm: at a chamfer
// the tip keeps r tan(22.5 deg) beside the edge's lines, on it r (1 - 1/sqrt 2) back.
void finish(Paper& paper, const Shaft& s) {
  const double r = 0.4, back = r * (1 - std::sqrt(0.5)), beside = r * (1 - kTan);
  const double c = s.chamfer_mm, x = s.finish_x, z = s.wall_z;
  paper.operation(OperationKind::finish, {"c2", "d2", "c1", "d1"}, kFinisher);
  paper.rapid(24, 4);
  paper.rapid(x - c - 2 - back, 2 - back).feed(x, -c - beside).feed(x, z);
  if (s.wall_up_to < 19) {
    paper.feed(s.wall_up_to, z).rapid(s.wall_up_to + 1, z + 1).rapid(24, z + 1);
    paper.rapid(24, z + 2).feed(20 - c - beside - 2, z + 2);
  } else {
    paper.feed(20 - c - beside, z);
  }
  if (c > 0) paper.feed(20, z - c - beside);
  paper.feed(20, z);
  paper.feed(20, s.last_z).rapid(23, s.last_z + 3);
  if (s.rapid_back) paper.rapid(23, -40).rapid(15, -20);
  paper.rapid(100, 4);
}

Paper shaft(const Shaft& s = {}) {
  Paper paper(shaft_document());
  face(paper, 24, s.face_z);
  rough(paper, s);
  finish(paper, s);
  if (s.recut) {
    paper.operation(OperationKind::finish, {"d2"}, kFinisher).rapid(24, -15);
    paper.feed(15, -15).feed(15, -20).rapid(17, -18).rapid(100, 4);
  }
  return paper;
}

/// A quarter of a circle between two cylinders, cut with a corner of 0.4 mm: its tip goes
/// on a circle of 5.4 mm, whose centre lies 0.4 mm before and below the drawn one, from
/// where the corner touches the smaller cylinder.
Paper arc(bool other_way) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper arc", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 116,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40},
              {"id": "a1", "kind": "arc", "length_mm": 5, "left_mm": 40, "right_mm": 30,
               "radius_mm": 5, "bulge": "convex"},
              {"id": "d2", "kind": "cylinder", "length_mm": 20, "diameter_mm": 30}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  face(paper, 24);
  const double touches = -25 + std::sqrt(5.4 * 5.4 - 0.4 * 0.4) - 0.4;
  paper.operation(OperationKind::fixed, {"d2", "a1", "d1"}, "PROFILE-35")
      .rapid(24, 2)
      .rapid(15, 2);
  paper.feed(15, touches).arc(20, -25.4, 14.6, -25.4, other_way);
  return paper.feed(20, -55.5).rapid(23, -52.5).rapid(100, 2);
}

/// A tube bored to 20 mm, the least that its bar of 16 mm, 11 mm beside the corner, enters:
/// it has half a millimetre beyond the axis, from which lifting takes 0.2 mm.
Paper bore(double x = 10, double lifted_x = 9.8) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper bush", "material": "C45",
    "stock": {"kind": "tube", "outer_mm": 44, "inner_mm": 19.5, "length_mm": 101,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 40, "diameter_mm": 42}],
    "inner": [{"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 30,
               "diameter_mm": 20}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  paper.operation(OperationKind::face, {"right"}, kRougher);
  paper.rapid(24, 2).rapid(24, 0).feed(8, 0).rapid(8, 2).rapid(100, 2);
  paper.operation(OperationKind::finish, {"d1"}, kFinisher).rapid(24, 2).rapid(21, 2);
  paper.feed(21, -40.5).rapid(24, -38).rapid(100, 2);
  paper.operation(OperationKind::bore_finish, {"b1"}, kBar).rapid(lifted_x, 100);
  paper.rapid(lifted_x, 2).rapid(x, 2).feed(x, -30).feed(9.7, -30);
  return paper.rapid(lifted_x - 0.2, -29.8).rapid(lifted_x - 0.2, 100);
}

/// The same hole in a bar, drilled first or not.
Paper drilled_bore(bool bored_first = false, double deeper_mm = 0) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper socket", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 101,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 40, "diameter_mm": 42}],
    "inner": [{"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 30,
               "diameter_mm": 20}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  face(paper, 24);
  paper.operation(OperationKind::finish, {"d1"}, kFinisher).rapid(24, 2).rapid(21, 2);
  paper.feed(21, -40.5).rapid(24, -38).rapid(100, 2);
  const auto drill = [&] {
    paper.operation(OperationKind::fixed, {"b1"}, "DRILL-HM-5D", 9.75).rapid(0, 100);
    paper.rapid(0, 2).feed(0, -30 - 9.75 / std::tan(70 * M_PI / 180) - deeper_mm);
    paper.rapid(0, 100).rapid(100, 100);
  };
  if (!bored_first) drill();
  paper.operation(OperationKind::bore_finish, {"b1"}, kBar).rapid(9.8, 100);
  paper.rapid(9.8, 2).rapid(10, 2).feed(10, -30).feed(9.7, -30).rapid(9.6, -29.8);
  paper.rapid(9.6, 100).rapid(100, 100);
  if (bored_first) drill();
  return paper;
}

/// Turned between chuck and tailstock with the end finished before: the holder, 32 mm from
/// the tip to its far side, stays 0.09 mm clear of the centre's body, which begins
/// 55 - 8.5/2/tan(30 deg) = 47.64 mm before the face.
Paper supported(double from_z = 15.55) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper journal", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 32, "length_mm": 101,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 22, "diameter_mm": 30},
              {"id": "d2", "kind": "cylinder", "length_mm": 18, "diameter_mm": 28}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck-tailstock"]}]})"));
  paper.clamping(Clamping::chuck_tailstock);
  face(paper, 18);
  paper.operation(OperationKind::finish, {"d2"}, kFinisher).rapid(18, 2).rapid(14, 2);
  paper.feed(14, -18).feed(17, -18).rapid(18, -17).rapid(100, -17).rapid(100, 100);
  paper.operation(OperationKind::fixed, {"right"}, "DIN333-A", 4.25).rapid(0, 100);
  paper.rapid(0, 2).feed(0, -8.9).rapid(0, 100);
  paper.rapid(100, 100).stop("stop: bring up the tailstock");
  paper.operation(OperationKind::finish, {"d1"}, kFacer).rapid(100, from_z);
  return paper.rapid(15, from_z).feed(15, -40.5).rapid(18, -38).rapid(100, -38);
}

/// A groove of 4 mm with a blade of 3 mm, and a thread of M30x1.5 that runs out into it, whose
/// pitch diameter lies in the middle of 6g.
struct Screw {
  double groove_x = 13, groove_z = -24;
  double below_basic =
      (15 + 11 * 1.5 + 45 * std::pow(1.5, 0.4) * std::pow(22.4 * 45, 0.05)) / 1000 / 2;
  double thread_x = 15 - 17.0 / 24 * std::sqrt(0.75) * 1.5 - below_basic;
  double thread_to_z = -21.5;
};
Paper screw(const Screw& s = {}) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper screw", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 32, "length_mm": 101,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 16, "diameter_mm": 30},
              {"id": "g1", "kind": "groove", "length_mm": 4, "diameter_mm": 26},
              {"id": "t1", "kind": "thread", "length_mm": 20, "diameter_mm": 30,
               "pitch_mm": 1.5, "limits_mm": [-0.01, 0.01]}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  face(paper, 18);
  paper.operation(OperationKind::finish, {"d1"}, kFinisher).rapid(18, 2).rapid(15, 2);
  paper.feed(15, -40.5).rapid(18, -37).rapid(100, -37);
  paper.operation(OperationKind::fixed, {"g1"}, "GROOVE-EXT", 3).rapid(16, 100);
  paper.rapid(16, s.groove_z).feed(s.groove_x, s.groove_z).rapid(16, s.groove_z);
  paper.rapid(16, -23).feed(s.groove_x, -23).rapid(16, -23).rapid(100, -23);
  paper.operation(OperationKind::fixed, {"t1"}, "THREAD-EXT-60").rapid(16, 4.5);
  paper.rapid(s.thread_x, 4.5).thread(s.thread_x, s.thread_to_z).rapid(16, s.thread_to_z);
  return paper.rapid(100, 4.5);
}

/// An undercut G0.4x0.2 before a wall, with a corner as large as its radius: down a slope to
/// the floor, into the wall, and back to it on a line that leans; DIN 509 has both at
/// 17.5 deg.  Beside a turn by an angle a the tip keeps r tan(a/2).
struct Recess {
  double falls_deg = 17.5, leans_deg = 17.5;
};
Paper recess(const Recess& s = {}) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper recess", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 122,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 31, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 30}],
    "edges": [{"at": "d1|d2", "undercut": "G0.4x0.2"}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  face(paper, 24);
  rough(paper, {});
  const double r = 0.4, depth = 0.2, deep = 0.2, begins = -30 + 0.9;
  const auto rad = [](double deg) { return deg * M_PI / 180; };
  const double a = rad(s.falls_deg), lean = rad(s.leans_deg);
  const double beside = r + r * std::tan(a / 2);
  const double back =
      r * std::sin(lean) + (deep - r * (1 - std::cos(lean))) / std::tan(lean);
  paper.operation(OperationKind::finish, {"d2", "d1"}, "SVHBL-VBMT160404-PF");
  paper.rapid(24, 4).rapid(15, 2).feed(15, begins - beside);
  paper.feed(15 - depth, begins - depth / std::tan(a) - beside);
  paper.feed(15 - depth, -30 - deep);
  paper.feed(15 - depth + back - r * std::tan(lean / 2), -30);
  return paper.feed(20, -30).feed(20, -61.5).rapid(23, -58.5).rapid(100, 4);
}

/// A knurl RGE1 of 30 mm before a wall, with a wheel of 8 mm: its blank has 30 - 2/3 mm, its
/// root 29 mm.
struct Grip {
  double root_x = 14.5, to_z = -29.8;
};
Paper grip(const Grip& s = {}) {
  Paper paper(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "paper grip", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 122,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 31, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 30,
               "knurl": "RGE1"}],
    "faces": [{"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  face(paper, 24);
  rough(paper, {});
  const double blank_x = 15 - 1.0 / 3;
  paper.operation(OperationKind::finish, {"d2", "d1"}, kFinisher);
  paper.rapid(24, 4).rapid(blank_x, 2).feed(blank_x, -30).feed(20, -30).feed(20, -61.5);
  paper.rapid(23, -58.5).rapid(100, 4);
  paper.operation(OperationKind::fixed, {"d2"}, "KNURL-20", 8).rapid(16, -4);
  return paper.feed(s.root_x, -4).feed(s.root_x, s.to_z).rapid(16, s.to_z).rapid(100, 4);
}

TEST(PlantedErrors, ProgramsWithoutErrorsMakeTheirParts) {
  for (const auto& paper : {shaft(), arc(false), bore(), drilled_bore(), supported(),
                            screw(), recess(), grip()})
    EXPECT_EQ(listed(found(paper)), "") << paper.planned().part.drawing.name;
}

struct Planted {
  const char* what;
  Fault fault;
  Paper paper;
};

TEST(PlantedErrors, AreFound) {
  const std::vector<Planted> all = {
      {"a wall not drawn out", Fault::lean, shaft({.wall_up_to = 15.5})},
      {"a contour in two passes", Fault::again, shaft({.wall_up_to = 15.5})},
      {"a radius 5 um too small", Fault::gouge, shaft({.finish_x = 15 - 0.005})},
      {"a radius 5 um too large", Fault::left, shaft({.finish_x = 15 + 0.005})},
      {"no chamfers", Fault::left, shaft({.chamfer_mm = 0})},
      {"a wall 2 um behind", Fault::lean, shaft({.wall_z = -30.002})},
      {"a face 5 um too long", Fault::left, shaft({.face_z = 0.005})},
      {"a rapid through the part", Fault::rapid, shaft({.rapid_back = true})},
      {"into the jaws", Fault::jaws, shaft({.last_z = -66.1})},
      {"a pass that starts on what is finished", Fault::start, shaft({.recut = true})},
      {"roughing into the contour", Fault::gouge, shaft({.rough_x = 14.9})},
      {"an arc the other way", Fault::gouge, arc(true)},
      {"a bore 5 um too wide", Fault::gouge, bore(10.005)},
      {"a bar that lifts too far", Fault::holder, bore(10, 9)},
      {"bored before it is drilled", Fault::holder, drilled_bore(true)},
      {"a drill 0.01 mm too deep", Fault::gouge, drilled_bore(false, 0.01)},
      {"a tool in the tailstock's centre", Fault::centre, supported(17)},
      {"a groove too deep", Fault::gouge, screw({.groove_x = 12.99})},
      {"a groove too narrow", Fault::left, screw({.groove_z = -23.9})},
      {"a thread not cut deep enough", Fault::thread, screw({.thread_x = 14.1})},
      {"a thread into the shoulder", Fault::gouge, screw({.thread_to_z = -24})},
      {"form G's slope at 15 deg", Fault::left, recess({.falls_deg = 15})},
      {"form G into the wall at 15 deg", Fault::gouge, recess({.leans_deg = 15})},
      {"a knurl 5 um too flat", Fault::thread, grip({.root_x = 14.505})},
      {"a knurl half a millimetre short", Fault::thread, grip({.to_z = -29.3})},
      {"a knurl into the wall", Fault::gouge, grip({.to_z = -30.1})}};
  for (const auto& each : all) {
    const auto findings = found(each.paper);
    EXPECT_GT(most(findings, each.fault), -1) << each.what << '\n' << listed(findings);
  }
}

/// The same programs with tools that are not what they are written for.
TEST(PlantedErrors, OfToolsAreFound) {
  const auto with = [](const Paper& paper, const auto& change) {
    auto p = paper.planned();
    for (auto& t : p.part.tools) change(t);
    return simulated(p, paper.programs());
  };
  const auto finisher = [&](const auto& change) {
    return with(shaft(), [&](catalogue::Tool& t) {
      if (t.id == kFinisher) change(t);
    });
  };
  EXPECT_GT(most(finisher([](auto& t) { t.kapr_deg = 88; }), Fault::gouge), 0.1)
      << "a lead angle below 90 deg cuts into the wall's edge";
  EXPECT_GT(most(finisher([](auto& t) {
                   t.insert = "DNMG 150608";
                   t.re_mm = 0.8;
                 }),
                 Fault::left),
            1e-3)
      << "a corner twice as large";
  EXPECT_GT(most(finisher([](auto& t) {
                   t.insert = "DNMG 150602";
                   t.re_mm = 0.2;
                 }),
                 Fault::gouge),
            1e-3)
      << "a corner half as large, on chamfers";
  EXPECT_GE(most(with(bore(),
                      [](catalogue::Tool& t) {
                        if (t.bar)
                          for (auto& s : t.bar->segments) s.diameter_mm += 2;
                      }),
                 Fault::holder),
            0)
      << "a bar 1 mm wider on each side";
  EXPECT_GE(most(with(supported(),
                      [](catalogue::Tool& t) {
                        if (t.holder) t.holder->wf_mm += 1;
                      }),
                 Fault::centre),
            0)
      << "a holder 1 mm wider";
}

// The edge leans by 3 deg behind its sharp corner, which lies where the edges' lines meet:
// S = r (1 - (sin 93 deg + sin 32 deg)/sin 55 deg) over the tip, and along the axis
// r (1 - (cos 32 deg - cos 93 deg)/sin 55 deg) before it.
TEST(PlantedErrors, AWallThatIsNotDrawnOutLeansAsTheEdge) {
  const auto rad = [](double deg) { return deg * M_PI / 180; };
  const double r = 0.4, s = std::sin(rad(55));
  const double s_x = r * (1 - (std::sin(rad(93)) + std::sin(rad(32))) / s);
  const double s_z = r * (1 - (std::cos(rad(32)) - std::cos(rad(93))) / s);
  // The chamfer, cut at 45 deg, takes off what leans more than it is below the edge at
  // 19 mm; the tip was at 15 mm.
  const double t = std::tan(rad(3));
  const double leans = (s_z + (19 - 15 - s_x) * t) / (1 + t);
  EXPECT_NEAR(most(found(shaft({.wall_up_to = 15})), Fault::lean), leans, 1e-3);
}

}  // namespace
}  // namespace turnwright::nc
