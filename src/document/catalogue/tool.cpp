#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"
#include "turnwright/catalogue/chip_window.hpp"
#include "turnwright/catalogue/tool_codes.hpp"
#include "turnwright/catalogue/tool_outline.hpp"

namespace turnwright::document {
namespace {

const Choices<catalogue::ToolUse> kUses{{"roughing", catalogue::ToolUse::roughing},
                                        {"finishing", catalogue::ToolUse::finishing},
                                        {"facing", catalogue::ToolUse::facing},
                                        {"boring", catalogue::ToolUse::boring}};

void read_turning_geometry(Reader group, catalogue::Tool& t) {
  Bounds edge = above_up_to(0, 180, "deg");
  edge.upper_open = true;
  t.kapr_deg = group.number("kapr_deg", edge);
  t.minor_kapr_deg = group.number("minor_kapr_deg", edge);
  t.gamma_deg = group.number("gamma_deg", within(-30, 45, "deg"));
  t.alpha_deg = group.number("alpha_deg", above_up_to(0, 45, "deg"));
  t.re_mm = group.number("re_mm", within(0, 20, "mm"));
  t.wiper = group.boolean_or("wiper", false);
  finish_group(group);
  if (t.kapr_deg + t.minor_kapr_deg >= 180)
    group.problem_at("minor_kapr_deg",
                     tr("a corner: kapr_deg + minor_kapr_deg < 180 deg"), "conflict");
  if (t.alpha_deg + t.gamma_deg >= 90)
    group.problem_at("gamma_deg", tr("a wedge: alpha_deg + gamma_deg < 90 deg"),
                     "conflict");
}

const Bounds kFeed = above_up_to(0, 5, "mm/rev"), kDepth = above_up_to(0, 50, "mm");

// A polygon's ranges are those given or, if these are left out, as wide as it is.
void read_chip_window(Reader& group, catalogue::Tool& t) {
  std::vector<catalogue::ChipPoint> polygon;
  const auto faults = [&] {
    return group.problems().list.size() + group.problems().more;
  };
  const auto before = faults();
  for (const auto& item : group.items("chip_window", 3, 20)) {
    const auto point = item.as_items(2, 2);
    if (point.size() == 2)
      polygon.push_back({point[0].as_number(kDepth), point[1].as_number(kFeed)});
  }
  if (faults() > before) return;
  if (!catalogue::is_simple(polygon)) {
    group.problem_at("chip_window",
                     tr("corners [ap_mm, f_mm_rev] of one area whose edges do not cross"),
                     "conflict");
    return;
  }
  t.chip = catalogue::convex_pieces(polygon);
  catalogue::Range ap = t.chip[0].ap_mm, f = t.chip[0].f_mm_rev;
  for (const auto& piece : t.chip) {
    ap = {std::min(ap.lower, piece.ap_mm.lower), std::max(ap.upper, piece.ap_mm.upper)};
    f = {std::min(f.lower, piece.f_mm_rev.lower),
         std::max(f.upper, piece.f_mm_rev.upper)};
  }
  const auto within = [&](const char* key, catalogue::Range& given,
                          const catalogue::Range& polygons) {
    if (!group.has(key)) given = polygons;
    if (given.lower >= polygons.upper || given.upper <= polygons.lower)
      group.problem_at(key, tr("a range that chip_window reaches"), "conflict");
  };
  within("ap_mm", t.ap_mm, ap);
  within("f_mm_rev", t.f_mm_rev, f);
}

void read_window(Reader group, catalogue::Tool& t) {
  const bool polygon = group.has("chip_window");
  if (!polygon || group.has("f_mm_rev"))
    t.f_mm_rev = read_range(group, "f_mm_rev", kFeed);
  if (!polygon || group.has("ap_mm")) t.ap_mm = read_range(group, "ap_mm", kDepth);
  if (polygon) read_chip_window(group, t);
  t.vc_m_min = read_range(group, "vc_m_min", above_up_to(0, 5000, "m/min"));
  finish_group(group);
}

catalogue::BarSegment read_bar_segment(Reader r) {
  r = r.as_object();
  const auto size = above_up_to(0, 2000, "mm");
  catalogue::BarSegment s{.length_mm = r.number("length_mm", size),
                          .diameter_mm = r.number("diameter_mm", size),
                          .bore_mm = r.number_or("bore_mm", within(0, 2000, "mm"), 0)};
  if (s.bore_mm >= s.diameter_mm)
    r.problem_at("bore_mm", tr("less than diameter_mm"), "order");
  r.finish();
  return s;
}

catalogue::BoringBar read_bar(Reader group) {
  catalogue::BoringBar bar;
  bar.E_MPa = group.number("E_MPa", within(1e3, 1e6, "MPa"));
  bar.nu = group.number("nu", at_least_below(0, 0.5));
  for (const auto& segment : group.items("segments", 1, 20))
    bar.segments.push_back(read_bar_segment(segment));
  bar.longest_mm = group.optional_number("longest_mm", above_up_to(0, 2000, "mm"));
  bar.tip_offset_mm = group.number("tip_offset_mm", within(0, 1000, "mm"));
  bar.min_bore_mm = group.number("min_bore_mm", above_up_to(0, 20000, "mm"));
  bar.holder = read_compliance(group.object("holder"));
  bar.tip_mm_N = group.optional_number("tip_mm_N", above_up_to(0, 0.1, "mm/N"));
  bar.damping_ratio = group.optional_number("damping_ratio", kDamping);
  finish_group(group);
  if (bar.longest_mm && *bar.longest_mm < catalogue::stick_out_mm(bar))
    group.problem_at("longest_mm", tr("at least the length of the segments"), "conflict");
  if (bar.longest_mm && bar.tip_mm_N)
    group.problem_at(
        "longest_mm",
        tr("no longest stick-out: tip_mm_N was measured at that of the segments"),
        "conflict");
  for (const auto& s : bar.segments)
    if (s.diameter_mm / 2 > bar.min_bore_mm - bar.tip_offset_mm)
      group.problem_at("min_bore_mm",
                       tr("a hole with room for shank and corner: at least tip_offset_mm "
                          "and half of every diameter_mm"),
                       "conflict");
  return bar;
}

// A holder's designation agrees with its dimensions, with the insert and with the angles
// of the edges, so that insert and holder are one body.
void check_holder(Reader& group, const catalogue::Holder& h, const catalogue::Tool& t) {
  const auto conflict = [&](bool agrees, const char* key, const std::string& expected) {
    if (!agrees) group.problem_at(key, expected, "conflict");
  };
  try {
    const auto insert = catalogue::decode_iso1832(t.insert);
    const auto coded = catalogue::decode_iso5608(h.designation);
    conflict(coded.insert_shape == insert.shape &&
                 coded.edge_code == std::lround(10 * insert.edge_length_mm) / 10,
             "designation", say("a holder of the insert {}", t.insert));
    conflict(coded.kapr_deg == t.kapr_deg, "designation",
             say("a style whose KAPR is geometry/kapr_deg, {} deg, not {} deg",
                 number_text(t.kapr_deg), number_text(coded.kapr_deg)));
    conflict(coded.h_mm == h.h_mm && coded.b_mm == h.b_mm &&
                 coded.lf_mm.value_or(h.lf_mm) == h.lf_mm,
             "designation", tr("the size that h_mm, b_mm and lf_mm give"));
    const auto minor = catalogue::minor_angle_deg(t.kapr_deg, insert);
    conflict(
        !minor || t.wiper || std::abs(*minor - t.minor_kapr_deg) < 0.01, "designation",
        tr("an insert whose angle, with kapr_deg and minor_kapr_deg, makes 180 deg"));
  } catch (const std::domain_error& error) {
    group.problem_at("designation", say("an ISO 5608 designation ({})", error.what()),
                     "choice");
  }
}

catalogue::Holder read_holder(Reader group, const catalogue::Tool& t) {
  const auto size = above_up_to(0, 1000, "mm");
  catalogue::Holder h;
  h.designation = group.text("designation", 40);
  h.h_mm = group.number("h_mm", size);
  h.b_mm = group.number("b_mm", size);
  h.lf_mm = group.number("lf_mm", size);
  h.lh_mm = group.number("lh_mm", size);
  h.wf_mm = group.number("wf_mm", size);
  finish_group(group);
  if (h.lh_mm >= h.lf_mm) group.problem_at("lh_mm", tr("less than lf_mm"), "order");
  check_holder(group, h, t);
  return h;
}

// The designation must be one of ISO 1832 and agree with the corner radius given, which may
// be an inch size.
void check_insert(Reader& r, const catalogue::Tool& t) {
  if (t.insert.empty()) return;
  try {
    const auto insert = catalogue::decode_iso1832(t.insert);
    if (std::isfinite(t.re_mm) && !catalogue::is_corner_of(insert, t.re_mm))
      r.problem_at("insert",
                   say("a designation whose corner is geometry/re_mm, {} mm, not {} mm",
                       number_text(t.re_mm), number_text(insert.re_mm)),
                   "conflict");
  } catch (const std::domain_error& error) {
    r.problem_at("insert", say("an ISO 1832 designation ({})", error.what()), "choice");
  }
}

}  // namespace

catalogue::Tool read_tool(Reader r) {
  catalogue::Tool t;
  r = r.as_object();
  read_required_format(r, "turnwright-tool/1");
  t.id = read_id(r);
  t.name = r.text("name");
  t.insert = r.text("insert", 40);
  t.uses = read_set(r, "uses", kUses);
  t.groups = read_set(r, "groups", iso_groups());
  read_turning_geometry(r.object("geometry"), t);
  read_window(r.object("window"), t);
  if (auto rounding = r.optional_object("rounding")) {
    t.edge_um = rounding->number("edge_um", kEdgeRadius);
    finish_group(*rounding);
  }
  Reader strength = r.object("strength");
  t.Fc_max_N = strength.number("Fc_max_N", above_up_to(0, 1e6, "N"));
  finish_group(strength);
  Reader life = r.object("life");
  t.T_min = read_range(life, "T_min", above_up_to(0, 1e5, "min"));
  finish_group(life);
  Reader economics = r.object("economics");
  t.change_min = economics.number("change_min", within(0, 1000, "min"));
  t.edge_cost = economics.number("edge_cost", within(0, 1e5));
  finish_group(economics);
  const bool bores =
      std::find(t.uses.begin(), t.uses.end(), catalogue::ToolUse::boring) != t.uses.end();
  if (bores || r.has("bar")) t.bar = read_bar(r.object("bar"));
  check_insert(r, t);
  if (r.has("holder")) t.holder = read_holder(r.object("holder"), t);
  r.finish();
  return t;
}

}  // namespace turnwright::document
