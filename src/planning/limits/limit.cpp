#include "turnwright/planning/limit.hpp"

#include <algorithm>

#include "base/say.hpp"
#include "limit_name.hpp"
#include "limit_table.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::planning {
namespace {

// "t1, the cylindricity of d1," and for what the drawing gives no id "the diameter k6 of
// d1".
std::string called(const PlanRequest& p, const part::Tolerance& t) {
  const auto of = t.of.empty() ? t.between[0] + " .. " + t.between[1] : t.of;
  const auto kind = tr(part::name(t.kind));
  if (t.id.find(':') == std::string::npos)
    return say("{}, the {} of {},", t.id, kind, of);
  const auto fit = [&](const auto& elements) {
    for (const auto& e : elements)
      if (e.id == t.of && e.fit) return " " + *e.fit;
    return std::string();
  };
  return say("the {}{} of {}", kind, fit(p.drawing.outer) + fit(p.drawing.inner), of);
}

void add(const PreparedPart& p, const LimitRow& row, const LimitNumber& number,
         std::size_t owner, std::vector<Limit>& all) {
  const auto now = number.now(p, owner);
  if (!now) return;
  const auto name = limit_name(p, row, number, owner);
  const auto sentence = row.is_width
                            ? say("opening {}", called(p, p.drawing.tolerances[owner]))
                        : row.at_most() ? say("raising {}", limit_words(name))
                                        : say("lowering {}", limit_words(name));
  all.push_back({name, sentence, number.unit ? number.unit : row.unit, row.at_most(),
                 *now,
                 [scale = number.scale, owner, now = *now](PlanRequest& plan, double k) {
                   scale(plan, owner, {now, k});
                 }});
}

}  // namespace

std::vector<Limit> limits(const PreparedPart& p) {
  using Owners = std::vector<Owner>;
  std::vector<Limit> all;
  for (const auto& group :
       {Owners{Owner::tolerance}, Owners{Owner::surface}, Owners{Owner::machine},
        Owners{Owner::chuck}, Owners{Owner::jaws, Owner::finishing_jaws},
        Owners{Owner::tool}})
    for (std::size_t i = 0; i < owners(p, group[0]); ++i)
      for (const auto& row : limit_table())
        for (const auto& number : row.numbers)
          if (std::ranges::find(group, number.owner) != group.end())
            add(p, row, number, i, all);
  return all;
}

}  // namespace turnwright::planning
