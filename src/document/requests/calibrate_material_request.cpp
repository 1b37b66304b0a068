#include "calibrate_material_request.hpp"

#include <algorithm>
#include <set>

#include "base/say.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "document/catalogue/entries.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "turnwright/cutting/wear_curve.hpp"

namespace turnwright::document::material_calibration {
namespace {

using nlohmann::json;

constexpr std::size_t kMeasuredCuts = 2000, kWearPoints = 1000, kLabs = 12;
// Usual for turning with carbide (handbook values), where no material gives its own.
constexpr double kUsual_a = 0.35, kUsual_b = 0.15;

UsedTool read_tool_used(Reader r) {
  Bounds kapr = above_up_to(0, 120, "deg");
  UsedTool t{.name = r.text("name"),
             .re_mm = r.number("re_mm", within(0, 100, "mm")),
             .kapr_deg = r.number("kapr_deg", kapr),
             .rake_deg = r.number("rake_deg", within(-30, 45, "deg")),
             .wiper = r.boolean_or("wiper", false)};
  r.finish();
  return t;
}

// The index of a name in the list, at the end of which a new one is put.
std::size_t index_of(const std::string& name, std::vector<std::string>& names) {
  const auto at = std::ranges::find(names, name);
  const auto i = static_cast<std::size_t>(at - names.begin());
  if (at == names.end()) names.push_back(name);
  return i;
}

std::optional<Life> read_wear(Reader& r, double criterion_mm) {
  std::vector<cutting::WearPoint> curve;
  bool good = true;
  const auto points = r.optional_items("wear", 1, kWearPoints);
  for (const Reader& point : points) {
    const auto pair = point.as_items(2, 2);
    if (pair.size() != 2) {
      good = false;
      continue;
    }
    const cutting::WearPoint p{pair[0].as_number(above_up_to(0, 1e6, "min")),
                               pair[1].as_number(within(0, 10, "mm"))};
    if (!curve.empty() && p.t_min <= curve.back().t_min) {
      pair[0].problem(
          say("a time after the one before, {} min", number_text(curve.back().t_min)),
          "range");
      good = false;
    }
    good = good && p.t_min > 0 && p.VB_mm >= 0;
    curve.push_back(p);
  }
  if (curve.empty() || !good || !(criterion_mm > 0)) return std::nullopt;
  const auto life = cutting::life_of_curve(curve, criterion_mm);
  return Life{.T_min = life.T_min, .longer = life.longer, .from_wear = true};
}

std::optional<Life> read_life(Reader& r, double criterion_mm) {
  const Bounds life = above_up_to(0, 1e6, "min");
  const auto T = r.optional_number("T_min", life),
             more = r.optional_number("T_longer_than_min", life);
  const auto wear = read_wear(r, criterion_mm);
  if (r.has("T_min") + r.has("T_longer_than_min") + r.has("wear") > 1)
    r.problem_at(r.has("wear") ? "wear" : "T_longer_than_min",
                 tr("one life: T_min, T_longer_than_min or wear"), "conflict");
  if (T) return Life{.T_min = *T};
  if (more) return Life{.T_min = *more, .longer = true};
  return wear;
}

MeasuredCut read_cut(Reader r, double criterion_mm, Request& q) {
  r = r.as_object();
  MeasuredCut c{.vc_m_min = r.number("vc_m_min", above_up_to(0, 5000, "m/min")),
                .f_mm_rev = r.number("f_mm_rev", above_up_to(0, 5, "mm/rev")),
                .ap_mm = r.number("ap_mm", above_up_to(0, 50, "mm")),
                .F_N = {},
                .life = {},
                .Ra_um = {},
                .Rz_um = {},
                .edge = {},
                .replica = {}};
  for (std::size_t k = 0; k < kComponents.size(); ++k)
    c.F_N[k] = r.optional_number(kComponents[k].column, above_up_to(0, 1e6, "N"));
  c.life = read_life(r, criterion_mm);
  c.Ra_um = r.optional_number("Ra_um", above_up_to(0, 1000, "um"));
  c.Rz_um = r.optional_number("Rz_um", above_up_to(0, 1000, "um"));
  c.edge = r.optional_text("edge");
  if (const auto lab = r.optional_text("lab")) c.lab = index_of(*lab, q.labs);
  if (const auto run = r.optional_text("replica")) c.replica = index_of(*run, q.replicas);
  if (!c.has_force() && !c.has_roughness() && !r.has("T_min") &&
      !r.has("T_longer_than_min") && !r.has("wear"))
    r.problem(
        tr("a measured Fc_N, Ff_N, Fp_N, T_min, T_longer_than_min, wear, Ra_um or Rz_um"),
        "missing");
  r.finish();
  return c;
}

// Each cut has a lab or none has; an edge has one life.
void check_names(const Reader& cut, const MeasuredCut& c, const Request& q,
                 std::set<std::string>& edges) {
  if (!q.labs.empty() && cut.is_object() && !cut.json().contains("lab"))
    cut.problem(tr("a lab, as other cuts have"), "missing");
  if (c.edge && c.life && !edges.insert(*c.edge).second)
    cut.problem(say("edge \"{}\"", *c.edge), tr("an edge without a life yet"),
                "conflict");
}

std::vector<Reader> cuts_of(Reader& r, Request& q, std::vector<CsvRow>& rows) {
  const bool csv = r.has("csv");
  if (csv && r.has("cuts")) {
    r.problem_at("csv", tr("either cuts or csv"), "conflict");
    return {};
  }
  q.cuts_pointer = csv ? "/csv" : "/cuts";
  if (!csv) return r.items("cuts", 1, kMeasuredCuts);
  const auto optional = [](const char* name, bool text = false) {
    return CsvColumn{.name = name, .required = false, .text = text};
  };
  rows = csv_rows(r.at("csv"),
                  {{.name = "vc_m_min"},
                   {.name = "f_mm_rev"},
                   {.name = "ap_mm"},
                   optional("Fc_N"),
                   optional("Ff_N"),
                   optional("Fp_N"),
                   optional("T_min"),
                   optional("T_longer_than_min"),
                   optional("Ra_um"),
                   optional("Rz_um"),
                   optional("edge", true),
                   optional("lab", true),
                   optional("replica", true)},
                  OtherColumns::refused, kMeasuredCuts);
  std::vector<Reader> all;
  for (const CsvRow& row : rows) all.emplace_back(row.value, r.problems(), row.pointer);
  return all;
}

void read_cuts(Reader& r, Request& q) {
  const double criterion_mm = r.number_or("wear_land_mm", above_up_to(0, 5, "mm"), 0.3);
  std::vector<CsvRow> rows;
  const auto cuts = cuts_of(r, q, rows);
  for (const Reader& cut : cuts) q.cuts.push_back(read_cut(cut, criterion_mm, q));
  std::set<std::string> edges;
  for (std::size_t i = 0; i < cuts.size(); ++i) check_names(cuts[i], q.cuts[i], q, edges);
  if (q.labs.size() > kLabs)
    r.problem_at(r.has("csv") ? "csv" : "cuts", say("{} labs at most", kLabs), "range");
}

void read_base(Reader& r, const Catalogue& catalogue, Request& q) {
  const auto value = r.find("material");
  if (!value) return;
  if (value->is_object()) {
    q.material = value->json();
  } else {
    const auto named = material_of(catalogue, *value);
    const auto found = catalogue.material_documents.find(named.id);
    if (found == catalogue.material_documents.end()) return;
    q.material = found->second;
  }
  const catalogue::Material base =
      read_material(Reader(*q.material, r.problems(), value->pointer()));
  q.given_a = base.taylor.a;
  q.given_b = base.taylor.b;
  q.base = base;
}

}  // namespace

bool MeasuredCut::has_force() const {
  return std::ranges::any_of(F_N, [](const auto& F) { return F.has_value(); });
}

Request read(const json& document, const Catalogue& catalogue) {
  Problems problems{.document = "calibrate-material"};
  Reader r = Reader(document, problems).as_object();
  Request q;
  q.given_a = kUsual_a;
  q.given_b = kUsual_b;
  read_format(r, "turnwright-calibrate-material/1");
  read_base(r, catalogue, q);
  if (r.has("id")) q.id = read_id(r);
  q.name = r.optional_text("name");
  q.source = r.text_or("source", tr("measured cuts of the own shop"), 1000);
  Reader tool_used = r.object("tool");
  q.tool = read_tool_used(tool_used);
  Bounds confidence = within(0.5, 0.999);
  q.options.confidence = r.number_or("confidence", confidence, q.options.confidence);
  q.options.outlier_p = r.number_or("outlier_p", within(0, 0.5), q.options.outlier_p);
  read_cuts(r, q);
  if (q.tool.re_mm == 0 && std::ranges::any_of(q.cuts, &MeasuredCut::has_roughness))
    tool_used.problem_at("re_mm", tr("a corner radius, which the roughness depends on"),
                         "conflict");
  r.finish();
  problems.throw_if_any();

  catalogue::Tool tool;
  tool.re_mm = q.tool.re_mm;
  tool.kapr_deg = q.tool.kapr_deg;
  tool.gamma_deg = q.tool.rake_deg;
  tool.wiper = q.tool.wiper;
  q.edge = cutting::cut_of(q.base.value_or(catalogue::Material{}), tool);
  for (MeasuredCut& c : q.cuts) {
    c.b_mm = cutting::engaged_edge_mm(q.edge, c.ap_mm, c.f_mm_rev);
    c.h_mm = c.ap_mm * c.f_mm_rev / c.b_mm;
  }
  return q;
}

}  // namespace turnwright::document::material_calibration
