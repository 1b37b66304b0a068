#include "gauge.hpp"

#include <array>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

constexpr double kShare = 0.2;        // of the width that the uncertainty may take
constexpr double kCompared_um = 1.6;  // below it plates to compare with do not tell

struct Gauge {
  const char* name;
  double U_um;
};
/// The simplest first; the last is for whatever is left.
using Gauges = std::array<Gauge, 4>;

const Gauges& gauges(Measured measured) {
  static const Gauges kOutside{{{"calliper", 30},
                                {"micrometer", 4},
                                {"indicating snap gauge", 1},
                                {"comparator, measuring room", 0}}};
  static const Gauges kInside{{{"calliper, inside jaws", 40},
                               {"three-point micrometer", 4},
                               {"bore gauge, set in a ring", 1.5},
                               {"air plug, measuring room", 0}}};
  static const Gauges kLength{{{"calliper", 30},
                               {"depth micrometer", 6},
                               {"indicator and gauge blocks", 2},
                               {"comparator, measuring room", 0}}};
  static const Gauges kRunout{{{"dial indicator 0.01", 10},
                               {"lever indicator 0.002", 2},
                               {"lever indicator 0.001", 1},
                               {"form tester, measuring room", 0}}};
  static const Gauges kForm{{{"dial indicator 0.01", 15},
                             {"lever indicator 0.002", 4},
                             {"lever indicator 0.001", 2},
                             {"form tester, measuring room", 0}}};
  switch (measured) {
    case Measured::outside:
      return kOutside;
    case Measured::inside:
      return kInside;
    case Measured::length:
      return kLength;
    case Measured::runout:
      return kRunout;
    case Measured::form:
      break;
  }
  return kForm;
}

}  // namespace

std::string gauge(Measured measured, double width_mm) {
  if (!(width_mm > 0)) throw std::domain_error("gauge: the width must be > 0");
  const auto& all = gauges(measured);
  for (const auto& g : all)
    if (g.U_um <= kShare * units::um_from_mm(width_mm)) return g.name;
  return all.back().name;
}

std::string roughness_gauge(double Ra_um) {
  return Ra_um < kCompared_um ? "roughness tester" : "comparison plates";
}

}  // namespace turnwright::report
