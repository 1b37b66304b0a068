#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

using planning::Clamping;

constexpr std::size_t kSetups = 10;

const Choices<Clamping>& clampings() {
  static const auto kClampings =
      named({Clamping::chuck, Clamping::chuck_tailstock, Clamping::between_centres,
             Clamping::chuck_steady, Clamping::tailstock_follow});
  return kClampings;
}

// A rest is set up only if the request names it.
bool has_rest(Clamping c) {
  return c == Clamping::chuck_steady || c == Clamping::tailstock_follow;
}

std::vector<Clamping> all_clampings(const Draft& draft) {
  std::vector<Clamping> out;
  for (const auto& [word, clamping] : clampings())
    if (draft.loaded.plan.machine.has(name(clamping)) && !has_rest(clamping))
      out.push_back(clamping);
  return out;
}

nlohmann::json words(const std::vector<Clamping>& list) {
  auto out = nlohmann::json::array();
  for (const auto clamping : list) out.push_back(name(clamping));
  return out;
}

bool has_jaws(const planning::SetupRequest& setup) {
  return std::any_of(setup.clampings.begin(), setup.clampings.end(),
                     [](Clamping c) { return c != Clamping::between_centres; });
}

void check_setup(const Draft& draft, const Reader& at, std::size_t i,
                 const planning::SetupRequest& setup) {
  const auto& drawing = draft.loaded.plan.drawing;
  const double length_mm = i == 0 ? drawing.stock.length_mm : part::length_mm(drawing);
  const double d_mm = part::held_mm(drawing, i, setup.hold);
  const bool readable = length_mm > 0 && d_mm > 0 && std::isfinite(d_mm);
  if (readable && setup.grip_mm >= length_mm)
    at.problem(say("a grip of {}", mm_text(*setup.grip_mm)),
               i == 0 ? say("less than the stock's {}", mm_text(length_mm))
                      : say("less than the part's {}", mm_text(length_mm)),
               "conflict");
  const auto& machine = draft.loaded.plan.machine;
  if (machine.id.empty()) return;  // unknown, reported already
  const auto& range = machine.chuck.diameter_mm;
  if (has_jaws(setup) && readable && (d_mm < range.lower || d_mm > range.upper))
    at.problem(say("a diameter of {} in the jaws", mm_text(d_mm)),
               say("what the chuck of {} holds, {} to {}", machine.id,
                   mm_text(range.lower), mm_text(range.upper)),
               "conflict");
}

void read_clampings(Draft& draft, Reader& r, planning::SetupRequest& setup) {
  if (!r.has("clampings")) {
    setup.clampings = all_clampings(draft);
    draft.assume(r.pointer_of("clampings"), words(setup.clampings),
                 tr("all the machine has"));
    return;
  }
  setup.clampings = read_set(r, "clampings", clampings());
  for (const auto clamping : setup.clampings)
    if (!draft.loaded.plan.machine.clampings.empty() &&
        !draft.loaded.plan.machine.has(name(clamping)))
      r.problem_at("clampings",
                   say("what {} has: {}", draft.loaded.plan.machine.id,
                       nlohmann::json(draft.loaded.plan.machine.clampings).dump()),
                   "conflict");
  if (part::flats(draft.loaded.plan.drawing.stock.kind) > 0 &&
      std::ranges::any_of(setup.clampings, has_rest))
    r.problem_at("clampings", tr("no rest, which runs on no bar with corners"),
                 "conflict");
}

void read_grip_forces(const Draft& draft, Reader& r, planning::SetupRequest& setup) {
  const auto force = [&](const char* key, double most, bool roughing) {
    const auto given = r.optional_number(key, above_up_to(0, 1e7, "N"));
    if (given && most > 0 && *given > most)
      r.problem_at(key,
                   roughing ? say("at most the {} N of the roughing", number_text(most))
                            : say("at most the {} N of the chuck", number_text(most)),
                   "conflict");
    return given;
  };
  const double chuck = draft.loaded.plan.machine.chuck.grip_force_N;
  setup.grip_force_N = force("grip_force_N", chuck, false);
  setup.finishing_grip_force_N =
      force("finishing_grip_force_N", setup.grip_force_N.value_or(chuck), true);
}

// The position of the steady rest, which is required by its clamping and allowed by no
// other.
void read_steady(Reader& r, planning::SetupRequest& setup) {
  const bool wanted = std::find(setup.clampings.begin(), setup.clampings.end(),
                                Clamping::chuck_steady) != setup.clampings.end();
  if (wanted)
    setup.steady_z_mm = r.number("steady_mm", above_up_to(0, 20000, "mm"));
  else if (r.has("steady_mm"))
    r.problem_at("steady_mm", tr("nothing: no clamping here is \"chuck-steady\""),
                 "conflict");
}

void check_steady(const Draft& draft, const Reader& r, std::size_t i) {
  const auto& plan = draft.loaded.plan;
  const double z = plan.setups[i].steady_z_mm, length_mm = part::length_mm(plan.drawing);
  if (!(z > 0) || !(length_mm > 0)) return;
  const bool left = plan.setups[i].hold == part::End::left;
  const double jaws_mm = plan.setups[i].grip_mm.value_or(0) -
                         (i > 0  ? 0
                          : left ? plan.drawing.stock.left_allowance_mm
                                 : part::right_allowance_mm(plan.drawing));
  const bool beside = (left ? z : length_mm - z) > jaws_mm;
  if (!beside || z >= length_mm)
    r.problem_at("steady_mm",
                 tr("a place on the part outside the jaws, z from the part's left end"),
                 "conflict");
}

// The part is held anew from the second setup on.
void read_jaws(Draft& draft, Reader& r, std::size_t i, planning::SetupRequest& setup) {
  using planning::Jaws;
  static const auto kJaws = named({Jaws::hard, Jaws::soft, Jaws::collet});
  if (const auto jaws = r.optional_choice<Jaws>("jaws", kJaws))
    setup.jaws = *jaws;
  else if (i > 0 && has_jaws(setup))
    draft.assume(r.pointer_of("jaws"), name(setup.jaws),
                 tr("bored in place to the diameter they hold"));
}

planning::SetupRequest read_setup(Draft& draft, Reader r, std::size_t i) {
  planning::SetupRequest setup;
  r = r.as_object();
  setup.hold = r.choice("hold", ends());
  setup.grip_mm = r.optional_number("grip_mm", above_up_to(0, 20000, "mm"));
  read_clampings(draft, r, setup);
  read_grip_forces(draft, r, setup);
  read_jaws(draft, r, i, setup);
  read_steady(r, setup);
  if (draft.purpose == Purpose::predict && setup.clampings.size() > 1) {
    setup.clampings = {setup.clampings.front()};
    draft.assume(r.pointer_of("clampings"), words(setup.clampings),
                 tr("the first: predict compares none"));
  }
  r.finish();
  check_setup(draft, r, i, setup);
  return setup;
}

void assume_setups(Draft& draft) {
  auto echoed = nlohmann::json::array();
  const nlohmann::json none;
  const Reader at(none, draft.root.problems(), "/setups");
  for (const auto& [word, end] : ends()) {
    auto& setups = draft.plan().setups;
    const std::size_t i = setups.size();
    setups.push_back({.hold = end, .clampings = all_clampings(draft)});
    check_setup(draft, at, i, setups.back());
    echoed.push_back({{"hold", word}, {"clampings", words(setups.back().clampings)}});
    if (i > 0) echoed.back()["jaws"] = name(setups.back().jaws);
  }
  draft.assume("/setups", std::move(echoed),
               tr("hold left, then right, with all the clampings the machine has"));
}

}  // namespace

void read_setups(Draft& draft) {
  if (!draft.root.has("setups")) return assume_setups(draft);
  auto& setups = draft.plan().setups;
  for (const auto& item : draft.root.items("setups", 1, kSetups)) {
    setups.push_back(read_setup(draft, item, setups.size()));
    check_steady(draft, item, setups.size() - 1);
  }
}

}  // namespace turnwright::document
