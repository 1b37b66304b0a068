#include <fmt/format.h>

#include <algorithm>

#include "catalogue_readers.hpp"
#include "document/json/fields.hpp"

namespace turnwright::document {
namespace {

using catalogue::FixedTool;
using catalogue::FixedUse;

const Choices<FixedUse> kFixedUses{
    {"centring", FixedUse::centring},   {"drilling", FixedUse::drilling},
    {"grooving", FixedUse::grooving},   {"parting", FixedUse::parting},
    {"threading", FixedUse::threading}, {"profiling", FixedUse::profiling}};

bool drills(FixedUse use) {
  return use == FixedUse::centring || use == FixedUse::drilling;
}

void read_sizes(Reader& r, FixedTool& t) {
  t.sizes_mm = r.numbers("sizes_mm", above_up_to(0, 500, "mm"), 1, 200);
  const auto not_rising = [](double a, double b) { return a >= b; };
  if (std::adjacent_find(t.sizes_mm.begin(), t.sizes_mm.end(), not_rising) !=
      t.sizes_mm.end())
    r.problem_at("sizes_mm", "sizes in rising order", "order");
}

void read_hole(Reader& r, FixedTool& t) {
  auto hole = r.optional_object("hole");
  if (!hole) return;
  t.hole = {static_cast<int>(hole->integer("grade", 5, 16)),
            hole->number("Ra_um", above_up_to(0, 100, "um"))};
  hole->finish();
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
    case FixedUse::drilling:
      read_sizes(r, t);
      t.reach = r.number("reach_diameters", above_up_to(0, 100));
      t.point_deg = r.number("point_deg", within(60, 180, "deg"));
      if (t.use != FixedUse::drilling) break;
      read_hole(r, t);
      read_pecking(r, t);
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
  if (use == FixedUse::threading) return std::nullopt;
  if (drills(use)) return Feed{"f_per_mm", above_up_to(0, 1)};
  return Feed{"f_mm_rev", above_up_to(0, 5, "mm/rev")};
}

// A range around the conditions themselves.
catalogue::Range read_around(Reader& r, const char* key, const Bounds& bounds,
                             double value) {
  const auto range = read_range(r, key, bounds);
  if (0 < range.upper && range.lower <= range.upper &&
      !(range.lower <= value && value <= range.upper))
    r.problem_at(key, fmt::format("a range around {:g}", value), "order");
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
  t.gamma_deg = r.number("gamma_deg", within(-30, 45, "deg"));
  for (const auto& item : r.items("conditions", 1, 6))
    t.conditions.push_back(read_conditions(item, t.use));
  t.Fc_max_N = r.optional_number("Fc_max_N", above_up_to(0, 1e6, "N"));
  t.change_min = r.number("change_min", within(0, 1000, "min"));
  t.edge_cost = r.number("edge_cost", within(0, 1e5));
  finish_group(r);
  return t;
}

}  // namespace turnwright::document
