#include <algorithm>
#include <cmath>
#include <string>

#include "base/say.hpp"
#include "part_sections.hpp"
#include "turnwright/base/pattern.hpp"

namespace turnwright::document {
namespace {

using part::CentreHole;
using part::End;

// "ISO 6411-A4/8.5", also "DIN 332-A 4x8,5".
std::optional<CentreHole> read_designation(const Reader& r) {
  const auto text = r.as_text(40);
  static const Pattern kForm(
      R"(\s*(?:(?:ISO\s*6411|DIN\s*332)\s*[-\s]\s*)?([A-Z])\s*(\d{1,4}(?:[.,]\d{1,4})?)\s*(?:/|[xX]|×)\s*(\d{1,4}(?:[.,]\d{1,4})?)\s*)");
  std::optional<CentreHole> found;
  if (const auto m = kForm.match(text))
    found = part::centre_hole((*m)[1][0], decimal((*m)[2]), decimal((*m)[3]));
  if (!found && !text.empty())
    r.problem(tr("a centre hole of ISO 6411's form A, B or R with its pilot's and its "
                 "largest diameter, like \"A4/8.5\", \"B2.5/8\" or \"R4/8.5\"; a thread "
                 "in a centre is an inner thread"),
              "choice");
  return found;
}

// What an end's bores, or its centre hole, take of the part's length.
double taken_mm(const part::Drawing& d, End end) {
  const auto& centre = part::centre_at(d, end);
  double depth = centre ? centre->depth_mm : 0;
  for (const auto& e : d.inner)
    if (e.from == end) depth += e.length_mm;
  return depth;
}

// Diameter of an end's face inside its chamfer.
double face_mm(const part::Drawing& d, End end) {
  const bool left = end == End::left;
  const auto& e = left ? d.outer.front() : d.outer.back();
  const auto& chamfer = left ? e.left_chamfer : e.right_chamfer;
  return (left ? e.left_mm : e.right_mm) - (chamfer ? 2 * chamfer->radial_mm : 0);
}

bool is_hollow(const part::Drawing& d, End end) {
  return d.stock.inner_mm > 0 ||
         std::ranges::any_of(d.inner, [&](const auto& e) { return e.from == end; });
}

}  // namespace

double decimal(std::string digits) {
  std::replace(digits.begin(), digits.end(), ',', '.');
  return std::stod(digits);
}

void read_centre_holes(Draft& draft) {
  auto& d = draft.drawing();
  for (Reader r : draft.root.optional_items("centre_holes", 0, 2)) {
    r = r.as_object();
    if (r.broken()) continue;
    const auto end = r.choice<End>("at", ends());
    const auto found = read_designation(r.at("designation", tr("a centre hole")));
    r.finish();
    if (!found || !sizes_were_read(d)) continue;
    auto& mine = end == End::left ? d.left_centre : d.right_centre;
    const double D = face_mm(d, end);
    const double room = part::length_mm(d) - taken_mm(d, part::opposite(end));
    if (mine)
      r.problem_at("at", tr("each end once"), "duplicate");
    else if (is_hollow(d, end))
      r.problem_at("at", tr("an end that is not hollow"), "conflict");
    else if (!(found->diameter_mm < D))
      r.problem_at(
          "designation",
          say("a centre hole that is less wide than the {} mm of that end's face",
              number_text(D)),
          "conflict");
    else if (!(found->depth_mm < room))
      r.problem_at("designation",
                   say("a centre hole that is less deep than the {} mm before what is "
                       "drawn from the other end",
                       number_text(std::round(1e3 * room) / 1e3)),
                   "conflict");
    else
      mine = found;
  }
}

}  // namespace turnwright::document
