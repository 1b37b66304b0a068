#include "gauge.hpp"

#include <array>
#include <stdexcept>

#include "turnwright/base/language.hpp"
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
  static const Gauges kOutside{{{to_translate("calliper"), 30},
                                {to_translate("micrometer"), 4},
                                {to_translate("indicating snap gauge"), 1},
                                {to_translate("comparator, measuring room"), 0}}};
  static const Gauges kInside{{{to_translate("calliper, inside jaws"), 40},
                               {to_translate("three-point micrometer"), 4},
                               {to_translate("bore gauge, set in a ring"), 1.5},
                               {to_translate("air plug, measuring room"), 0}}};
  static const Gauges kLength{{{to_translate("calliper"), 30},
                               {to_translate("depth micrometer"), 6},
                               {to_translate("indicator and gauge blocks"), 2},
                               {to_translate("comparator, measuring room"), 0}}};
  static const Gauges kRunout{{{to_translate("dial indicator 0.01"), 10},
                               {to_translate("lever indicator 0.002"), 2},
                               {to_translate("lever indicator 0.001"), 1},
                               {to_translate("form tester, measuring room"), 0}}};
  static const Gauges kForm{{{to_translate("dial indicator 0.01"), 15},
                             {to_translate("lever indicator 0.002"), 4},
                             {to_translate("lever indicator 0.001"), 2},
                             {to_translate("form tester, measuring room"), 0}}};
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
    if (g.U_um <= kShare * units::um_from_mm(width_mm)) return tr(g.name);
  return tr(all.back().name);
}

std::string roughness_gauge(double Ra_um) {
  return Ra_um < kCompared_um ? tr("roughness tester") : tr("comparison plates");
}

}  // namespace turnwright::report
