#include "hole_tool_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "tool_estimates.hpp"
#include "turnwright/base/pattern.hpp"
#include "turnwright/part/inch_thread.hpp"
#include "turnwright/part/metric_thread.hpp"

namespace turnwright::document {
namespace {

using nlohmann::ordered_json;

constexpr const char* kAsInCatalogue = to_translate(
    "not in the library: estimates for high-speed steel, as in the shipped catalogue");
constexpr double kLeadPitches = 2.5;  // form C
constexpr double kLead_mm = 1.5;      // of a machine reamer

// "M8x1.25" and "M8" of the coarse series are one thread.
std::string metric(double d_mm, double pitch_mm) {
  constexpr double kSame_mm = 1e-6;
  const auto coarse = part::coarse_pitch_mm(d_mm);
  return coarse && std::abs(*coarse - pitch_mm) < kSame_mm
             ? fmt::format("M{:g}", d_mm)
             : fmt::format("M{:g}x{:g}", d_mm, pitch_mm);
}

// The threads that stand in a text.
std::vector<std::string> threads_in(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  static const Pattern kMetric(
      R"((?:^|[^A-Za-z0-9])M(\d{1,3}(?:[.,]\d{1,3})?)(?:\s*[xX]\s*(\d{1,2}(?:[.,]\d{1,3})?))?)");
  static const Pattern kInch(
      R"((?:^|[^\d.#/-])((?:#\d{1,2}|(?:\d{1,2}-)?\d{1,2}/\d{1,2})-\d{1,2}(?: ?UN[CF]?)?)(?:[^\d]|$))");
  const std::string searched = shortened(text, kLongest);
  std::vector<std::string> out;
  for (const auto& m : kMetric.all_in(searched)) {
    const double d = quantity(m[1])->value;
    const auto pitch =
        m[2].empty() ? part::coarse_pitch_mm(d).value_or(0) : quantity(m[2])->value;
    if (pitch > 0) out.push_back(metric(d, pitch));
  }
  for (const auto& m : kInch.all_in(searched))
    if (part::inch_thread(m[1])) out.push_back(m[1]);
  return out;
}

// Why a tap cuts no right-hand metric or unified thread, by the words of the library; empty
// if it may.
std::string other_thread(const LibraryTool& tool) {
  constexpr std::size_t kLongest = 200;
  constexpr auto kAnyCase = Pattern::Case::any;
  static const Pattern kLeft(R"(\b(left|reverse|links\w*)\b|\bLH\b)", kAnyCase);
  static const Pattern kForming(R"(\b(roll|cold|thread)? ?form(ing)?\b|\bfluteless\b)",
                                kAnyCase);
  static const Pattern kInsert(R"(\b(EG|STI|helicoil)\b)", kAnyCase);
  static const Pattern kOther(
      R"(\b(NPTF?|NPSM?|BSPT?|BSPP|BSW|BSF|BA|Rc|Rp|Rd|Tr|PG|Acme)\b ?\d*|\bG ?\d{1,2}(/\d)?)",
      kAnyCase);
  if (tool.hand == 'L')
    return tr("A left-hand tap: part documents have right-hand threads.");
  auto texts = tool.texts;
  texts.insert(texts.end(), {tool.thread, tool.name});
  for (const auto& text : texts) {
    const std::string searched = shortened(text, kLongest);
    if (kLeft.find_in(searched))
      return tr("A left-hand tap: part documents have right-hand threads.");
    if (kForming.find_in(searched))
      return tr("A forming tap: its hole is wider than that of a cutting one.");
    if (kInsert.find_in(searched))
      return tr("A tap for wire inserts: its thread is wider than it is called.");
    if (kOther.find_in(searched))
      return tr("A tap of another thread than metric or unified ones.");
  }
  return "";
}

double diameter_mm(const std::string& thread) {
  if (const auto inch = part::inch_thread(thread)) return inch->d_mm;
  const auto metric = part::metric_thread(thread);
  if (!metric || !(metric->d_mm > 0 && metric->pitch_mm.value_or(0) > 0))
    throw std::domain_error(say("{} is no thread of a tap.", thread));
  return metric->d_mm;
}

// What is said of the thread itself wins over names, in which a grade of steel may stand
// (M42).
std::string thread_of_tap(const LibraryTool& tool) {
  constexpr double kNominal_mm = 0.2;  // between a tap's diameter and its thread's
  constexpr double kMostPitch = 0.4;   // of the diameter
  if (const auto why = other_thread(tool); !why.empty()) throw std::domain_error(why);
  if (const auto named = threads_in(tool.thread); !named.empty()) return named.front();
  if (tool.DC_mm && tool.TP_mm) {
    if (!(*tool.TP_mm <= kMostPitch * *tool.DC_mm))
      throw std::domain_error(
          say("A pitch (TP) of {:g} mm on {:g} mm (DC).", *tool.TP_mm, *tool.DC_mm));
    const auto inch = part::inch_designation(*tool.DC_mm, *tool.TP_mm);
    return inch ? *inch : metric(rounded(*tool.DC_mm), rounded(*tool.TP_mm));
  }
  for (const auto& text : tool.texts)
    for (const auto& named : threads_in(text))
      if (!tool.DC_mm || std::abs(*tool.DC_mm - diameter_mm(named)) < kNominal_mm)
        return named;
  throw std::domain_error(
      tr("A tap of which neither the thread nor diameter and pitch (DC, TP) are said."));
}

double size_of(const LibraryTool& tool) {
  if (!(tool.DC_mm.value_or(0) > 0))
    throw std::domain_error(tr("Its cutting diameter (DC) is not said."));
  return rounded(*tool.DC_mm);
}

class HoleDrafting {
 public:
  HoleDrafting(const LibraryTool& tool, ToolDraft& out)
      : tool_(tool), out_(out), usual_(hole_estimates(tool.use)) {}

  void draft(const std::string& groups) {
    auto& d = out_.document;
    d = {{"format", "turnwright-fixed-tool/1"},
         {"id", ""},
         {"name", tool_.name},
         {"use", tool_.use}};
    if (tool_.use == "tapping") add_tap();
    if (tool_.use == "reaming") add_reamer();
    if (tool_.use == "countersinking") add_countersink();
    add_conditions(groups);
    d["gamma_deg"] = tool_.GAMO_deg.value_or(usual_.gamma_deg);
    d["change_min"] = usual_.change_min;
    d["edge_cost"] = usual_.edge_cost;
    assume("/edge_cost", say("Costs are not said: {:g} an edge, {:g} min to change it.",
                             usual_.edge_cost, usual_.change_min));
    d = estimated(std::move(d), kAsInCatalogue);
  }

 private:
  void assume(const char* member, std::string sentence) {
    out_.assumed.push_back({member, std::move(sentence)});
  }

  void add_tap() {
    auto& d = out_.document;
    const auto thread = thread_of_tap(tool_);
    if (tool_.name.empty()) d["name"] = fmt::format("tap {}", thread);
    d["threads"] = {thread};
    d["lead_pitches"] = kLeadPitches;
    assume("/lead_pitches", tr("The lead is not said: form C, 2.5 pitches."));
    add_edges_and_reach(diameter_mm(thread));
  }

  void add_reamer() {
    auto& d = out_.document;
    const double size = size_of(tool_);
    if (tool_.name.empty()) d["name"] = fmt::format("reamer {:g} mm", size);
    d["sizes_mm"] = {size};
    d["allowance_mm"] = {0.1, 0.3};
    d["lead_mm"] = kLead_mm;
    d["hole"] = {{"grade", 7}, {"Ra_um", 0.8}};
    assume("/hole", tr("The class of the hole is not said: H7, Ra 0.8 um."));
    assume("/allowance_mm", tr("What a reamer takes off is not said: 0.1 to 0.3 mm of "
                               "the diameter, with a lead of 1.5 mm."));
    add_edges_and_reach(size);
  }

  void add_countersink() {
    auto& d = out_.document;
    constexpr double kUsual_deg = 90;
    const double size = size_of(tool_);
    if (tool_.name.empty()) d["name"] = fmt::format("countersink {:g} mm", size);
    d["sizes_mm"] = {size};
    d["point_deg"] = tool_.SIG_deg.value_or(kUsual_deg);
    if (!tool_.SIG_deg)
      assume("/point_deg", tr("The point angle (SIG) is not said: 90 deg."));
    add_edges();
  }

  void add_edges() {
    constexpr double kAbsurd = 1000;  // which the document's reader refuses
    out_.document["edges"] = static_cast<int>(
        std::lround(std::clamp(tool_.NOF.value_or(usual_.edges), 0.0, kAbsurd)));
    if (!tool_.NOF)
      assume("/edges", say("The number of edges (NOF) is not said: {}.", usual_.edges));
  }

  void add_edges_and_reach(double d_mm) {
    add_edges();
    out_.document["reach_diameters"] =
        tool_.LU_mm ? rounded(*tool_.LU_mm / d_mm) : usual_.reach_diameters;
    if (!tool_.LU_mm)
      assume("/reach_diameters",
             say("The usable length (LU) is not said: {:g} diameters.",
                 usual_.reach_diameters));
  }

  void add_conditions(const std::string& groups) {
    const std::string& wanted = tool_.groups.empty() ? groups : tool_.groups;
    auto& list = out_.document["conditions"] = ordered_json::array();
    for (const auto& c : usual_.conditions) {
      if (wanted.find(c.group) == wanted.npos) continue;
      ordered_json entry{{"groups", {c.group}}, {"vc_m_min", c.vc_m_min}};
      if (c.f_per_mm > 0) entry["f_per_mm"] = c.f_per_mm;
      entry["T_min"] = c.T_min;
      list.push_back(std::move(entry));
    }
    if (list.empty())
      throw std::domain_error(say(
          "Such tools of high-speed steel cut no material of the groups {}.", wanted));
    assume("/conditions", tr("Conditions are not said: those of high-speed steel."));
  }

  const LibraryTool& tool_;
  ToolDraft& out_;
  const HoleEstimates& usual_;
};

}  // namespace

std::string hole_use(std::string_view text) {
  std::string lower(text.substr(0, 200));
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  const auto has = [&](const char* word) {
    return Pattern(word).find_in(lower).has_value();
  };
  if (has("\\b(drill|collet|holder|boring|taper(ed)?|adjustable)\\b")) return "";
  if (has("counter ?sink")) return "countersinking";
  if (has("\\bream(er|ing)?\\b")) return "reaming";
  return has("\\btap(ping)?\\b") ? "tapping" : "";
}

const HoleEstimates& hole_estimates(std::string_view use) {
  static const HoleEstimates kTap{.conditions = {{"P", 12, 0, 20},
                                                 {"M", 6, 0, 10},
                                                 {"K", 12, 0, 25},
                                                 {"N", 20, 0, 40},
                                                 {"S", 3, 0, 6}},
                                  .edges = 3,
                                  .reach_diameters = 3,
                                  .gamma_deg = 10,
                                  .change_min = 1.5,
                                  .edge_cost = 20};
  static const HoleEstimates kReamer{.conditions = {{"P", 10, 0.02, 40},
                                                    {"M", 5, 0.016, 25},
                                                    {"K", 10, 0.025, 45},
                                                    {"N", 18, 0.028, 60},
                                                    {"S", 4, 0.014, 15}},
                                     .edges = 6,
                                     .reach_diameters = 4,
                                     .gamma_deg = 0,
                                     .change_min = 1.5,
                                     .edge_cost = 12};
  static const HoleEstimates kCountersink{.conditions = {{"P", 22, 0.01, 30},
                                                         {"M", 10, 0.008, 20},
                                                         {"K", 20, 0.012, 35},
                                                         {"N", 45, 0.014, 50},
                                                         {"S", 7, 0.006, 12}},
                                          .edges = 3,
                                          .reach_diameters = 0,
                                          .gamma_deg = 0,
                                          .change_min = 1,
                                          .edge_cost = 6};
  if (use == "tapping") return kTap;
  return use == "reaming" ? kReamer : kCountersink;
}

ToolDraft hole_tool_draft(const LibraryTool& tool, const std::string& groups) {
  ToolDraft out;
  try {
    HoleDrafting(tool, out).draft(groups);
  } catch (const std::domain_error& why) {
    out.refused = why.what();
  }
  return out;
}

}  // namespace turnwright::document
