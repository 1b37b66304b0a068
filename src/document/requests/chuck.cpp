#include "turnwright/document/chuck.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "document/part/shaft_fields.hpp"
#include "turnwright/deflection/chuck_identification.hpp"
#include "turnwright/deflection/deviation_graph.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::deflection;
using nlohmann::json;

constexpr std::size_t kTests = 2000, kGraphPoints = 2000;
const Bounds kTestPlace = within(0, 1e6, "mm"), kDiameter = above_up_to(0, 1e5, "mm"),
             kTestForce = within(-1e6, 1e6, "N"), kError = within(-1000, 1000, "mm"),
             kArm = above_up_to(0, 1e6, "mm"), kTool = within(-1, 1, "mm/N");

/// Above this a standard error of the predicted deflection causes a warning.
constexpr double kCoarse = 0.09;
/// Above this the excess of the elastic fit is not due to chance: three standard
/// deviations, squared.
constexpr double kContradiction = 9;

struct Graph {
  std::vector<double> z_mm, e_mm;
  GraphOptions options;
};

struct ChuckRequest {
  std::vector<TestCut> cuts;
  bool measured = false;
  std::string cuts_pointer;
  std::vector<TestCut> predict;
  std::optional<double> Lc_mm;
  std::optional<double> tool_rr_mm_N;
  double tool_rt_mm_N = 0;
  std::optional<Graph> graph;
};

Load read_test_load(Reader& r) {
  return {.Fr_N = r.number("Fr_N", kTestForce),
          .Ft_N = r.number("Ft_N", kTestForce),
          .Fa_N = r.number("Fa_N", kTestForce)};
}

/// Members that a cut and a prediction have in common.
TestCut read_place(Reader& r, const Bounds& places) {
  TestCut cut;
  cut.z_mm = r.number("z_mm", places);
  cut.D_mm = r.number("D_mm", kDiameter);
  cut.load = read_test_load(r);
  return cut;
}

/// A cut and whether its radius error is given.
std::pair<TestCut, bool> read_cut(Reader r, const Bounds& places) {
  r = r.as_object();
  std::string setup = r.text("setup", 64);
  TestCut cut = read_place(r, places);
  cut.setup = std::move(setup);
  const auto error = r.optional_number("radius_error_mm", kError);
  cut.radius_error_mm = error.value_or(0);
  cut.delta_t_mm = r.optional_number("delta_t_mm", kError);
  r.finish();
  return {std::move(cut), error.has_value()};
}

void read_cuts(Reader& r, const Bounds& places, ChuckRequest& q) {
  const bool csv = r.has("csv");
  if (csv && r.has("tests")) {
    r.problem_at("csv", tr("either tests or csv"), "conflict");
    return;
  }
  q.cuts_pointer = csv ? "/csv" : "/tests";
  std::vector<CsvRow> rows;  // outlives its readers
  std::vector<Reader> items;
  if (csv) {
    rows = csv_rows(r.at("csv"),
                    {{.name = "setup", .text = true},
                     {.name = "z_mm"},
                     {.name = "D_mm"},
                     {.name = "Fr_N"},
                     {.name = "Ft_N"},
                     {.name = "Fa_N"},
                     {.name = "radius_error_mm", .required = false},
                     {.name = "delta_t_mm", .required = false}},
                    OtherColumns::refused, kTests);
    for (const CsvRow& row : rows)
      items.emplace_back(row.value, r.problems(), row.pointer);
  } else {
    items = r.items("tests", 1, kTests);
  }
  std::vector<std::string> without;
  for (const Reader& item : items) {
    auto [cut, measured] = read_cut(item, places);
    if (!measured) without.push_back(item.pointer());
    q.cuts.push_back(std::move(cut));
  }
  q.measured = without.empty();
  if (!without.empty() && without.size() < items.size())
    for (const std::string& pointer : without)
      r.problems().add({pointer + "/radius_error_mm", tr("nothing"),
                        tr("an error for every cut, or for none to plan them"),
                        "missing"});
}

Graph read_graph(Reader r) {
  Graph g{.z_mm = r.numbers("z_mm", within(-1e6, 1e6, "mm"), 3, kGraphPoints),
          .e_mm = r.numbers("e_mm", kError, 3, kGraphPoints),
          .options = {}};
  g.options.max_degree =
      static_cast<int>(r.integer_or("max_degree", 0, 6, g.options.max_degree));
  g.options.max_steps =
      static_cast<int>(r.integer_or("max_steps", 0, 10, g.options.max_steps));
  r.finish();
  if (g.z_mm.empty() || g.e_mm.empty()) return g;
  if (g.z_mm.size() != g.e_mm.size())
    r.problem_at("e_mm", tr("as many errors as z_mm has values"), "count");
  const std::size_t least = static_cast<std::size_t>(g.options.max_degree) + 3;
  if (std::set<double>(g.z_mm.begin(), g.z_mm.end()).size() < least)
    r.problem_at("z_mm", say("at least max_degree + 3 = {} different places", least),
                 "range");
  return g;
}

ChuckRequest read_chuck_request(const json& document, Problems& problems) {
  Reader r = Reader(document, problems).as_object();
  ChuckRequest q;
  read_format(r, "turnwright-chuck/1");
  const std::size_t before = problems.list.size();
  std::optional<part::Shaft> shaft;
  if (auto s = r.optional_object("shaft")) shaft = read_shaft(*s);
  const bool whole = shaft && problems.list.size() == before;
  const Bounds places =
      whole ? within(0, part::length_mm(shaft->segments), "mm") : kTestPlace;

  if (r.has("tests") || r.has("csv") || !r.has("graph")) read_cuts(r, places, q);
  for (Reader item : r.optional_items("predict", 0, kTests)) {
    item = item.as_object();
    q.predict.push_back(read_place(item, kTestPlace));
    item.finish();
  }
  q.Lc_mm = r.optional_number("Lc_mm", kArm);
  q.tool_rr_mm_N = r.optional_number("tool_rr_mm_N", kTool);
  q.tool_rt_mm_N = r.number_or("tool_rt_mm_N", kTool, 0);
  if (auto g = r.optional_object("graph")) q.graph = read_graph(*g);
  r.finish();

  if (whole && problems.list.empty()) {
    const Beam part(*shaft);
    for (TestCut& cut : q.cuts) cut.part = part.at(cut.z_mm, {});
  }
  for (TestCut& cut : q.cuts)
    cut.tool_mm =
        q.tool_rr_mm_N.value_or(0) * cut.load.Fr_N + q.tool_rt_mm_N * cut.load.Ft_N;
  return q;
}

/// The cuts of one plane, their identifiability and, if they are measured, their fit.
struct PlaneAnswer {
  Plane plane = Plane::radial;
  std::vector<PlaneTest> tests;
  std::vector<std::size_t> cuts;  // which cut each test is
  Identifiability can;
  std::optional<PlaneFit> fit;

  std::string name() const { return plane == Plane::radial ? "radial" : "tangential"; }
};

std::string joined(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

/// The fit of a plane, or a problem with the missing cuts.
PlaneAnswer answer(PlaneAnswer out, const ChuckRequest& q, Problems& problems) {
  for (const PlaneTest& t : out.tests)
    if (!std::isfinite(t.y_mm))
      throw ModelRangeError(
          tr("chuck: the computed deflection of the shaft is not a finite number; check "
             "its dimensions and the forces"));
  out.can = identifiability(out.tests, out.plane);
  if (!q.measured) return out;
  const auto refuse = [&](const std::string& got, std::string expected) {
    problems.add({q.cuts_pointer,
                  say("{} {} cuts that {}", out.tests.size(), out.name(), got),
                  std::move(expected), "identifiability"});
  };
  if (out.can.rank < 3) {
    std::vector<std::string> open, missing;
    for (const auto& n : out.can.null_directions) open.push_back(words(n));
    for (const auto& m : out.can.missing) missing.push_back(words(m));
    refuse(say("cannot tell {}", joined(open, "; ")), joined(missing, tr(" and ")));
  } else if (out.can.degrees_of_freedom < 1) {
    const auto n = static_cast<long>(out.tests.size());
    refuse(tr("leave no error to judge by"),
           say("at least {} cuts", n + 1 - out.can.degrees_of_freedom));
  } else {
    out.fit = identify(out.tests, out.plane);
  }
  return out;
}

json root(const Root& s) {
  return {{"c0_mm_N", s.c0_mm_N}, {"c1_rad_N", s.c1_rad_N}, {"c2_rad_Nmm", s.c2_rad_Nmm}};
}

json described(const Identifiability& can) {
  json null = json::array(), missing = json::array();
  for (const NullDirection& n : can.null_directions)
    null.push_back({{"c0", n.weight[0]},
                    {"c1_z", n.weight[1]},
                    {"c2_zz", n.weight[2]},
                    {"moves_offsets", n.moves_offsets},
                    {"words", words(n)}});
  for (const MissingTest& m : can.missing) missing.push_back(words(m));
  json out{{"rank", can.rank},
           {"degrees_of_freedom", can.degrees_of_freedom},
           {"null_directions", std::move(null)},
           {"missing", std::move(missing)},
           {"setups_of_one_force", can.one_force}};
  if (can.rank == 3) {
    out["condition"] = can.condition;
    out["largest_u_per_s"] = can.largest_u;
    out["most_useful"] = words(can.most_useful);
  }
  return out;
}

/// The view by three springs; a rigid one is null.
std::optional<json> described_springs(const PlaneFit& fit, std::optional<double> Lc_mm) {
  const Root& s = fit.root;
  const auto range = arms(s);
  if (!range) return std::nullopt;
  const auto k = springs(s, Lc_mm.value_or(std::sqrt(s.c0_mm_N / s.c2_rad_Nmm)));
  if (!k) return std::nullopt;
  const Springs u = spring_errors(fit, k->Lc_mm);
  json out{{"Lc_range_mm", {range->least_mm, range->largest_mm}}, {"Lc_mm", k->Lc_mm}};
  const auto add = [&out](const std::string& key, double per_k, double u_per_k) {
    const bool rigid = !(per_k > 0);
    out[key] = rigid ? json() : json(1 / per_k);
    out["u_" + key] = rigid ? json() : json(u_per_k / (per_k * per_k));
  };
  add("k1_N_mm", k->per_k1_mm_N, u.per_k1_mm_N);
  add("k2_Nmm_rad", k->per_k2_rad_Nmm, u.per_k2_rad_Nmm);
  add("k3_Nmm_rad", k->per_k3_rad_Nmm, u.per_k3_rad_Nmm);
  return out;
}

json described(const PlaneAnswer& a, std::optional<double> Lc_mm) {
  const PlaneFit& fit = *a.fit;
  json offsets = json::array();
  for (const auto& o : fit.offsets)
    offsets.push_back({{"setup", o.setup}, {"offset_mm", o.mm}, {"u_mm", o.u_mm}});
  json outliers = json::array();
  for (const std::size_t i : fit.outliers) outliers.push_back(a.cuts[i]);
  const auto u = [&fit](std::size_t j) { return std::sqrt(fit.covariance[j][j]); };
  json out{{"u", {{"c0_mm_N", u(0)}, {"c1_rad_N", u(1)}, {"c2_rad_Nmm", u(2)}}},
           {"covariance", fit.covariance},
           {"offsets", std::move(offsets)},
           {"outliers", std::move(outliers)},
           {"s_mm", fit.s_mm},
           {"degrees_of_freedom", fit.degrees_of_freedom},
           {"on_border", fit.on_border}};
  if (fit.on_border) {
    out["unconstrained"] = root(fit.unconstrained);
    out["contradiction"] = fit.contradiction;
  }
  if (auto view = described_springs(fit, Lc_mm)) out["springs"] = std::move(*view);
  return out;
}

std::string percent_text(double x) {
  return number_text(std::round(1000 * x) / 10) + " %";
}

void warn(const PlaneAnswer& a, const ChuckRequest& q, json& warnings) {
  const auto remark = [&](const std::string& text) {
    warnings.push_back(a.name() + ": " + text);
  };
  for (const std::string& setup : a.can.one_force)
    remark(say("setup {} has one force, so its cuts say nothing of c0", setup));
  if (!a.fit) return;
  const PlaneFit& fit = *a.fit;
  if (fit.contradiction > kContradiction)
    remark(
        say("the cuts contradict every elastic chuck by {} standard deviations; look for "
            "drift, wrong forces or a part that gave way",
            number_text(std::round(10 * std::sqrt(fit.contradiction)) / 10)));
  else if (fit.on_border)
    remark(tr(
        "the best elastic chuck has c1^2 = c0 c2; the cuts do not tell the three apart"));
  double coarsest = 0;
  for (const PlaneTest& t : a.tests) {
    const Estimate e = predicted_deflection(fit, t.z_mm, t.F_N, t.C_Nmm);
    if (e.u > 0) coarsest = std::max(coarsest, e.u / std::max(std::abs(e.value), 1e-9));
  }
  if (coarsest > kCoarse)
    remark(
        say("predicted deflections at the cuts have standard errors up to {}; most "
            "useful next: {}",
            percent_text(coarsest), words(a.can.most_useful)));
  if (q.Lc_mm && !springs(fit.root, *q.Lc_mm))
    remark(tr("no three springs with this Lc_mm give this compliance"));
}

json estimates(const PlaneFit& radial, const PlaneFit* tangential, const TestCut& at) {
  const Estimate r =
      predicted_deflection(radial, at.z_mm, at.load.Fr_N, -at.load.Fa_N * at.D_mm / 2);
  const Estimate e =
      predicted_radius_error(radial, tangential, at.z_mm, at.D_mm, at.load);
  json out{
      {"z_mm", at.z_mm},     {"Fr_N", at.load.Fr_N},       {"delta_r_mm", r.value},
      {"u_delta_r_mm", r.u}, {"radius_error_mm", e.value}, {"u_radius_error_mm", e.u}};
  if (tangential) {
    const Estimate t = predicted_deflection(*tangential, at.z_mm, at.load.Ft_N, 0);
    out["delta_t_mm"] = t.value;
    out["u_delta_t_mm"] = t.u;
  }
  return out;
}

json described(const Graph& q) {
  const DeviationGraph g = deviation_graph(q.z_mm, q.e_mm, q.options);
  json steps = json::array(), corrected = json::array();
  for (const CarriageStep& s : g.steps)
    steps.push_back({{"after_mm", s.after_mm},
                     {"before_mm", s.before_mm},
                     {"height_mm", s.height_mm},
                     {"u_mm", s.u_mm},
                     {"p", s.p}});
  for (std::size_t i = 0; i < q.z_mm.size(); ++i) {
    double e = q.e_mm[i];
    for (const CarriageStep& s : g.steps)
      if (q.z_mm[i] > s.after_mm) e -= s.height_mm;
    corrected.push_back(e);
  }
  return {{"coefficients", g.coefficients},
          {"u_coefficients", g.u_coefficients},
          {"steps", std::move(steps)},
          {"corrected_mm", std::move(corrected)},
          {"r2", g.r2},
          {"r2_as_measured", g.r2_as_measured},
          {"s_mm", g.s_mm},
          {"degrees_of_freedom", g.degrees_of_freedom}};
}

void add_fits(json& result, const ChuckRequest& q, const PlaneAnswer& radial,
              const std::optional<PlaneAnswer>& tangential) {
  const PlaneFit& fit = *radial.fit;
  const PlaneFit* across = tangential ? &*tangential->fit : nullptr;
  result["chuck"] = {{"radial", root(fit.root)}};
  result["radial"] = described(radial, q.Lc_mm);
  if (across) {
    result["chuck"]["tangential"] = root(across->root);
    result["tangential"] = described(*tangential, q.Lc_mm);
  }
  json tests = json::array(), predictions = json::array();
  for (std::size_t i = 0; i < q.cuts.size(); ++i) {
    json test = estimates(fit, across, q.cuts[i]);
    test["residual_mm"] = fit.residual_mm[i];
    test["outlier"] = std::ranges::binary_search(fit.outliers, i);
    tests.push_back(std::move(test));
  }
  for (const TestCut& at : q.predict) predictions.push_back(estimates(fit, across, at));
  result["tests"] = std::move(tests);
  result["predictions"] = std::move(predictions);
}

/// The identifiability of the cuts and, if they are measured, the fit.
void add_chuck(json& result, const ChuckRequest& q, Problems& problems) {
  PlaneAnswer across{Plane::tangential, {}, {}, {}, {}};
  for (std::size_t i = 0; i < q.cuts.size(); ++i)
    if (q.cuts[i].delta_t_mm) {
      across.tests.push_back(tangential_test(q.cuts[i]));
      across.cuts.push_back(i);
    }
  std::optional<PlaneAnswer> tangential;
  if (!across.tests.empty()) tangential = answer(std::move(across), q, problems);
  const Root known = tangential && tangential->fit ? tangential->fit->root : Root{};
  PlaneAnswer along{Plane::radial, {}, {}, {}, {}};
  for (std::size_t i = 0; i < q.cuts.size(); ++i) {
    along.tests.push_back(radial_test(q.cuts[i], known));
    along.cuts.push_back(i);
  }
  const PlaneAnswer radial = answer(std::move(along), q, problems);
  problems.throw_if_any();

  result["identifiability"] = {{"radial", described(radial.can)}};
  if (tangential) result["identifiability"]["tangential"] = described(tangential->can);
  if (q.measured) add_fits(result, q, radial, tangential);
  warn(radial, q, result["warnings"]);
  if (tangential) warn(*tangential, q, result["warnings"]);
  if (q.measured && !q.tool_rr_mm_N)
    result["warnings"].push_back(
        tr("tool_rr_mm_N is not given: c0 holds the compliance of tool and slide too"));
}

}  // namespace

json chuck(const json& request) {
  Problems problems{.document = "chuck"};
  const ChuckRequest q = read_chuck_request(request, problems);
  problems.throw_if_any();
  json result{{"format", "turnwright-chuck-result/1"}, {"warnings", json::array()}};
  if (!q.cuts.empty()) add_chuck(result, q, problems);
  if (q.graph) result["graph"] = described(*q.graph);
  return result;
}

}  // namespace turnwright::document
