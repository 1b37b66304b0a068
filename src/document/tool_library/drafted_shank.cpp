#include "drafted_shank.hpp"

#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/reader.hpp"
#include "tool_estimates.hpp"

namespace turnwright::document {
namespace {

using catalogue::Holder5608;

// The shank's sizes as a designation codes them.
constexpr double kCodeOff_mm = 0.05;
bool is_coded(const std::optional<double>& said, double coded_mm) {
  return said && std::abs(*said - coded_mm) <= kCodeOff_mm;
}
bool is_whole(const std::optional<double>& said) {
  return is_coded(said, std::round(said.value_or(0)));
}

double shank_mm(const DraftSource& from, const DraftedInsert& insert) {
  const auto& said = from.tool.DCON_mm;
  const bool named = from.printed.bar && holds(from.printed, insert);
  if (!named && !said)
    throw std::domain_error(tr("Its shank is not said: DCON, or a bar's designation."));
  if (!named) return *said;
  const double d = from.printed.bar->diameter_mm;
  if (said && !is_coded(said, d))
    from.remarks.contradict(
        say("{} has a shank of {}, the library says {}: the name is taken.",
            from.printed.holder_text, mm_text(d), mm_text(rounded(*said))));
  return d;
}

// WF of another shank than the named one is another bar's.
double tip_offset_mm(const DraftSource& from, double d_mm) {
  constexpr double kUsual = 0.7;
  const auto& said = from.tool.WF_mm;
  const bool same_shank = is_coded(from.tool.DCON_mm.value_or(d_mm), d_mm);
  if (said && same_shank && *said > d_mm / 2) return *said;
  from.remarks.assume(
      "/bar/tip_offset_mm",
      tr("The distance of the corner from the bar's axis (WF) is not said, lies within "
         "the shank or is another bar's: 0.7 of the shank's diameter."));
  return kUsual * d_mm;
}

double least_bore_mm(const DraftSource& from, double d_mm, double offset_mm) {
  constexpr double kRoom_mm = 1;
  const double tight_mm = d_mm / 2 + offset_mm;
  const auto& said = from.tool.DMIN_mm;
  if (said && *said >= tight_mm) return *said;
  if (said)
    from.remarks.contradict(
        say("DMIN is {}, in which shank and corner do not fit: {} is taken.",
            mm_text(rounded(*said)), mm_text(rounded(tight_mm + kRoom_mm))));
  else
    from.remarks.assume("/bar/min_bore_mm",
                        tr("The smallest bore is not said: shank, corner and 1 mm."));
  return tight_mm + kRoom_mm;
}

// The printed holder, if the library's sizes are its own.
std::optional<Holder5608> printed_shank(const DraftSource& from) {
  const auto& t = from.tool;
  const auto& h = *from.printed.holder;
  if (is_coded(t.H_mm, h.h_mm) && is_coded(t.B_mm, h.b_mm) &&
      is_coded(t.LF_mm, h.lf_mm.value_or(t.LF_mm.value_or(0))))
    return h;
  if (t.H_mm && t.B_mm && t.LF_mm)
    from.remarks.contradict(
        say("{} is named, but H x B is {:g} x {:g} mm and LF {:g} mm: no shank is taken.",
            from.printed.holder_text, *t.H_mm, *t.B_mm, *t.LF_mm));
  return std::nullopt;
}

std::optional<Holder5608> shank_by_sizes(const LibraryTool& t,
                                         const catalogue::Insert1832& insert) {
  if (!is_whole(t.H_mm) || !is_whole(t.B_mm) || !t.LF_mm || !t.hand) return std::nullopt;
  Holder5608 h;
  h.insert_shape = insert.shape;
  h.clearance_deg = insert.clearance_deg;
  h.hand = *t.hand;
  h.h_mm = std::round(*t.H_mm);
  h.b_mm = std::round(*t.B_mm);
  h.lf_mm = is_whole(t.LF_mm) ? std::round(*t.LF_mm) : *t.LF_mm;
  h.edge_code = static_cast<int>(std::lround(10 * insert.edge_length_mm) / 10);
  return h;
}

// "" for letters and sizes that no designation has.
std::string named_by_letters(const LibraryTool& t, const Holder5608& h) {
  if (!t.clamping || !t.style) return "";
  try {
    return catalogue::encode_iso5608(*t.clamping, *t.style, h);
  } catch (const std::domain_error&) {
    return "";
  }
}

}  // namespace

nlohmann::ordered_json drafted_bar(const DraftSource& from, const DraftedInsert& insert) {
  constexpr double kOverhang = 4;  // diameters, which steel bars bear
  const double d_mm = shank_mm(from, insert), offset_mm = tip_offset_mm(from, d_mm);
  const bool carbide = from.printed.bar && from.printed.bar->shank == 'E';
  if (!from.tool.OHX_mm)
    from.remarks.assume("/bar/segments", tr("The overhang is not said: 4 diameters."));
  from.remarks.assume("/bar/holder",
                      tr("The stiffness of block and sleeve is one usual for a turret."));
  return estimated(
      {{"E_MPa", carbide ? 600000 : 210000},
       {"nu", carbide ? 0.22 : 0.3},
       {"segments",
        {{{"length_mm", rounded(from.tool.OHX_mm.value_or(kOverhang * d_mm))},
          {"diameter_mm", rounded(d_mm)}}}},
       {"tip_offset_mm", rounded(offset_mm)},
       {"min_bore_mm", rounded(least_bore_mm(from, d_mm, offset_mm))},
       {"holder",
        {{"c0_mm_N", 1.6666667e-05}, {"c1_rad_N", 0}, {"c2_rad_Nmm", 2.5e-09}}}},
      to_translate("shank of the library; overhang, block and what else was assumed are "
                   "estimates"));
}

nlohmann::ordered_json drafted_holder(const DraftSource& from,
                                      const DraftedInsert& insert) {
  constexpr double kSaid_pct = 10;
  const auto& t = from.tool;
  const bool named = from.printed.holder && holds(from.printed, insert);
  const auto h = named ? printed_shank(from) : shank_by_sizes(t, insert.insert);
  if (!h || !t.LH_mm || !t.WF_mm) return nullptr;
  const auto designation = named ? from.printed.holder_text : named_by_letters(t, *h);
  if (designation.empty()) return nullptr;
  return estimated({{"designation", designation},
                    {"h_mm", h->h_mm},
                    {"b_mm", h->b_mm},
                    {"lf_mm", h->lf_mm.value_or(*t.LF_mm)},
                    {"lh_mm", rounded(*t.LH_mm)},
                    {"wf_mm", rounded(*t.WF_mm)}},
                   to_translate("the library's holder"), kSaid_pct);
}

}  // namespace turnwright::document
