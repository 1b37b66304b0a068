#include "turnwright/document/import.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/say.hpp"
#include "document/catalogue/entries.hpp"
#include "document/catalogue/material_names.hpp"
#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "given_file.hpp"
#include "outline.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/exchange/dxf.hpp"
#include "turnwright/exchange/notation.hpp"
#include "turnwright/exchange/step.hpp"

namespace turnwright::document {
namespace {

using exchange::Outline;
using nlohmann::json;
using nlohmann::ordered_json;

enum class Source { step, dxf, notation };
const Choices<Source> kSources{
    {"step", Source::step}, {"dxf", Source::dxf}, {"notation", Source::notation}};

constexpr double kFacing_mm = 2;  // for each end
constexpr double kHeld_mm = 40,
                 kPartedOff_mm = 0.6;  // of a bar from which parts are parted
constexpr const char* kGeneral = "ISO 2768-mK";

// Round bars as dealers keep them, an estimate: every millimetre counts when thin.
constexpr double kBars_mm[] = {
    6,   8,   10,  12,  14,  15,  16,  18,  20,  22,  25,  28,  30,  32,  35,  36,  40,
    42,  45,  48,  50,  52,  55,  60,  65,  70,  75,  80,  85,  90,  95,  100, 105, 110,
    115, 120, 125, 130, 140, 150, 160, 170, 180, 190, 200, 210, 220, 230, 240, 250};

double bar_mm(double largest_mm) {
  constexpr double kLeast_mm = 1, kStep_mm = 10;  // to take off; beyond the list
  for (const double d : kBars_mm)
    if (d >= largest_mm + kLeast_mm) return d;
  return kStep_mm * std::ceil((largest_mm + kLeast_mm) / kStep_mm);
}

// A STEP file and a DXF file say at their beginning what they are.
Source recognised(const std::string& bytes) {
  const auto begin = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const std::string_view rest = begin == std::string::npos
                                    ? std::string_view()
                                    : std::string_view(bytes).substr(begin);
  if (rest.starts_with("ISO-10303-21") || rest.starts_with("/*")) return Source::step;
  const auto line = rest.substr(0, rest.find_first_of("\r\n"));
  const bool code = line == "0" || line == "999";
  return code || rest.starts_with("AutoCAD Binary DXF") ? Source::dxf : Source::notation;
}

Outline read_drawing(const GivenFile& given, Source source,
                     const std::optional<std::string>& body) {
  switch (source) {
    case Source::step:
      return exchange::read_step(given.bytes, {.body = body.value_or("")});
    case Source::dxf:
      return exchange::read_dxf(given.bytes);
    case Source::notation:
      break;
  }
  return exchange::read_notation(given.bytes);
}

struct Choice {
  ordered_json material, stock, machine, general, batch;
  std::string name;
};

// What a drawing does not say and a plan needs, as the request gives it.
Choice read_choice(Reader& r) {
  Choice c;
  const auto member = [&](const char* name) {
    const auto value = r.find(name);
    return value && !value->broken() ? ordered_json(value->json()) : ordered_json();
  };
  c.material = member("material");
  c.stock = member("stock");
  c.machine = member("machine");
  c.batch = member("batch");
  c.general = member("general");
  c.name = r.text_or("name", "");
  return c;
}

class Remarks {
 public:
  void add(std::string at, std::string text) {
    list_.push_back({{"at", std::move(at)}, {"text", std::move(text)}});
  }
  void add(const std::vector<exchange::Remark>& remarks) {
    for (const auto& r : remarks) add(r.at, r.text);
  }
  ordered_json json() const { return list_; }

 private:
  ordered_json list_ = ordered_json::array();
};

// As turned, with what is left for grinding.  A convex arc may bulge beyond its ends: with its centre at (z, r), up to r + R.
double largest_mm(const exchange::Element& e) {
  const double ends_mm =
      std::max(e.left_mm, e.right_mm) + e.demands.grinding_mm.value_or(0);
  if (e.shape != exchange::Shape::arc || !e.convex) return ends_mm;
  const double rise = (e.right_mm - e.left_mm) / 2,
               half = std::hypot(e.length_mm, rise) / 2;
  const double off = std::sqrt(std::max(0.0, e.radius_mm * e.radius_mm - half * half));
  const double z = (e.length_mm + off * rise / half) / 2;
  const double r = (e.left_mm + e.right_mm) / 4 - off * e.length_mm / (2 * half);
  return z > 0 && z < e.length_mm ? std::max(ends_mm, 2 * (r + e.radius_mm)) : ends_mm;
}

double largest_mm(const Outline& o) {
  double largest = 0;
  for (const auto& e : o.outer) largest = std::max(largest, largest_mm(e));
  return largest;
}

// One diameter from end to end: no shoulder behind which a second setup could hold it.
bool plain(const Outline& o) {
  return std::all_of(o.outer.begin(), o.outer.end(), [&](const auto& e) {
    return e.left_mm == o.outer.front().left_mm && e.right_mm == e.left_mm;
  });
}

// The section of the bar: that which an element keeps, or the next round one.
struct Section {
  ordered_json stock;
  double across_mm = 0;
  std::string words;
};
Section section_of(const Outline& o) {
  for (const auto& e : o.outer) {
    if (e.shape != exchange::Shape::as_stock) continue;
    const char* kind = e.flats == 6 ? "hexagon" : e.flats == 4 ? "square" : "bar";
    const char* size = e.flats > 0 ? "across_flats_mm" : "diameter_mm";
    return {{{"kind", kind}, {size, e.left_mm}},
            e.left_mm,
            say("the bar that {} keeps, {}", e.id, mm_text(e.left_mm))};
  }
  const double d_mm = bar_mm(largest_mm(o));
  return {{{"kind", "bar"}, {"diameter_mm", d_mm}},
          d_mm,
          say("the next round bar, {}", mm_text(d_mm))};
}

ordered_json next_bar(const Outline& o, Remarks& assumed) {
  double length_mm = 0;
  for (const auto& e : o.outer) length_mm += e.length_mm;
  auto [stock, across_mm, words] = section_of(o);
  const auto micrometres = [](double mm) { return std::round(mm * 1e6) / 1e6; };
  if (plain(o)) {
    const double held_mm = std::max(kHeld_mm, across_mm);
    assumed.add("/stock",
                say("The stock is {}: {} of it are held, and the part is parted off.",
                    words, mm_text(held_mm)));
    stock["length_mm"] = micrometres(length_mm + held_mm + kFacing_mm);
    stock["left_allowance_mm"] = held_mm;
    stock["part_off_allowance_mm"] = kPartedOff_mm;
    return stock;
  }
  assumed.add("/stock", say("The stock is {}, with {} to face at each end.", words,
                            mm_text(kFacing_mm)));
  stock["length_mm"] = micrometres(length_mm + 2 * kFacing_mm);
  stock["left_allowance_mm"] = kFacing_mm;
  return stock;
}

// The stock is the bar that the first element keeps; others that keep another are told.
void tell_other_bars(const Outline& o, Remarks& ignored) {
  const exchange::Element* first = nullptr;
  for (const auto& e : o.outer) {
    if (e.shape != exchange::Shape::as_stock) continue;
    if (!first) first = &e;
    if (e.flats != first->flats || e.left_mm != first->left_mm)
      ignored.add("/stock",
                  say("{} keeps another bar than {}, of which the part is made.", e.id,
                      first->id));
  }
}

// A drawing may name none, one, several or an unknown one.
std::string expected_material(const std::string& drawings,
                              const std::vector<catalogue::Material>& called,
                              const Catalogue& catalogue) {
  if (called.size() > 1)
    return say("for the drawing's \"{}\" {}", drawings, expected_state(called));
  const auto known = expected_reference(drawings, ids(catalogue.materials),
                                        tr("a material of the catalogue"));
  return drawings.empty()
             ? say("a material, which the drawing does not name: {}", known)
             : say("a material of the catalogue for the drawing's \"{}\": {}", drawings,
                   known);
}

ordered_json material_of_part(const Outline& o, const Choice& choice,
                              const Catalogue& catalogue, Reader& r, Remarks& assumed) {
  const auto called = materials_called(o.material, catalogue.materials);
  if (!choice.material.is_null()) {
    const auto wanted =
        choice.material.is_string()
            ? materials_called(choice.material.get<std::string>(), catalogue.materials)
            : std::vector<catalogue::Material>{};
    const bool same =
        wanted.size() == 1 && std::ranges::any_of(called, [&](const auto& m) {
          return m.id == wanted.front().id;
        });
    if (!o.material.empty() && !same)
      assumed.add(
          "/material",
          say("The request's material is taken, not the drawing's {}.", o.material));
    return choice.material;
  }
  if (called.size() == 1) {
    assumed.add("/material", say("The drawing says {}: {} of the catalogue.", o.material,
                                 called[0].id));
    return called[0].id;
  }
  r.problem_at("material", expected_material(o.material, called, catalogue), "missing");
  return nullptr;
}

ordered_json part_document(const Outline& o, const Choice& choice,
                           const Catalogue& catalogue, Reader& r, Remarks& assumed) {
  ordered_json part{{"format", "turnwright-part/1"}};
  const std::string name = choice.name.empty() ? o.name : choice.name;
  if (!name.empty()) part["name"] = name;
  part["material"] = material_of_part(o, choice, catalogue, r, assumed);
  part["stock"] = choice.stock.is_null() ? next_bar(o, assumed) : choice.stock;
  part.update(part_members(o));
  if (!choice.general.is_null()) {
    part["general"] = choice.general;
  } else if (!o.general.empty()) {
    part["general"] = o.general;
  } else {
    part["general"] = kGeneral;
    assumed.add("/general",
                say("Sizes left open have the general tolerances {}.", kGeneral));
  }
  if (!choice.machine.is_null()) part["machine"] = choice.machine;
  part["choose"] = {{"setups", "auto"}};
  if (!choice.batch.is_null()) part["batch"] = choice.batch;
  return part;
}

// What the planner would refuse of the part: of a member that the request gives a problem
// with the request; of the drawing a remark, for the part can be edited.
void check_part(const ordered_json& part, const json& request, const Catalogue& catalogue,
                Problems& problems, Remarks& ignored) {
  try {
    load_part_plan(part, catalogue, "import");
  } catch (const InputError& error) {
    for (const auto& p : error.problems()) {
      const auto member = p.pointer.substr(0, p.pointer.find('/', 1));
      if (member.size() > 1 && request.contains(member.substr(1)))
        problems.add(p);
      else
        ignored.add(p.pointer, say("The planner refuses this: got {}, expected {}.",
                                   p.got, p.expected));
    }
  }
}

}  // namespace

ordered_json import(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "import"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-import/1");
  const auto given = read_given_file(r, to_translate("drawing"), kLargestDrawing);
  const auto as = r.optional_choice("source", kSources);
  const auto body = r.optional_text("body");
  const Choice choice = read_choice(r);
  r.finish();
  problems.throw_if_any();

  const Source source = as.value_or(recognised(given.bytes));
  Outline outline;
  try {
    outline = read_drawing(given, source, body);
  } catch (const InputError& error) {
    rethrow_at(error, "import", given.pointer);
  }
  Remarks assumed, ignored;
  assumed.add(outline.assumed);
  ignored.add(outline.ignored);
  tell_other_bars(outline, ignored);
  auto part = part_document(outline, choice, catalogue, r, assumed);
  problems.throw_if_any();
  check_part(part, request, catalogue, problems, ignored);
  problems.throw_if_any();
  const auto word = std::find_if(kSources.begin(), kSources.end(),
                                 [&](const auto& s) { return s.second == source; });
  return {{"source", word->first},
          {"part", std::move(part)},
          {"assumed", assumed.json()},
          {"ignored", ignored.json()}};
}

json import_request(std::string bytes) {
  json text(std::move(bytes));
  try {
    text.dump();
    return {{"text", std::move(text)}};
  } catch (const json::type_error&) {  // not UTF-8
    const auto& raw = text.get_ref<const std::string&>();
    return {{"base64", base64_of(raw)}};
  }
}

}  // namespace turnwright::document
