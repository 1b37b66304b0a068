#include <algorithm>
#include <cmath>
#include <numbers>

#include "part_sections.hpp"

namespace turnwright::document {
namespace {

const Choices<part::StockKind>& stock_kinds() {
  static const Choices<part::StockKind> kKinds{{"bar", part::StockKind::bar},
                                               {"tube", part::StockKind::tube},
                                               {"hexagon", part::StockKind::hexagon},
                                               {"square", part::StockKind::square}};
  return kKinds;
}

// Cross-checks of the stock report at the pointer of its diameter.
const char* outer_key(part::StockKind kind) {
  switch (kind) {
    case part::StockKind::bar:
      return "diameter_mm";
    case part::StockKind::tube:
      return "outer_mm";
    case part::StockKind::hexagon:
    case part::StockKind::square:
      break;
  }
  return "across_flats_mm";
}

// The outer diameter, through the corners, of a stock by what its document says of it.
double outer_mm(part::StockKind kind, double said_mm) {
  const int n = part::flats(kind);
  return n > 0 ? said_mm / std::cos(std::numbers::pi / n) : said_mm;
}

void check_diameters(Reader& r, const Draft& draft, const part::Drawing& drawing) {
  const auto& stock = drawing.stock;
  double largest_mm = 0, smallest_mm = stock.outer_mm;
  for (const auto& e : drawing.outer) {
    if (e.as_stock) continue;
    largest_mm = std::max({largest_mm, e.left_mm, e.right_mm});
    if (e.left_mm > 0) smallest_mm = std::min({smallest_mm, e.left_mm, e.right_mm});
  }
  if (part::across_mm(stock) <= largest_mm)
    r.problem_at(outer_key(stock.kind),
                 "more than the largest element, " + number_text(largest_mm) + " mm",
                 "conflict");
  if (stock.inner_mm >= stock.outer_mm)
    r.problem_at("inner_mm", "less than outer_mm", "order");
  else if (stock.inner_mm >= smallest_mm)
    r.problem_at("inner_mm",
                 "less than the smallest element, " + number_text(smallest_mm) + " mm",
                 "conflict");
  const auto& machine = draft.loaded.plan.machine;
  if (machine.swing_mm > 0 && stock.outer_mm > machine.swing_mm)
    r.problem_at(outer_key(stock.kind),
                 std::string(part::flats(stock.kind) > 0 ? "corners within" : "at most") +
                     " the swing of " + machine.id + ", " +
                     number_text(machine.swing_mm) + " mm",
                 "conflict");
}

void check_length(Reader& r, const Draft& draft, part::Drawing& drawing) {
  constexpr double kSum_mm = 1e-9;  // rounding of sums of lengths
  const double least_mm = part::length_mm(drawing) + drawing.stock.left_allowance_mm;
  if (drawing.stock.length_mm < least_mm - kSum_mm)
    r.problem_at("length_mm",
                 "at least the finished length and left_allowance_mm, " +
                     number_text(least_mm) + " mm",
                 "conflict");
  else
    drawing.stock.length_mm = std::max(drawing.stock.length_mm, least_mm);
  const auto& machine = draft.loaded.plan.machine;
  if (machine.between_centres_mm > 0 &&
      drawing.stock.length_mm > machine.between_centres_mm)
    r.problem_at("length_mm",
                 "at most the distance between centres of " + machine.id + ", " +
                     number_text(machine.between_centres_mm) + " mm",
                 "conflict");
}

// What the models leave out of a section with corners.
void assume_corners(Draft& draft, const part::Stock& stock) {
  if (part::flats(stock.kind) == 0) return;
  draft.assume("/stock/kind", draft.loaded.json["stock"]["kind"],
               "passes through the corners count as if they were round, their shocks do "
               "not wear the edge");
  if (stock.kind == part::StockKind::square)
    draft.assume("/machine/chuck", "four jaws or a collet",
                 "three jaws do not centre a square bar");
}

}  // namespace

double outer_of_stock_mm(const nlohmann::json& part) {
  const auto stock = part.find("stock");
  if (stock == part.end() || !stock->is_object()) return NAN;  // reported with the stock
  const auto kind = stock->value("kind", nlohmann::json());
  for (const auto& [name, value] : stock_kinds())
    if (kind == name)
      if (const auto said = stock->find(outer_key(value));
          said != stock->end() && said->is_number())
        return outer_mm(value, said->get<double>());
  return NAN;
}

void read_stock(Draft& draft) {
  auto& drawing = draft.drawing();
  auto& stock = drawing.stock;
  Reader r = draft.root.object("stock");
  stock.kind = r.choice<part::StockKind>("kind", stock_kinds());
  stock.outer_mm = outer_mm(stock.kind, r.number(outer_key(stock.kind), kSize));
  if (stock.kind == part::StockKind::tube) stock.inner_mm = r.number("inner_mm", kSize);
  stock.length_mm = r.number("length_mm", kSize);
  if (r.has("left_allowance_mm")) {
    stock.left_allowance_mm = r.number("left_allowance_mm", within(0, 20000, "mm"));
  } else if (!r.broken()) {
    stock.left_allowance_mm =
        std::max(0.0, (stock.length_mm - part::length_mm(drawing)) / 2);
    draft.assume("/stock/left_allowance_mm", stock.left_allowance_mm,
                 "half of what the stock is longer than the part");
  }
  stock.parted_mm = r.optional_number("part_off_allowance_mm", within(0, 100, "mm"));
  draft.plan().stock_price = r.number_or("price", within(0, 1e9), 0);
  r.finish();
  assume_corners(draft, stock);
  check_diameters(r, draft, drawing);
  check_length(r, draft, drawing);
}

}  // namespace turnwright::document
