
#include <algorithm>

#include "base/say.hpp"
#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"
#include "turnwright/part/inch_thread.hpp"
#include "turnwright/part/metric_thread.hpp"

namespace turnwright::document {
namespace {

using catalogue::FixedTool;
using catalogue::FixedUse;

const Choices<FixedUse> kFixedUses{{"centring", FixedUse::centring},
                                   {"drilling", FixedUse::drilling},
                                   {"reaming", FixedUse::reaming},
                                   {"tapping", FixedUse::tapping},
                                   {"counterboring", FixedUse::counterboring},
                                   {"countersinking", FixedUse::countersinking},
                                   {"grooving", FixedUse::grooving},
                                   {"parting", FixedUse::parting},
                                   {"threading", FixedUse::threading},
                                   {"knurling", FixedUse::knurling},
                                   {"profiling", FixedUse::profiling}};

// Feeds of these grow with the diameter, those of threads are the pitch.
bool feeds_by_diameter(FixedUse use) {
  return catalogue::on_axis(use) && use != FixedUse::tapping;
}
bool threads(FixedUse use) {
  return use == FixedUse::threading || use == FixedUse::tapping;
}

void read_sizes(Reader& r, FixedTool& t) {
  t.sizes_mm = r.numbers("sizes_mm", above_up_to(0, 500, "mm"), 1, 200);
  const auto not_rising = [](double a, double b) { return a >= b; };
  if (std::adjacent_find(t.sizes_mm.begin(), t.sizes_mm.end(), not_rising) !=
      t.sizes_mm.end())
    r.problem_at("sizes_mm", tr("sizes in rising order"), "order");
}

void read_hole(Reader& r, FixedTool& t) {
  if (t.use != FixedUse::drilling && !r.has("hole"))
    r.problem_at("hole",
                 t.use == FixedUse::reaming
                     ? tr("the grade and roughness that the reamer leaves")
                     : tr("the grade and roughness that the flat drill leaves"),
                 "missing");
  auto hole = r.optional_object("hole");
  if (!hole) return;
  t.hole = {static_cast<int>(hole->integer("grade", 5, 16)),
            hole->number("Ra_um", above_up_to(0, 100, "um"))};
  hole->finish();
}

// "M10", "M10x1" or "3/8-16 UNC".
catalogue::ThreadSize read_thread(const Reader& r) {
  const auto text = r.as_text(20);
  if (const auto inch = part::inch_thread(text))
    return {text, inch->d_mm, inch->pitch_mm};
  const auto metric = part::metric_thread(text);
  if (metric && metric->pitch_mm) return {text, metric->d_mm, *metric->pitch_mm};
  if (!text.empty())
    r.problem(tr("a thread like \"M10\", \"M10x1\" or \"3/8-16 UNC\", with a pitch if it "
                 "is not of the coarse series"),
              "choice");
  return {};
}

// Of centre drills: one for each size, or in proportion to it.
void read_depths(Reader& r, FixedTool& t) {
  if (r.has("depths_mm")) {
    t.depths_mm = r.numbers("depths_mm", above_up_to(0, 500, "mm"), 1, 200);
    if (t.depths_mm.size() != t.sizes_mm.size())
      r.problem_at("depths_mm", tr("one for each of sizes_mm"), "conflict");
    return;
  }
  t.reach = r.number("reach_diameters", above_up_to(0, 100));
  for (const double size : t.sizes_mm) t.depths_mm.push_back(t.reach * size);
}

// Of reamers and taps.
void read_lead(Reader& r, FixedTool& t, const char* key, const Bounds& bounds) {
  t.reach = r.number("reach_diameters", above_up_to(0, 100));
  t.lead = r.number(key, bounds);
  t.edges = static_cast<int>(r.integer("edges", 1, 40));
}

void read_pecking(Reader& r, FixedTool& t) {
  auto pecking = r.optional_object("pecking");
  if (!pecking) return;
  t.pecking = {pecking->number("first_diameters", within(0.1, 100)),
               pecking->number("step_diameters", within(0.1, 100))};
  pecking->finish();
}

void read_kind(Reader& r, FixedTool& t) {
  switch (t.use) {
    case FixedUse::centring:
      read_sizes(r, t);
      read_depths(r, t);
      t.point_deg = r.number("point_deg", within(60, 180, "deg"));
      t.form = r.choice_or("form", {{"A", 'A'}, {"B", 'B'}, {"R", 'R'}}, 'A');
      break;
    case FixedUse::drilling:
      read_sizes(r, t);
      t.reach = r.number("reach_diameters", above_up_to(0, 100));
      t.point_deg = r.number("point_deg", within(60, 180, "deg"));
      read_hole(r, t);
      read_pecking(r, t);
      break;
    case FixedUse::counterboring:
      read_sizes(r, t);
      t.reach = r.number("reach_diameters", above_up_to(0, 100));
      t.point_deg = 180;
      t.edges = static_cast<int>(r.integer("edges", 1, 40));
      read_hole(r, t);
      break;
    case FixedUse::countersinking:
      read_sizes(r, t);
      t.point_deg = r.number("point_deg", within(60, 150, "deg"));
      t.edges = static_cast<int>(r.integer("edges", 1, 40));
      break;
    case FixedUse::reaming:
      read_sizes(r, t);
      t.allowance_mm = read_range(r, "allowance_mm", above_up_to(0, 5, "mm"));
      read_lead(r, t, "lead_mm", within(0, 50, "mm"));
      read_hole(r, t);
      break;
    case FixedUse::tapping:
      for (const auto& item : r.items("threads", 1, 200))
        t.threads.push_back(read_thread(item));
      read_lead(r, t, "lead_pitches", above_up_to(0, 20));
      break;
    case FixedUse::grooving:
    case FixedUse::parting:
      read_sizes(r, t);
      t.reach = r.number("reach_mm", above_up_to(0, 500, "mm"));
      break;
    case FixedUse::threading:
      t.pitch_mm = read_range(r, "pitch_mm", above_up_to(0, 50, "mm"));
      t.passes_per_mm = r.number("passes_per_mm", above_up_to(0, 50));
      break;
    case FixedUse::knurling:
      read_sizes(r, t);
      t.pitch_mm = read_range(r, "pitch_mm", above_up_to(0, 50, "mm"));
      break;
    case FixedUse::profiling:
      t.ap_mm = r.number("ap_mm", above_up_to(0, 50, "mm"));
      t.re_mm = r.number("re_mm", within(0, 20, "mm"));
      break;
  }
  if (t.use != FixedUse::grooving && t.use != FixedUse::threading &&
      t.use != FixedUse::profiling)
    return;
  if (const auto bore = r.optional_number("min_bore_mm", above_up_to(0, 20000, "mm"))) {
    t.inner = true;
    t.min_bore_mm = *bore;
  }
}

// The feed is the pitch of a thread, and a share of the diameter of a drill.
struct Feed {
  const char* key;
  Bounds bounds;
};
std::optional<Feed> feed_of(FixedUse use) {
  if (threads(use)) return std::nullopt;
  if (feeds_by_diameter(use)) return Feed{"f_per_mm", above_up_to(0, 1)};
  return Feed{"f_mm_rev", above_up_to(0, 5, "mm/rev")};
}

// A range around the conditions themselves.
catalogue::Range read_around(Reader& r, const char* key, const Bounds& bounds,
                             double value) {
  const auto range = read_range(r, key, bounds);
  if (0 < range.upper && range.lower <= range.upper &&
      !(range.lower <= value && value <= range.upper))
    r.problem_at(key, say("a range around {:g}", value), "order");
  return range;
}

void read_window(Reader& r, catalogue::FixedConditions& c, FixedUse use) {
  auto w = r.optional_object("window");
  if (!w) return;
  c.window.emplace();
  c.window->vc_m_min =
      read_around(*w, "vc_m_min", above_up_to(0, 5000, "m/min"), c.vc_m_min);
  c.window->taylor_n = w->number("taylor_n", within(0.05, 1));
  if (const auto feed = feed_of(use)) {
    c.window->f_mm_rev = read_around(*w, feed->key, feed->bounds, c.f_mm_rev);
    c.window->life_feed = w->number("life_feed", within(0, 10));
  }
  w->finish();
}

catalogue::FixedConditions read_conditions(Reader r, FixedUse use) {
  r = r.as_object();
  catalogue::FixedConditions c;
  c.groups = read_set(r, "groups", iso_groups());
  c.vc_m_min = r.number("vc_m_min", above_up_to(0, 5000, "m/min"));
  if (const auto feed = feed_of(use)) c.f_mm_rev = r.number(feed->key, feed->bounds);
  c.T_min = r.number("T_min", above_up_to(0, 1e5, "min"));
  read_window(r, c, use);
  r.finish();
  return c;
}

}  // namespace

FixedTool read_fixed_tool(Reader r) {
  FixedTool t;
  r = r.as_object();
  read_required_format(r, "turnwright-fixed-tool/1");
  t.id = read_id(r);
  t.name = r.text("name");
  const auto before = r.problems().list.size();
  t.use = r.choice("use", kFixedUses);
  if (r.problems().list.size() > before) return t;  // the other keys depend on it
  read_kind(r, t);
  if (t.use != FixedUse::knurling)
    t.gamma_deg = r.number("gamma_deg", within(-30, 45, "deg"));
  for (const auto& item : r.items("conditions", 1, 6))
    t.conditions.push_back(read_conditions(item, t.use));
  if (t.use != FixedUse::knurling)
    t.Fc_max_N = r.optional_number("Fc_max_N", above_up_to(0, 1e6, "N"));
  t.change_min = r.number("change_min", within(0, 1000, "min"));
  t.edge_cost = r.number("edge_cost", within(0, 1e5));
  finish_group(r);
  return t;
}

}  // namespace turnwright::document
