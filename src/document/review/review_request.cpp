#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "document/plan/controls.hpp"
#include "turnwright/document/review.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using review::MountedTool;

constexpr std::size_t kPrograms = 10, kTurret = 100;
constexpr std::size_t kProgramBytes = 2'000'000;
constexpr std::size_t kMovesOfProgram = 20'000;

std::vector<ReviewRequest::Text> read_programs(Reader& r) {
  std::vector<ReviewRequest::Text> all;
  for (const auto& entry : r.items("programs", 1, kPrograms)) {
    auto item = entry.as_object();
    ReviewRequest::Text p;
    p.setup = static_cast<std::size_t>(
        item.integer_or("setup", 0, 9, static_cast<long>(all.size())));
    p.text = item.text("text", kProgramBytes);
    p.zero_mm = item.number_or("zero_mm", within(-1e4, 1e4, "mm"), 0);
    item.finish();
    if (!all.empty() && !item.broken() && p.setup <= all.back().setup)
      item.problem_at("setup", tr("a later setup than that of the program before"),
                      "order");
    all.push_back(std::move(p));
  }
  return all;
}

std::vector<NumberedTool> read_turret(Reader& r) {
  std::vector<NumberedTool> all;
  std::set<int> numbers;
  for (const auto& entry : r.optional_items("tools", 0, kTurret)) {
    auto item = entry.as_object();
    NumberedTool t;
    t.pointer = item.pointer();
    t.number = static_cast<int>(item.integer("number", 0, 9999));
    t.id = item.text("id");
    t.size_mm = item.optional_number("size_mm", above_up_to(0, 500, "mm"));
    item.finish();
    if (!item.broken() && !numbers.insert(t.number).second)
      item.problem_at("number", tr("one that no other tool has"), "duplicate");
    all.push_back(std::move(t));
  }
  return all;
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) {
    return std::toupper(x) == std::toupper(y);
  });
}

template <class Tool>
const Tool* find_id(const std::vector<Tool>& all, std::string_view id) {
  const auto it =
      std::ranges::find_if(all, [&](const Tool& t) { return same_letters(t.id, id); });
  return it == all.end() ? nullptr : &*it;
}

// The part's own tools come before the catalogue's.
class Crib {
 public:
  Crib(const planning::PreparedPart& part, const Catalogue& catalogue)
      : part_(part), catalogue_(catalogue) {}

  const catalogue::Tool* turning(std::string_view id) const {
    const auto* own = find_id(part_.tools, id);
    return own ? own : find_id(catalogue_.tools, id);
  }
  const catalogue::FixedTool* fixed(std::string_view id) const {
    const auto* own = find_id(part_.fixed_tools, id);
    return own ? own : find_id(catalogue_.fixed_tools, id);
  }

 private:
  const planning::PreparedPart& part_;
  const Catalogue& catalogue_;
};

// "DRILL-HM 8.5 mm": an id and a size; of a tap, "TAP-HSS M10", only the id counts.
struct Label {
  std::string_view id;
  std::optional<double> size_mm;
};
Label split_label(std::string_view label) {
  constexpr std::string_view kUnit = " mm";
  if (label.size() < kUnit.size() ||
      !same_letters(label.substr(label.size() - kUnit.size()), kUnit))
    return {label, std::nullopt};
  const auto number = label.substr(0, label.size() - kUnit.size());
  const auto blank = number.rfind(' ');
  if (blank == number.npos) return {label, std::nullopt};
  double size = 0;
  const auto [end, error] =
      std::from_chars(number.data() + blank + 1, number.data() + number.size(), size);
  if (error != std::errc() || end != number.data() + number.size() || !(size > 0))
    return {label, std::nullopt};
  return {number.substr(0, blank), size};
}

std::optional<MountedTool> mount(const Crib& crib, int number, std::string_view label,
                                 std::optional<double> size) {
  MountedTool m{.number = number};
  if (const auto* t = crib.turning(label)) {
    m.turning = *t;
    return m;
  }
  const auto* tap = crib.fixed(label.substr(0, label.rfind(' ')));
  const auto split = tap && tap->use == catalogue::FixedUse::tapping ? Label{tap->id, {}}
                                                                     : split_label(label);
  const auto* fixed = crib.fixed(split.id);
  if (!fixed) return std::nullopt;
  m.fixed = *fixed;
  m.size_mm = size.value_or(split.size_mm.value_or(0));
  if (m.size_mm == 0 && fixed->sizes_mm.size() == 1) m.size_mm = fixed->sizes_mm[0];
  return m;
}

bool lacks_size(const MountedTool& m) {
  return m.fixed && !m.fixed->sizes_mm.empty() && !(m.size_mm > 0);
}

}  // namespace

ReviewRequest load_review_request(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "review"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-review/1");
  const auto part = r.object("part");
  ReviewRequest out;
  out.control = r.choice_or("control", controls(), out.control);
  out.programs = read_programs(r);
  out.tools = read_turret(r);
  out.correct = r.boolean_or("correct", false);
  r.finish();
  if (!read_below(part, problems, [&] {
        out.part = prepared_candidates(part.json(), catalogue, "review");
      }))
    problems.throw_if_any();
  const auto setups = out.part.usable.front().document.part.setups.size();
  for (std::size_t i = 0; i < out.programs.size(); ++i)
    if (out.programs[i].setup >= setups)
      r.problem_at("programs", say("programs of the part's {} setups", setups), "range");
  problems.throw_if_any();
  return out;
}

ReviewInput review_input(const ReviewRequest& request, const planning::PreparedPart& part,
                         const Catalogue& catalogue) {
  ReviewInput in;
  Problems problems{.document = "review"};
  const Crib crib(part, catalogue);
  for (const auto& t : request.tools) {
    const auto m = mount(crib, t.number, t.id, t.size_mm);
    if (!m)
      problems.add({t.pointer + "/id", t.id,
                    tr("the id of a tool of the part or catalogue"), "reference"});
    else if (lacks_size(*m))
      problems.add({t.pointer + "/size_mm", tr("nothing"),
                    tr("the diameter of a drill or the width of a blade"), "missing"});
    else
      in.tools.push_back(*m);
  }
  problems.throw_if_any();
  for (const auto& p : request.programs) {
    auto read = review::read_program(p.text, {.control = request.control,
                                              .n_max_rpm = part.machine.n_max_rpm,
                                              .moves_max = kMovesOfProgram});
    for (const auto& [number, name] : read.named_tools) {
      if (std::ranges::find(in.tools, number, &MountedTool::number) != in.tools.end())
        continue;
      const auto m = mount(crib, number, name, std::nullopt);
      if (m && !lacks_size(*m)) in.tools.push_back(*m);
    }
    in.programs.push_back({p.setup, std::move(read), p.zero_mm});
  }
  return in;
}

}  // namespace turnwright::document
