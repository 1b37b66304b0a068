#include "chain.hpp"

namespace turnwright::planning {

LastPass last_pass(const Chain& chain, const Station& station, const Choice<double>& c) {
  double e = 0;
  std::size_t k = 0;
  LastPass last;
  for (std::size_t i = 0; i < chain.operations.size(); ++i) {
    const auto& o = chain.operations[i];
    const double ap = o.depth_mm(c.a);
    for (std::size_t p = 0; p < o.passes.size(); ++p, ++k) {
      last = {at(station.passes[k], c.a), &o.cut, ap + (o.face ? 0 : e), c.f[i]};
      if (!o.face) e = yielding_mm(last.law, o.cut, ap, c.f[i], e);
    }
  }
  return last;
}

double correction_mm(const LastPass& pass) {
  return law_mm<double>({pass.law.p, pass.law.q, pass.law.s, pass.law.r},
                        cutting::forces_N(*pass.cut, pass.depth_mm, pass.f_mm_rev));
}

double corrected_error_mm(const LastPass& pass, double s) {
  return yielding_mm(pass.law, *pass.cut, pass.depth_mm + s, pass.f_mm_rev, 0) - s;
}

}  // namespace turnwright::planning
