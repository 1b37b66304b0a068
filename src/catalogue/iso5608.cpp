#include <array>
#include <string>
#include <string_view>

#include "designation.hpp"
#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {
namespace {

constexpr std::string_view kStyles = "ABCDEFGHJKLMNRSTUVWY";
constexpr std::array kStyleKapr_deg{90.0,  75.0, 90.0, 45.0, 60.0, 90.0, 90.0,
                                    107.5, 93.0, 75.0, 95.0, 50.0, 63.0, 75.0,
                                    45.0,  60.0, 93.0, 72.5, 60.0, 85.0};
static_assert(kStyles.size() == kStyleKapr_deg.size());

constexpr std::string_view kLengths = "ABCDEFGHJKLMNPQRSTUVWY";
constexpr std::array kLengths_mm{32.0,  40.0,  50.0,  60.0,  70.0,  80.0,  90.0,  100.0,
                                 110.0, 125.0, 140.0, 150.0, 160.0, 170.0, 180.0, 200.0,
                                 250.0, 300.0, 350.0, 400.0, 450.0, 500.0};
static_assert(kLengths.size() == kLengths_mm.size());

}  // namespace

Holder5608 decode_iso5608(const std::string& designation) {
  Designation reader("decode_iso5608", designation);
  Holder5608 holder;
  reader.take_one_of("CDMPSW");
  holder.insert_shape = reader.take_one_of("CDEHMOPRSTVW");
  holder.kapr_deg = kStyleKapr_deg[kStyles.find(reader.take_one_of(kStyles))];
  const auto clearance = clearance_deg(reader.take(1).front());
  if (!clearance) reader.fail("must be one of ABCDEFGNP");
  holder.clearance_deg = *clearance;
  holder.hand = reader.take_one_of("RLN");
  holder.h_mm = reader.take_two_digits();
  holder.b_mm = reader.take_two_digits();
  const char length = reader.take_one_of(std::string(kLengths) + "X-");
  if (const auto at = kLengths.find(length); at != std::string_view::npos)
    holder.lf_mm = kLengths_mm[at];
  holder.edge_code = reader.take_two_digits();
  return holder;
}

}  // namespace turnwright::catalogue
