#include "relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace turnwright::planning {
namespace {

// Whether every owner's limit is relaxed by itself; the others have it in common.
bool apart(const LimitRow& row) {
  const auto owner = row.numbers[0].owner;
  return owner == Owner::operation || owner == Owner::tolerance ||
         owner == Owner::surface;
}

std::string surface_of(const PlanRequest& p, const LimitRow& row, std::size_t owner) {
  if (row.numbers[0].owner == Owner::tolerance) return p.drawing.tolerances[owner].of;
  if (row.numbers[0].owner == Owner::surface) return surface_id(p, owner);
  return {};
}

// The limits that operations, tolerances or surfaces have, one owner after another.
void add_each(const PreparedPart& p, Owner owner, std::vector<RelaxableLimit>& all) {
  for (std::size_t i = 0; i < owners(p, owner); ++i)
    for (const auto& row : limit_table())
      if (row.relaxing != Relaxing::never && row.numbers[0].owner == owner &&
          row.numbers[0].now(p, i))
        all.push_back({&row, i, surface_of(p, row, i)});
}

bool applies(const PreparedPart& p, const LimitRow& row) {
  if (row.applies) return row.applies(p);
  if (row.relaxed_by) return true;
  const auto& number = row.numbers[0];
  for (std::size_t i = 0; i < owners(p, number.owner); ++i)
    if (number.now(p, i)) return true;
  return false;
}

void add_common(const PreparedPart& p, bool windows, std::vector<RelaxableLimit>& all) {
  for (const auto& row : limit_table())
    if (row.relaxing != Relaxing::never && !apart(row) &&
        (row.relaxing == Relaxing::to_given) == windows && applies(p, row))
      all.push_back({&row});
}

void scale(const PreparedPart& from, const RelaxableLimit& l, double factor,
           PlanRequest& p) {
  const auto& row = *l.row;
  const double by = row.at_most() ? factor : 1 / factor;
  const auto& number = row.relaxed_by ? *row.relaxed_by : row.numbers[0];
  const bool one = row.relaxed_by || apart(row);
  const std::size_t first = one ? l.owner : 0;
  const std::size_t end = one ? l.owner + 1 : owners(p, number.owner);
  for (std::size_t i = first; i < end; ++i)
    if (const auto now = number.now(from, i)) number.scale(p, i, {*now, by});
}

void relax(const PreparedPart& from, const RelaxableLimit& l, double factor,
           PlanRequest& p) {
  if (l.row->take_away && (factor == kWithout || l.row->whole()))
    l.row->take_away(p, l.owner);
  else
    scale(from, l, apart(*l.row) ? factor : std::min(factor, kFar), p);
}

double rounded_up(double x) {
  const double digit = std::pow(10, std::floor(std::log10(x)) - 3);
  return std::ceil(x / digit * (1 - 1e-12)) * digit;
}

}  // namespace

std::vector<RelaxableLimit> relaxable_limits(const PreparedPart& p) {
  std::vector<RelaxableLimit> all;
  add_each(p, Owner::operation, all);
  add_common(p, true, all);
  add_each(p, Owner::tolerance, all);
  add_each(p, Owner::surface, all);
  add_common(p, false, all);
  return all;
}

PlanRequest relaxed(const PreparedPart& part, const std::vector<RelaxableLimit>& limits,
                    const RelaxationFactors& factors) {
  PlanRequest p = part;
  // Backwards: windows open to what is given before that goes, and the tolerances behind
  // one that goes have gone or been widened.
  for (std::size_t i = limits.size(); i-- > 0;)
    if (factors[i] != 1) relax(part, limits[i], factors[i], p);
  return p;
}

bool bears_on(const PreparedPart& p, const RelaxableLimit& l,
              const std::string& surface) {
  switch (l.row->numbers[0].owner) {
    case Owner::operation: {
      const auto& on = (*p.operations)[l.owner].on;
      return std::find(on.begin(), on.end(), surface) != on.end();
    }
    case Owner::tolerance: {
      const auto& t = p.drawing.tolerances[l.owner];
      return t.of == surface || t.between[0] == surface || t.between[1] == surface;
    }
    case Owner::surface:
      return l.surface == surface;
    case Owner::machine:
    case Owner::chuck:
    case Owner::jaws:
    case Owner::finishing_jaws:
    case Owner::tool:
      return true;
  }
  return true;
}

LimitValue value_of(const PreparedPart& p, const RelaxableLimit& l) {
  const auto& row = *l.row;
  const auto& number = row.relaxed_by ? *row.relaxed_by : row.numbers[0];
  LimitValue v{row.name, number.unit ? number.unit : row.unit, 0, row.at_most()};
  if (number.owner == Owner::tolerance) {
    const auto& t = p.drawing.tolerances[l.owner];
    v.name = t.id + " " + part::name(t.kind);
  } else if (number.owner == Owner::operation) {
    v.name += " of " + (*p.operations)[l.owner].id;
  }
  if (row.relaxed_by || apart(row)) {
    v.now = *number.now(p, l.owner);
    return v;
  }
  v.now = v.at_most ? 0 : kWithout;
  for (std::size_t i = 0; i < owners(p, number.owner); ++i)
    if (const auto now = number.now(p, i))
      v.now = v.at_most ? std::max(v.now, *now) : std::min(v.now, *now);
  return v;
}

double relaxed_value(const LimitValue& limit, double factor) {
  return limit.at_most ? limit.now * factor : limit.now / factor;
}

double reported_factor(const LimitValue& limit, double factor) {
  if (limit.at_most) return rounded_up(limit.now * factor) / limit.now;
  return rounded_up(factor);
}

}  // namespace turnwright::planning
