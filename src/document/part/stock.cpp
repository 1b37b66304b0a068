#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/say.hpp"
#include "part_sections.hpp"

namespace turnwright::document {
namespace {

constexpr double kSame_mm = 1e-6;

const Choices<part::StockKind>& stock_kinds() {
  static const Choices<part::StockKind> kKinds{
      {"bar", part::StockKind::bar},         {"tube", part::StockKind::tube},
      {"hexagon", part::StockKind::hexagon}, {"square", part::StockKind::square},
      {"casting", part::StockKind::casting}, {"forging", part::StockKind::forging}};
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
    case part::StockKind::casting:
    case part::StockKind::forging:
      return "outline";
  }
  return "across_flats_mm";
}

bool has_outline(part::StockKind kind) {
  return kind == part::StockKind::casting || kind == part::StockKind::forging;
}

const char* length_key(part::StockKind kind) {
  return has_outline(kind) ? "outline" : "length_mm";
}

// The outer diameter, through the corners, of a stock by what its document says of it.
double outer_mm(part::StockKind kind, double said_mm) {
  const int n = part::flats(kind);
  return n > 0 ? said_mm / std::cos(std::numbers::pi / n) : said_mm;
}

part::BlankPiece read_piece(Reader r) {
  part::BlankPiece piece;
  piece.length_mm = r.number("length_mm", kSize);
  if (r.has("left_mm") || r.has("right_mm")) {
    piece.left_mm = r.number("left_mm", kSize);
    piece.right_mm = r.number("right_mm", kSize);
  } else {
    piece.left_mm = piece.right_mm = r.number("diameter_mm", kSize);
  }
  r.finish();
  return piece;
}

// The outline of a casting or forging, with its length and largest diameter.
void read_outline(Draft& draft, Reader& r, part::Stock& stock) {
  for (const Reader& item : r.items("outline", 1, 100))
    stock.outline.push_back(read_piece(item.as_object()));
  double largest_mm = stock.length_mm = stock.outline.empty() ? NAN : 0;
  for (const auto& piece : stock.outline) {
    stock.length_mm += piece.length_mm;
    largest_mm = std::max({largest_mm, piece.left_mm, piece.right_mm});
  }
  if (r.has("limits_mm"))
    stock.outline_limits = read_limits(r);
  else
    draft.assume("/stock/limits_mm", {0, 0},
                 tr("its diameters are as its outline says; castings and forgings "
                    "differ: ISO 8062-3, EN 10243-1"));
  stock.outer_mm = largest_mm + stock.outline_limits.upper_mm;
  draft.assume("/stock/outline", tr("no skin"),
               tr("a hard skin, draft beside its walls and a mismatch of its halves wear "
                  "no edge and turn no pass into an interrupted one"));
}

bool lengths_were_read(const part::Drawing& d) {
  return d.stock.length_mm > 0 && std::isfinite(d.stock.outer_mm) &&
         std::isfinite(d.stock.left_allowance_mm) && !d.outer.empty() &&
         std::ranges::all_of(d.outer, [](const auto& e) { return e.length_mm > 0; });
}

// Elements that stay as a casting or forging is have the diameter of its outline there.
void take_from_outline(Draft& draft) {
  auto& d = draft.drawing();
  const auto items = draft.root.items("outer", 1, 100);
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    auto& e = d.outer[i];
    if (!e.as_stock) continue;
    const double z = part::left_z_mm(d, i);
    const auto at = part::stock_between(d.stock, z, z + e.length_mm);
    const auto& limits = d.stock.outline_limits;
    e.left_mm = e.right_mm = at.most_mm - limits.upper_mm;
    if (std::abs(e.left_mm - (at.least_mm - limits.lower_mm)) > kSame_mm)
      items[i].problem(tr("a stretch on which the outline of the stock is no cylinder"),
                       tr("an element within one cylinder of the outline"), "conflict");
  }
}

// A casting or forging stands above everything that is turned from it.
void check_outline(const Draft& draft, Reader& r, const part::Drawing& d) {
  for (std::size_t i = 0; i < d.outer.size(); ++i) {
    const auto& e = d.outer[i];
    if (e.as_stock) continue;
    const double least_mm = part::stock_of(d, i).least_mm,
                 drawn_mm = std::max(e.left_mm, e.right_mm);
    if (least_mm <= drawn_mm)
      r.problem_at("outline",
                   e.cut ? say("more than the {} mm from which {} is cut all over it; it "
                               "may be {} mm",
                               number_text(drawn_mm), e.id, number_text(least_mm))
                         : say("more than the {} mm of {} all over it; it may be {} mm",
                               number_text(drawn_mm), e.id, number_text(least_mm)),
                   "conflict");
  }
  double thinnest_mm = INFINITY;
  for (const auto& piece : d.stock.outline)
    thinnest_mm = std::min({thinnest_mm, piece.left_mm, piece.right_mm});
  thinnest_mm += d.stock.outline_limits.lower_mm;
  if (thinnest_mm <= d.stock.inner_mm)
    r.problem_at("outline",
                 say("diameters above its hole, {} mm; the least may be {} mm",
                     number_text(d.stock.inner_mm), number_text(thinnest_mm)),
                 "conflict");
  const auto& machine = draft.loaded.plan.machine;
  if (machine.swing_mm > 0 && d.stock.outer_mm > machine.swing_mm)
    r.problem_at(
        "outline",
        say("at most the swing of {}, {} mm", machine.id, number_text(machine.swing_mm)),
        "conflict");
}

void check_diameters(Reader& r, const Draft& draft, const part::Drawing& drawing) {
  const auto& stock = drawing.stock;
  double largest_mm = 0, smallest_mm = stock.outer_mm;
  for (const auto& e : drawing.outer) {
    if (e.as_stock) continue;
    largest_mm = std::max({largest_mm, e.left_mm, e.right_mm});
    if (e.left_mm > 0) smallest_mm = std::min({smallest_mm, e.left_mm, e.right_mm});
  }
  if (!has_outline(stock.kind) && part::across_mm(stock) <= largest_mm)
    r.problem_at(outer_key(stock.kind),
                 say("more than the largest element, {} mm", number_text(largest_mm)),
                 "conflict");
  if (stock.inner_mm >= stock.outer_mm)
    r.problem_at("inner_mm", tr("less than outer_mm"), "order");
  else if (stock.inner_mm >= smallest_mm)
    r.problem_at("inner_mm",
                 say("less than the smallest element, {} mm", number_text(smallest_mm)),
                 "conflict");
  const auto& machine = draft.loaded.plan.machine;
  if (!has_outline(stock.kind) && machine.swing_mm > 0 &&
      stock.outer_mm > machine.swing_mm)
    r.problem_at(outer_key(stock.kind),
                 part::flats(stock.kind) > 0
                     ? say("corners within the swing of {}, {} mm", machine.id,
                           number_text(machine.swing_mm))
                     : say("at most the swing of {}, {} mm", machine.id,
                           number_text(machine.swing_mm)),
                 "conflict");
}

void check_length(Reader& r, const Draft& draft, part::Drawing& drawing) {
  constexpr double kSum_mm = 1e-9;  // rounding of sums of lengths
  const double least_mm = part::length_mm(drawing) + drawing.stock.left_allowance_mm;
  if (drawing.stock.length_mm < least_mm - kSum_mm)
    r.problem_at(length_key(drawing.stock.kind),
                 say("at least the finished length and left_allowance_mm, {} mm",
                     number_text(least_mm)),
                 "conflict");
  else
    drawing.stock.length_mm = std::max(drawing.stock.length_mm, least_mm);
  const auto& machine = draft.loaded.plan.machine;
  if (machine.between_centres_mm > 0 &&
      drawing.stock.length_mm > machine.between_centres_mm)
    r.problem_at(length_key(drawing.stock.kind),
                 say("at most the distance between centres of {}, {} mm", machine.id,
                     number_text(machine.between_centres_mm)),
                 "conflict");
}

// What the models leave out of a section with corners.
void assume_corners(Draft& draft, const part::Stock& stock) {
  if (part::flats(stock.kind) == 0) return;
  draft.assume("/stock/kind", draft.loaded.json["stock"]["kind"],
               tr("passes through the corners count as if they were round, their shocks "
                  "do not wear the edge"));
  if (stock.kind == part::StockKind::square)
    draft.assume("/machine/chuck", tr("four jaws or a collet"),
                 tr("three jaws do not centre a square bar"));
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
  const bool blank = has_outline(stock.kind);
  if (blank) {
    read_outline(draft, r, stock);
    stock.inner_mm = r.number_or("inner_mm", kSize, 0);
  } else {
    stock.outer_mm = outer_mm(stock.kind, r.number(outer_key(stock.kind), kSize));
    if (stock.kind == part::StockKind::tube) stock.inner_mm = r.number("inner_mm", kSize);
    stock.length_mm = r.number("length_mm", kSize);
  }
  if (r.has("left_allowance_mm")) {
    stock.left_allowance_mm = r.number("left_allowance_mm", within(0, 20000, "mm"));
  } else if (!r.broken()) {
    stock.left_allowance_mm =
        std::max(0.0, (stock.length_mm - part::length_mm(drawing)) / 2);
    draft.assume("/stock/left_allowance_mm", stock.left_allowance_mm,
                 tr("half of what the stock is longer than the part"));
  }
  if (!blank)
    stock.parted_mm = r.optional_number("part_off_allowance_mm", within(0, 100, "mm"));
  draft.plan().stock_price = r.number_or("price", within(0, 1e9), 0);
  r.finish();
  assume_corners(draft, stock);
  check_length(r, draft, drawing);
  if (blank && lengths_were_read(drawing)) {
    take_from_outline(draft);
    check_outline(draft, r, drawing);
  }
  check_diameters(r, draft, drawing);
}

}  // namespace turnwright::document
