#include "response_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/say.hpp"
#include "document/json/text_lines.hpp"
#include "universal_file.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kLines = 20000;

struct AskedDof {
  std::optional<long> node;
  std::optional<int> direction;
  bool fits(const UniversalDof& dof) const {
    return node.value_or(dof.node) == dof.node &&
           direction.value_or(dof.direction) == dof.direction;
  }
};

AskedDof read_dof(Reader& r, std::string_view key) {
  AskedDof out;
  if (auto given = r.optional_object(key)) {
    out.node = given->optional_integer("node", 0, 1'000'000'000);
    out.direction = given->optional_choice<int>("direction", {{"+X", 1},
                                                              {"-X", -1},
                                                              {"+Y", 2},
                                                              {"-Y", -2},
                                                              {"+Z", 3},
                                                              {"-Z", -3},
                                                              {"scalar", 0}});
    given->finish();
  }
  return out;
}

bool is_drive_point(const UniversalFunction& f) {
  return f.response.node == f.reference.node &&
         std::abs(f.response.direction) == std::abs(f.reference.direction);
}

std::string text_of(const UniversalFunction& f) {
  return say("{} ({} by {})", f.number, text_of(f.response), text_of(f.reference));
}

using Functions = std::vector<const UniversalFunction*>;

std::string list(const Functions& all) {
  constexpr std::size_t kShown = 10;
  std::string out;
  for (std::size_t i = 0; i < std::min(all.size(), kShown); ++i)
    out += (i == 0 ? "" : ", ") + text_of(*all[i]);
  return out + (all.size() > kShown ? " .." : "");
}

/// The response asked for; none or several are reported, unless the file has problems.
const UniversalFunction* chosen(Reader& uff, const Reader& text, bool good,
                                const std::vector<UniversalFunction>& all) {
  const auto number = uff.optional_integer("record", 1, 1'000'000);
  const AskedDof response = read_dof(uff, "response"),
                 reference = read_dof(uff, "reference");
  Functions responses, fitting, drive;
  for (const UniversalFunction& f : all) {
    if (f.type != UniversalFunction::kResponse) continue;
    responses.push_back(&f);
    if (number && *number != static_cast<long>(f.number)) continue;
    if (!response.fits(f.response) || !reference.fits(f.reference)) continue;
    fitting.push_back(&f);
    if (is_drive_point(f)) drive.push_back(&f);
  }
  if (!good) return nullptr;
  if (fitting.size() == 1) return fitting[0];
  if (drive.size() == 1) return drive[0];
  const Functions& several = drive.empty() ? fitting : drive;
  if (responses.empty())
    text.problem(tr("no frequency response"), tr("a dataset 58 of function type 4"),
                 "missing");
  else if (fitting.empty())
    uff.problem(tr("none of the records asked for"),
                say("of the records {}", list(responses)), "missing");
  else
    uff.problem(say("the records {}", list(several)),
                tr("one of them, chosen by record, response and reference"), "count");
  return nullptr;
}

/// Coherence of the same DOFs and abscissae.
const UniversalFunction* coherence_of(const UniversalFunction& f,
                                      const std::vector<UniversalFunction>& all) {
  const auto found = std::ranges::find_if(all, [&](const UniversalFunction& c) {
    return c.type == UniversalFunction::kCoherence && c.response == f.response &&
           c.reference == f.reference && c.x == f.x;
  });
  return found == all.end() ? nullptr : &*found;
}

/// A unit of an axis with the dimensions its data type must have; none if its label says
/// nothing that can be read.
std::optional<MeasuredUnit> labelled(const UniversalAxis& axis) {
  return axis.units.empty() ? std::nullopt : measured_unit(axis.units);
}

/// Order of derivative by time of the specific data types of motions.
std::optional<int> derivative_of_type(int type) {
  switch (type) {
    case 8:
      return 0;
    case 11:
      return 1;
    case 12:
      return 2;
    default:
      return std::nullopt;
  }
}

bool is_force_type(int type) { return type == 13 || type == 9; }

/// The unit that the labels of ordinate and denominator name.
std::optional<WrittenUnit> unit_of_labels(const UniversalFunction& f) {
  const auto motion = labelled(f.ordinate), force = labelled(f.denominator);
  if (!motion) return std::nullopt;
  if (const auto whole = response_unit(*motion); whole && !force)
    return WrittenUnit{f.ordinate.units, *whole};
  const auto derivative = motion_derivative(*motion);
  if (!force || !derivative || !force->of_dimensions(0, 0, 1)) return std::nullopt;
  return WrittenUnit{f.ordinate.units + "/" + f.denominator.units,
                     {*derivative, motion->scale / force->scale}};
}

/// The unit by data types and dataset 164, whose factors are m and N to the file's units.
std::optional<WrittenUnit> unit_of_types(const UniversalFunction& f) {
  const auto derivative = derivative_of_type(f.ordinate.type);
  if (!derivative || !is_force_type(f.denominator.type) || !f.units) return std::nullopt;
  constexpr const char* kTimes[] = {"", "/s", "/s2"};
  return WrittenUnit{say("length{}/force of dataset 164", kTimes[*derivative]),
                     {*derivative, 1e3 * f.units->force / f.units->length}};
}

/// Whether what the labels say, each by itself, is what dataset 164 says.
bool labels_agree(const UniversalFunction& f, int derivative) {
  constexpr double kSame = 1e-6;
  const auto is = [&](const UniversalAxis& axis, const MeasuredUnit& unit) {
    if (axis.units.empty()) return true;
    const auto label = measured_unit(axis.units);
    return label && label->of_dimensions(unit.length, unit.time, unit.force) &&
           std::abs(label->scale / unit.scale - 1) < kSame;
  };
  return is(f.ordinate, {1e3 / f.units->length, 1, -derivative, 0}) &&
         is(f.denominator, {1 / f.units->force, 0, 0, 1});
}

/// The unit that the file states; contradictions are reported.
std::optional<WrittenUnit> stated_unit(const Reader& text, const UniversalFunction& f) {
  constexpr double kSame = 1e-6;  // factors are printed to 7 digits or more
  const auto labels = unit_of_labels(f), types = unit_of_types(f);
  const auto derivative = derivative_of_type(f.ordinate.type);
  const auto wrong = [&](const std::string& got, const std::string& what) {
    text.problems().add({line_pointer(text, f.line + 8), shown(got),
                         say("{}, or \"unit\", which decides", what), "unit"});
    return std::nullopt;
  };
  if (labels && derivative && *derivative != labels->unit.derivative)
    return wrong(labels->text, say("{}, as data type {} says",
                                   tr(quantity_of(*derivative)), f.ordinate.type));
  if (labels && types && std::abs(labels->unit.mm / types->unit.mm - 1) > kSame)
    return wrong(labels->text, tr("units that agree with dataset 164"));
  if (!labels && types && !labels_agree(f, *derivative))
    return wrong(f.ordinate.units + "/" + f.denominator.units,
                 tr("units that can be read and agree with dataset 164"));
  if (!labels && !types && !f.ordinate.units.empty())
    return wrong(f.ordinate.units + "/" + f.denominator.units,
                 tr("a unit of motion per force"));
  return labels ? labels : types;
}

std::optional<WrittenUnit> unit_of(Reader& r, const Reader& text,
                                   const UniversalFunction& f,
                                   const std::optional<WrittenUnit>& given) {
  const auto derivative = derivative_of_type(f.ordinate.type);
  if (given && derivative && *derivative != given->unit.derivative)
    r.problem_at("unit",
                 say("that of {}, as data type {} of the file says",
                     tr(quantity_of(*derivative)), f.ordinate.type),
                 "conflict");
  if (given) return given;
  const auto before = problems_of(r);
  const auto stated = stated_unit(text, f);
  if (problems_of(r) > before) return std::nullopt;
  return agreed_unit(r, given, stated, tr("by the labels or dataset 164 of the file"));
}

/// Hz of one unit of the abscissa; another quantity is reported.
double hertz_of(const Reader& text, const UniversalFunction& f) {
  constexpr int kUnknown = 0, kGeneral = 1, kFrequency = 18;
  const UniversalAxis& axis = f.abscissa;
  const auto hertz = hertz_of_unit(axis.units);
  const bool by_type = axis.type == kFrequency,
             by_label = (axis.type == kUnknown || axis.type == kGeneral) && hertz;
  if (!(by_type && (hertz || axis.units.empty())) && !by_label)
    text.problems().add(
        {line_pointer(text, f.line + 7),
         say("data type {} and unit {} of the abscissa", axis.type, shown(axis.units)),
         tr("frequency, type 18, in Hz"), "unit"});
  return hertz.value_or(1);
}

std::vector<MeasuredLine> lines_of(const Reader& text, const UniversalFunction& f,
                                   const UniversalFunction* coherence, double hertz,
                                   double mm) {
  const bool against = is_drive_point(f) && f.response.direction != f.reference.direction;
  std::vector<MeasuredLine> out;
  for (std::size_t i = 0; i < f.x.size(); ++i) {
    MeasuredLine line{.frequency_Hz = hertz * f.x[i],
                      .value = (against ? -mm : mm) * f.y[i],
                      .pointer = line_pointer(text, f.lines[i])};
    if (!(line.frequency_Hz >= 0 && line.frequency_Hz <= 1e6))
      text.problems().add({line.pointer, number_text(line.frequency_Hz) + " Hz",
                           tr("a number from 0 to 1000000 Hz"), "range"});
    if (coherence) {
      line.coherence = coherence->y[i].real();
      if (!(*line.coherence >= 0 && *line.coherence <= 1))
        text.problems().add({line_pointer(text, coherence->lines[i]),
                             say("a coherence of {}", number_text(*line.coherence)),
                             tr("a number from 0 to 1"), "range"});
    }
    out.push_back(std::move(line));
  }
  return out;
}

nlohmann::ordered_json described(const UniversalFunction& f) {
  return {{"number", f.number},
          {"name", f.name},
          {"response", text_of(f.response)},
          {"reference", text_of(f.reference)}};
}

}  // namespace

std::optional<MeasuredResponse> read_response_file(Reader& r) {
  const auto given = read_response_unit(r);
  const auto before = problems_of(r);
  Reader uff = r.object("uff");
  const Reader text = uff.at("text", tr("the text of a universal file, or its lines"));
  const auto functions = read_universal_file(text);
  const bool good = problems_of(r) == before;
  const UniversalFunction* const f = chosen(uff, text, good, functions);
  uff.finish();
  if (!f) return std::nullopt;
  if (!f->complex)
    text.problems().add({line_pointer(text, f->line + 6), tr("a real ordinate"),
                         tr("a complex one, of type 5 or 6"), "type"});
  if (f->x.size() > kLines)
    text.problems().add({line_pointer(text, f->line + 6), say("{} lines", f->x.size()),
                         say("at most {}", kLines), "count"});
  MeasuredResponse out;
  out.key = "uff";
  const double hertz = hertz_of(text, *f);
  const auto unit = unit_of(r, text, *f, given);
  out.lines =
      lines_of(text, *f, coherence_of(*f, functions), hertz, unit ? unit->unit.mm : 1);
  if (problems_of(r) > before || !unit) return std::nullopt;
  out.derivative = unit->unit.derivative;
  out.unit = unit->text;
  out.told["record"] = described(*f);
  if (!is_drive_point(*f))
    out.doubts.push_back(
        say("the record, {} by {}, is no drive point: a tool cuts where it yields itself",
            document::text_of(f->response), document::text_of(f->reference)));
  return out;
}

}  // namespace turnwright::document
