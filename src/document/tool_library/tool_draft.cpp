#include "tool_draft.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/reader.hpp"
#include "drafted_insert.hpp"
#include "drafted_shank.hpp"
#include "tool_estimates.hpp"
#include "turnwright/catalogue/tool_outline.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;

ordered_json range(const catalogue::Range& r) {
  return {rounded(r.lower), rounded(r.upper)};
}

class Drafting {
 public:
  Drafting(const LibraryTool& tool, ToolDraft& out)
      : tool_(tool),
        out_(out),
        remarks_{[&out](const char* member, std::string sentence) {
                   out.assumed.push_back({member, std::move(sentence)});
                 },
                 [&out](std::string sentence) {
                   out.contradictions.push_back(std::move(sentence));
                 }} {
    std::vector<std::string> texts{tool.insert, tool.holder};
    texts.insert(texts.end(), tool.texts.begin(), tool.texts.end());
    printed_ = printed_designations(texts);
  }

  void draft(const std::string& groups) {
    insert_ = drafted_insert(from_);
    kapr_deg_ = edge_angle_deg();
    auto& d = out_.document;
    d["format"] = "turnwright-tool/1";
    d["id"] = "";
    d["name"] = shortened(tool_.name.empty() ? insert_.designation : tool_.name, 200);
    d["insert"] = insert_.designation;
    d["uses"] = uses();
    d["groups"] = groups_of(groups);
    d["geometry"] = geometry();
    d["window"] = window();
    add_what_no_library_says();
    add_carrier();
  }

 private:
  struct Angle {
    std::string what;
    double deg;
  };

  std::vector<Angle> angles() {
    std::vector<Angle> all;
    if (printed_.holder || printed_.bar) {
      const double deg =
          printed_.holder ? printed_.holder->kapr_deg : printed_.bar->kapr_deg;
      if (holds(printed_, insert_))
        all.push_back({printed_.holder_text, deg});
      else
        remarks_.contradict(say("{} is named, which does not hold {}: it is not used.",
                                printed_.holder_text, insert_.designation));
    }
    if (tool_.KAPR_deg) all.push_back({"KAPR", *tool_.KAPR_deg});
    if (tool_.PSIR_deg) all.push_back({"PSIR", 90 - *tool_.PSIR_deg});
    if (tool_.style)
      if (const auto deg = catalogue::style_kapr_deg(*tool_.style))
        all.push_back({say("style {}", *tool_.style), *deg});
    return all;
  }

  double edge_angle_deg() {
    constexpr double kSame_deg = 1;  // makers print 107 for 107.5 deg
    const auto all = angles();
    if (all.empty()) {
      remarks_.assume(
          "/geometry/kapr_deg",
          tr("The edge angle is not said: that of the usual holder of this shape."));
      return usual_kapr_deg(insert_.insert.shape);
    }
    for (const auto& other : all)
      if (!(std::abs(other.deg - all[0].deg) <= kSame_deg))
        remarks_.contradict(
            say("{} has an edge angle of {:g} deg, {} of {:g} deg: the first is taken.",
                all[0].what, all[0].deg, other.what, other.deg));
    return rounded(all[0].deg);
  }

  std::vector<std::string> groups_of(const std::string& otherwise) {
    constexpr std::string_view kGroups = "PMKNSH";
    const auto in = [&](const std::string& letters) {
      std::vector<std::string> out;
      for (const char group : kGroups)
        if (letters.find(group) != letters.npos) out.emplace_back(1, group);
      return out;
    };
    if (auto said = in(tool_.groups); !said.empty()) return said;
    remarks_.assume("/groups", say("The groups of materials are not said: {}.",
                                   fmt::join(in(otherwise), ", ")));
    return in(otherwise);
  }

  std::vector<std::string> uses() {
    if (tool_.boring) return {"boring"};
    remarks_.assume(
        "/uses", tr("What it may do is not said: what its corner and edge angle allow."));
    return usual_uses(insert_.insert, kapr_deg_, insert_.re_mm);
  }

  double minor_angle_deg() {
    const auto corner_deg = *catalogue::included_angle_deg(insert_.insert.shape);
    if (tool_.EPSR_deg && *tool_.EPSR_deg != corner_deg)
      remarks_.contradict(
          say("EPSR is {} deg, but the insert is {}: the insert is taken.",
              number_text(*tool_.EPSR_deg), insert_.designation));
    const auto minor_deg = catalogue::minor_angle_deg(kapr_deg_, insert_.insert);
    if (!(*minor_deg > 0))
      throw std::domain_error(
          say("KAPR {:g} deg and the corner of {} leave no angle to the minor edge.",
              kapr_deg_, insert_.designation));
    return *minor_deg;
  }

  ordered_json geometry() {
    const double minor_deg = minor_angle_deg();
    if (!tool_.GAMO_deg)
      remarks_.assume(
          "/geometry/gamma_deg",
          tr("The rake is not said: that of the usual holder and chip groove."));
    const double said_pct = 2, rake_pct = 20;
    return estimated(
        {{"kapr_deg", kapr_deg_},
         {"minor_kapr_deg", rounded(minor_deg)},
         {"gamma_deg", tool_.GAMO_deg.value_or(usual_rake_deg(insert_.insert))},
         {"alpha_deg", usual_clearance_deg(insert_.insert)},
         {"re_mm", rounded(insert_.re_mm)}},
        to_translate(
            "the library's insert and holder; minor angle = 180 - KAPR - corner angle; "
            "rake as `assumed` says"),
        tool_.GAMO_deg ? said_pct : rake_pct);
  }

  // Between the smallest and the largest number of the presets, and a margin.
  template <class Member>
  catalogue::Range about_presets(Member member, const catalogue::Range& margin) const {
    catalogue::Range r{0, 0};
    for (const auto& preset : tool_.presets) {
      const double x = preset.*member;
      if (!(x > 0)) continue;
      r.lower = r.upper > 0 ? std::min(r.lower, margin.lower * x) : margin.lower * x;
      r.upper = std::max(r.upper, margin.upper * x);
    }
    return r;
  }

  catalogue::Range feeds_mm_rev() {
    constexpr double kMostOfCorner = 0.8;
    auto feeds = about_presets(&LibraryPreset::f_mm_rev, {0.6, 1.5});
    if (feeds.upper > 0) {
      feeds.upper = std::min(feeds.upper, kMostOfCorner * insert_.re_mm);
      if (feeds.lower < feeds.upper) return feeds;
      remarks_.contradict(
          say("The presets' feed is more than the corner of {} bears: the usual feed is "
              "taken.",
              mm_text(rounded(insert_.re_mm))));
    }
    remarks_.assume("/window/f_mm_rev",
                    tr("The feed is not said: 0.15 to 0.6 of the corner radius."));
    return usual_feed_mm_rev(insert_.re_mm);
  }

  catalogue::Range depths_mm() {
    auto depths = usual_depth_mm(insert_.insert, insert_.re_mm);
    if (!tool_.APMX_mm) {
      remarks_.assume("/window/ap_mm",
                      tr("The depth is not said: from 0.6 of the corner radius to a "
                         "quarter of the edge, an eighth of corners below 60 deg."));
      return depths;
    }
    depths.upper = *tool_.APMX_mm;
    depths.lower = std::min(depths.lower, depths.upper);
    return depths;
  }

  ordered_json window() {
    auto speeds = about_presets(&LibraryPreset::vc_m_min, {0.6, 1.4});
    if (!(speeds.upper > 0)) {
      speeds = {20, 400};
      remarks_.assume("/window/vc_m_min",
                      tr("The speed is not said: 20 to 400 m/min, all materials."));
    }
    return estimated(
        {{"f_mm_rev", range(feeds_mm_rev())},
         {"ap_mm", range(depths_mm())},
         {"vc_m_min", range(speeds)}},
        to_translate(
            "about the library's presets, where there are any: 60 to 150 % of their "
            "feed, "
            "60 to 140 % of their speed; else estimates from the insert's size"));
  }

  void add_what_no_library_says() {
    auto& d = out_.document;
    const auto& w = d["window"];
    const double most_N = usual_strength_N(w["f_mm_rev"][1], w["ap_mm"][1]);
    d["strength"] = estimated({{"Fc_max_N", 10 * std::round(most_N / 10)}});
    d["life"] = estimated({{"T_min", {10, 100000}}});
    d["economics"] = estimated({{"change_min", 1}, {"edge_cost", 3}});
    remarks_.assume("/strength", tr("The strength is not said: the force of the window's "
                                    "largest feed and depth at 2500 MPa."));
    remarks_.assume("/life", tr("The life is not said: 10 min and longer."));
    remarks_.assume("/economics",
                    tr("Costs are not said: 3 an edge, 1 min to change it."));
  }

  void add_carrier() {
    auto& d = out_.document;
    if (tool_.boring) {
      d["bar"] = drafted_bar(from_, insert_);
    } else if (auto holder = drafted_holder(from_, insert_); !holder.is_null()) {
      d["holder"] = std::move(holder);
    } else {
      remarks_.assume("/holder",
                      tr("There is no metric holder of ISO 5608 with all of H, B, LF, LH "
                         "and WF: the outline is the insert alone."));
    }
  }

  const LibraryTool& tool_;
  ToolDraft& out_;
  DraftRemarks remarks_;
  PrintedDesignations printed_;
  DraftSource from_{tool_, printed_, remarks_};
  DraftedInsert insert_;
  double kapr_deg_ = 0;
};

}  // namespace

ToolDraft tool_draft(const LibraryTool& tool, const std::string& groups) {
  ToolDraft out;
  try {
    Drafting(tool, out).draft(groups);
  } catch (const std::domain_error& why) {
    out.refused = why.what();
  }
  return out;
}

}  // namespace turnwright::document
