#include <fmt/format.h>

#include "dxf_dimensions.hpp"
#include "dxf_styles.hpp"
#include "dxf_text.hpp"
#include "exchange/contour/thread_undercut.hpp"
#include "exchange/text/notation_words.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/exchange/dxf.hpp"

namespace turnwright::exchange {
namespace {

void append(std::vector<Remark>& to, std::vector<Remark>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

Outline read_dxf(std::string_view text, const DxfOptions& options) {
  if (!(options.join_mm > 0 && options.join_mm <= 1))
    dxf::refuse("join_mm", fmt::format("{}", options.join_mm),
                tr("a number > 0 and <= 1 mm"));
  std::string converted;
  if (notated::utf8_length(text) < text.size()) {
    converted = dxf::in_utf8(text);
    text = converted;
  }
  const dxf::File file = dxf::read_file(text);
  std::vector<Remark> not_read;
  dxf::check_styles(file, not_read);
  dxf::Drawn drawn = dxf::draw(file, options.unit_mm);
  dxf::ProfileRead read = dxf::profile_of(drawn, options.join_mm);
  Outline out = outline_of(read.profile, options.join_mm);
  double z0 = read.profile.sides.front().from.z_mm;
  for (const Side& s : read.profile.sides) z0 = std::min({z0, s.from.z_mm, s.to.z_mm});
  dxf::add_dimensions(out, read.view, z0, options.join_mm);
  settle_thread_undercuts(out);
  append(out.assumed, drawn.assumed);
  append(out.assumed, read.assumed);
  append(out.ignored, drawn.ignored);
  append(out.ignored, read.ignored);
  append(out.ignored, not_read);
  return out;
}

}  // namespace turnwright::exchange
