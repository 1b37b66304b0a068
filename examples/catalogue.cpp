// What the designations of an insert and its holder say.
#include <cstdio>

#include "turnwright/catalogue/tool.hpp"

int main() {
  using namespace turnwright::catalogue;
  const Insert1832 insert = decode_iso1832("CNMG 120408-PM");
  const Holder5608 holder = decode_iso5608("PCLNL 2525M 12");
  std::printf("insert: corner %.1f mm, angle %.0f deg, edge %.2f mm long\n", insert.re_mm,
              insert.included_angle_deg, insert.edge_length_mm);
  std::printf("holder: cutting edge angle %.0f deg, shank %.0f x %.0f mm\n",
              holder.kapr_deg, holder.h_mm, holder.b_mm);
}
