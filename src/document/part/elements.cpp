#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "part_sections.hpp"
#include "turnwright/tolerance/iso286.hpp"

namespace turnwright::document {
namespace {

using part::CutKind;
using part::ElementKind;

enum class Side { outer, inner };

// How an element is read: its turned shape, or the groove, thread or arc cut into it.
struct Shape {
  ElementKind turned = ElementKind::cylinder;
  std::optional<CutKind> cut = {};
  bool as_stock = false;
};
const Choices<std::optional<Shape>> kShapes{{"cylinder", Shape{}},
                                            {"cone", Shape{ElementKind::cone}},
                                            {"arc", Shape{{}, CutKind::arc}},
                                            {"groove", Shape{{}, CutKind::groove}},
                                            {"thread", Shape{{}, CutKind::thread}},
                                            {"hole", Shape{{}, CutKind::hole}},
                                            {"as-stock", Shape{{}, {}, true}}};

// Bores never stay as the stock is.
const Choices<std::optional<Shape>>& shapes(Side side) {
  static const Choices<std::optional<Shape>> kBores(kShapes.begin(), kShapes.end() - 1);
  return side == Side::outer ? kShapes : kBores;
}

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

std::optional<part::Limits> limits_of_fit(Reader& r, const std::string& fit,
                                          double diameter_mm, Side side) {
  if (is_upper(fit[0]) != (side == Side::inner)) {
    r.problem_at("fit",
                 side == Side::outer
                     ? tr("a shaft's tolerance class, with a small letter, like \"h6\"")
                     : tr("a bore's tolerance class, with a capital letter, like \"H7\""),
                 "choice");
    return std::nullopt;
  }
  if (!std::isfinite(diameter_mm)) return std::nullopt;  // reported already
  try {
    return tolerance::fit_limits_mm(diameter_mm, fit);
  } catch (const std::domain_error& error) {
    r.problem_at("fit", say("an ISO 286 tolerance class ({})", error.what()), "choice");
    return std::nullopt;
  }
}

void read_roughness(Reader& r, std::optional<double>& Ra_um,
                    std::optional<double>& Rz_um) {
  Ra_um = r.optional_number("Ra_um", above_up_to(0, 100, "um"));
  Rz_um = r.optional_number("Rz_um", above_up_to(0, 400, "um"));
}

// Element is part::OuterElement or part::InnerElement here and below.
template <class Element>
void read_size(Reader& r, Element& e, Side side) {
  const double smallest_mm = std::min(e.left_mm, e.right_mm);
  e.fit = r.optional_text("fit", 8);
  if (r.has("limits_mm")) {
    e.limits = read_limits(r);
    if (e.fit) r.problem_at("limits_mm", tr("fit or limits_mm, not both"), "conflict");
    if (smallest_mm + e.limits->lower_mm <= 0)
      r.problem_at("limits_mm", tr("limits that leave a diameter > 0 mm"), "conflict");
  } else if (e.fit && !e.fit->empty()) {
    if (e.kind == ElementKind::cone)
      r.problem_at("fit", tr("limits_mm: a cone has no single size for a fit"),
                   "conflict");
    else
      e.limits = limits_of_fit(r, *e.fit, e.left_mm, side);
  }
}

// "25 k6", of a cone "25-30".
template <class Element>
std::string drawn_size(const Element& e) {
  std::string size = number_text(e.left_mm);
  if (e.left_mm != e.right_mm) size += "-" + number_text(e.right_mm);
  return e.fit ? size + " " + *e.fit : size;
}

// Turning leaves an allowance on the diameter and does not answer for what is ground: the
// size that is left then has a third of the allowance as its tolerance.
template <class Element>
void read_grinding(Draft& draft, Reader& r, Element& e, Side side) {
  constexpr double kShareOfAllowance = 1.0 / 3;
  const auto given = r.optional_number("grinding_allowance_mm", above_up_to(0, 5, "mm"));
  if (!given || !std::isfinite(*given + e.left_mm + e.right_mm)) return;
  const double by = side == Side::outer ? *given : -*given;
  if (!(std::min(e.left_mm, e.right_mm) + by > 0))
    return r.problem_at("grinding_allowance_mm", tr("less than the diameter"),
                        "conflict");
  e.ground_to = drawn_size(e);
  e.left_mm += by;
  e.right_mm += by;
  for (const char* key : {"fit", "limits_mm", "Ra_um", "Rz_um"})
    if (const auto value = r.find(key); value && !value->broken())
      draft.assume(r.pointer_of(key), value->json(),
                   tr("made by grinding: not predicted"));
  const double half = *given * kShareOfAllowance / 2;
  e.fit.reset();
  e.Ra_um.reset();
  e.Rz_um.reset();
  e.limits = part::Limits{-half, half};
  draft.ground_mm[e.id] = *given;
  draft.assume(r.pointer_of("limits_mm"), {-half, half},
               say("a third of the grinding allowance, about the {} mm that are turned",
                   number_text(e.left_mm)));
}

// A knurl raises the diameter that is turned to the one that is drawn.
void read_knurl(Draft& draft, Reader& r, part::OuterElement& e) {
  const auto given = r.find("knurl");
  if (!given) return;
  const auto text = given->as_text(40);
  const auto knurl = part::knurl(text);
  if (!knurl) {
    if (!text.empty())
      given->problem(tr("a knurl of DIN 82, RAA, RBL, RBR, RGE, RGV, RKE or RKV with a "
                        "pitch of 0.5, 0.6, 0.8, 1, 1.2 or 1.6 mm, like \"RAA0.8\""),
                     "choice");
    return;
  }
  const double d1 = e.left_mm;
  if (r.has("grinding_allowance_mm"))
    r.problem_at("knurl", tr("knurl or grinding_allowance_mm, not both"), "conflict");
  else if (knurl->pitch_mm > d1 / 3)
    r.problem_at("knurl", tr("a pitch of at most a third of the diameter"), "conflict");
  else if (std::isfinite(d1)) {
    const auto s = part::knurled(d1, *knurl);
    draft.assume(
        r.pointer_of("diameter_mm"), s.blank.left_mm,
        say("turned so before knurling, which raises it to the {} mm that are drawn",
            number_text(d1)));
    make_at_catalogue_conditions(draft, r, e, s.cut);
    e.left_mm = e.right_mm = s.blank.left_mm;
    draft.ground_mm[e.id] = s.blank.left_mm - d1;
  }
}

template <class Element>
void read_shape(Draft& draft, Reader& r, Element& e, Side side) {
  e.length_mm = r.number("length_mm", kSize);
  if (e.kind == ElementKind::cylinder) {
    e.left_mm = e.right_mm = r.number("diameter_mm", kSize);
  } else {
    e.left_mm = r.number("left_mm", kSize);
    e.right_mm = r.number("right_mm", kSize);
    if (e.left_mm == e.right_mm)
      r.problem_at("right_mm",
                   tr("another diameter than left_mm (else say \"cylinder\")"),
                   "conflict");
  }
  read_size(r, e, side);
  read_roughness(r, e.Ra_um, e.Rz_um);
  read_grinding(draft, r, e, side);
  if constexpr (std::is_same_v<Element, part::OuterElement>)
    if (e.kind == ElementKind::cylinder) read_knurl(draft, r, e);
  r.finish();
}

// An outer element that stays as the stock is.
void read_as_stock(const Draft& draft, Reader& r, part::OuterElement& e) {
  e.as_stock = true;
  e.length_mm = r.number("length_mm", kSize);
  e.left_mm = e.right_mm = outer_of_stock_mm(draft.loaded.json);
  r.finish();
}

template <class Element>
void read_list(Draft& draft, std::vector<Element>& list, const std::vector<Reader>& items,
               Side side, std::vector<std::string>& ids) {
  for (Reader r : items) {
    r = r.as_object();
    Element e;
    e.id = read_id(r);
    if (e.id == "left" || e.id == "right")
      r.problem_at("id",
                   tr("an id other than \"left\" and \"right\", which name the ends"),
                   "conflict");
    if (!e.id.empty() && std::find(ids.begin(), ids.end(), e.id) != ids.end())
      r.problem_at("id", tr("an id no other element has"), "duplicate");
    ids.push_back(e.id);
    const auto shape = r.choice<std::optional<Shape>>("kind", shapes(side));
    if constexpr (std::is_same_v<Element, part::InnerElement>)
      e.from = r.choice<part::End>("from", ends());
    if (shape && shape->cut) {
      read_cut(draft, r, e, *shape->cut);
    } else if (shape && shape->as_stock) {
      if constexpr (std::is_same_v<Element, part::OuterElement>)
        read_as_stock(draft, r, e);
    } else if (shape) {
      e.kind = shape->turned;
      read_shape(draft, r, e, side);
    }
    list.push_back(std::move(e));
  }
}

void read_faces(Draft& draft) {
  std::vector<std::string> known;
  const auto& d = draft.drawing();
  for (const auto& named : features(d))
    if (is_face(named.feature)) known.push_back(named.id);
  auto& faces = draft.drawing().faces;
  for (Reader r : draft.root.optional_items("faces", 0, 200)) {
    r = r.as_object();
    part::Face face;
    const Reader id = r.at("id", tr("the id of a face"));
    face.id = checked_wall(id, d, checked_reference(id, known, tr("a face of the part")));
    for (const auto& earlier : faces)
      if (!face.id.empty() && earlier.id == face.id)
        r.problem_at("id", tr("each face once"), "duplicate");
    read_roughness(r, face.Ra_um, face.Rz_um);
    r.finish();
    faces.push_back(std::move(face));
  }
}

}  // namespace

void read_elements(Draft& draft) {
  std::vector<std::string> ids;
  auto& drawing = draft.drawing();
  const auto outer = draft.root.items("outer", 1, 100);
  const auto inner = draft.root.optional_items("inner", 0, 100);
  read_list(draft, drawing.outer, outer, Side::outer, ids);
  read_list(draft, drawing.inner, inner, Side::inner, ids);
  give_grooves_their_blanks(draft, outer, inner);
  read_faces(draft);
}

std::string checked_wall(const Reader& value, const part::Drawing& d, std::string id) {
  const auto wall = part::inner_shoulder(d, id);
  if (!wall) return id;
  if (part::is_hole(d.inner[wall->wider]))
    value.problem(tr("the shoulder of a bore that is bored: none of what a drill makes "
                     "is predicted"),
                  "unsupported");
  return wall->id;
}

std::vector<NamedFeature> features(const part::Drawing& drawing) {
  std::vector<NamedFeature> out;
  const auto add = [&](const auto& e) {
    out.push_back({e.id, e.cut                             ? Feature::fixed
                         : e.kind == ElementKind::cylinder ? Feature::cylinder
                                                           : Feature::cone});
  };
  for (const auto& e : drawing.outer) {
    add(e);
    if (e.as_stock) out.back().feature = Feature::fixed;
  }
  for (const auto& e : drawing.inner) add(e);
  const bool unreadable = std::any_of(out.begin(), out.end(),
                                      [](const auto& named) { return named.id.empty(); });
  if (unreadable || drawing.outer.empty()) return {};
  out.push_back({"left", Feature::face});
  out.push_back({"right", Feature::face});
  for (std::size_t i = 1; i < drawing.outer.size(); ++i) {
    const auto &before = drawing.outer[i - 1], &after = drawing.outer[i];
    if (before.right_mm != after.left_mm)
      out.push_back({before.id + '|' + after.id, Feature::face});
  }
  for (const auto& s : part::inner_shoulders(drawing)) {
    out.push_back({s.id, Feature::wall});
    out.push_back({s.reversed, Feature::wall});
  }
  return out;
}

const Choices<part::End>& ends() {
  static const Choices<part::End> kEnds{{"left", part::End::left},
                                        {"right", part::End::right}};
  return kEnds;
}

}  // namespace turnwright::document
