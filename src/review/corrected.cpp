#include "turnwright/review/corrected.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "review/program/words.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::review {
namespace {

using planning::OperationPlan;
using toolpath::Move;

constexpr double kAlike = 1e-3;  // of a factor
constexpr int kFeedDecimals = 3;
constexpr double kNear_mm = 0.05, kNearShare = 0.05;  // depths of roughing

// Feeds that follow each other without a rapid, at the same conditions.
struct Feeds {
  std::size_t first_line = 0, last_line = 0;
  std::set<std::size_t> F, S;
  bool per_minute = false;

  void add(const ReadMove& m) {
    if (first_line == 0) first_line = last_line = m.line;
    first_line = std::min(first_line, m.line);
    last_line = std::max(last_line, m.line);
    if (m.to.kind != Move::Kind::thread) F.insert(m.words.F_line);
    S.insert(m.words.S_line);
    per_minute = m.words.per_minute;
  }
};

std::vector<Feeds> feeds_of(const Run& run) {
  std::vector<Feeds> all(1);
  for (const auto& m : run.moves)
    if (m.to.kind != Move::Kind::rapid)
      all.back().add(m);
    else if (all.back().first_line > 0)
      all.emplace_back();
  return all;
}

void keep_least(std::map<std::size_t, double>& factors,
                const std::set<std::size_t>& lines, double factor) {
  for (const std::size_t line : lines) {
    const auto [at, added] = factors.emplace(line, factor);
    if (!added) at->second = std::min(at->second, factor);
  }
}

// The plan's operation that a cut belongs to.
const OperationPlan* operation_of(const Cut& cut, const planning::SetupPlan& plan) {
  const auto found = std::ranges::find_if(plan.operations, [&](const OperationPlan& o) {
    return o.kind == cut.kind && o.on[0] == cut.on && o.tool == cut.tool_id;
  });
  return found == plan.operations.end() ? nullptr : &*found;
}

// Whether a plan's depths are those of the operations.
bool near(const planning::ProcessPlan& plan,
          const std::vector<planning::OperationRequest>& operations) {
  return std::ranges::all_of(plan.setups, [&](const planning::SetupPlan& s) {
    return std::ranges::all_of(s.operations, [&](const OperationPlan& o) {
      const auto given =
          std::ranges::find(operations, o.id, &planning::OperationRequest::id);
      if (given == operations.end() || !given->conditions.ap_mm) return true;
      const double ap = *given->conditions.ap_mm;
      return std::abs(o.passes[0].ap_mm - ap) <= std::max(kNear_mm, kNearShare * ap);
    });
  });
}

int decimals_of(std::string_view number) {
  const auto point = number.find('.');
  return point == number.npos ? 0 : static_cast<int>(number.size() - point - 1);
}

// The word with its number multiplied; a point at its end stays.
std::string multiplied(const Word& word, double factor) {
  const auto sign = word.text.find_first_of("0123456789.+-");
  const auto head = word.text.substr(0, sign), number = word.text.substr(sign);
  const bool feed = word.name == "F";
  const int decimals = std::max(decimals_of(number), feed ? kFeedDecimals : 0);
  const double value = gcode::cut_off(factor * *word.value, decimals);
  const auto text = fmt::format("{:.{}f}", value, decimals);
  return head + text + (decimals == 0 && number.ends_with('.') ? "." : "");
}

}  // namespace

planning::ProcessPlan best_of_passes(
    const planning::PreparedPart& part,
    const std::vector<planning::OperationRequest>& operations,
    const std::vector<MountedTool>& tools) {
  auto open = operations;
  for (auto& o : open) o.conditions = {o.conditions.passes, o.conditions.ap_mm, {}, {}};
  const auto planned = [&] {
    return planning::plan(planning::prepare(with_operations(part, open, tools)));
  };
  auto best = planned();
  if (best.status == planning::PlanStatus::ok) return best;
  for (auto& o : open)
    if (o.kind != planning::OperationKind::fixed) o.conditions.ap_mm.reset();
  auto other = planned();
  const bool serves = other.status == planning::PlanStatus::ok && near(other, operations);
  return serves ? other : best;
}

WordFactors word_factors(const ReviewedSetup& setup, const TurningProgram& program,
                         const planning::SetupPlan& plan) {
  WordFactors out;
  for (const auto& run : program.runs)
    for (const auto& feeds : feeds_of(run))
      for (const auto& c : setup.cuts) {
        const auto* o = operation_of(c, plan);
        const auto among = [&](const PassCut& p) {
          return feeds.first_line <= p.line && p.line <= feeds.last_line;
        };
        if (!o || c.tool != run.step.tool || !std::ranges::any_of(c.passes, among))
          continue;
        const auto& pass = o->passes[0];
        const double v = c.at.constant_surface_speed ? c.at.S : c.loads.vc_m_min;
        const double speed = pass.vc_m_min / v, feed = pass.f_mm_rev / c.at.f_mm_rev;
        keep_least(out.S, feeds.S, speed);
        keep_least(out.F, feeds.F, feeds.per_minute ? feed * speed : feed);
      }
  return out;
}

CorrectedText corrected_text(std::string_view text, gcode::Control control,
                             const WordFactors& factors) {
  const auto language = language_of(control);
  CorrectedText out;
  const auto lines = lines_of(text);
  for (std::size_t number = 1; number <= lines.size(); ++number) {
    std::string line(lines[number - 1]);
    for (const auto& [name, all] : {std::pair{"F", &factors.F}, {"S", &factors.S}}) {
      const auto factor = all->find(number);
      if (factor == all->end() || std::abs(factor->second - 1) < kAlike) continue;
      const auto block = block_of(line, language);
      const auto* word = block.find(name);
      if (!word || !word->value) continue;
      const auto is = multiplied(*word, factor->second);
      if (is == word->text) continue;
      line.replace(word->at, word->text.size(), is);
      out.words.push_back({number, word->text, is});
    }
    out.text += line;
    if (number < lines.size() || text.ends_with('\n')) out.text += '\n';
  }
  return out;
}

}  // namespace turnwright::review
