#include "turnwright/document/thermal.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/thermal/batch.hpp"
#include "turnwright/thermal/lag_fit.hpp"
#include "turnwright/thermal/network.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::thermal;
using nlohmann::json;

constexpr std::size_t kLogRows = 50000, kParts = 10000;
const Bounds kTime = within(-1e9, 1e9, "s"), kSpan = above_up_to(0, 1e9, "s"),
             kLogSpeed = within(0, 1e6, "1/min"), kFeedRate = within(0, 1e6, "mm/min"),
             kAmbient = within(-100, 200, "degC"), kDrift = within(-1e6, 1e6, "um");

using Columns = std::map<std::string, std::vector<double>>;

const std::map<std::string, Bounds>& log_bounds() {
  static const std::map<std::string, Bounds> kAll{{"time_s", kTime},
                                                  {"rpm", kLogSpeed},
                                                  {"ambient_degC", kAmbient},
                                                  {"error_um", kDrift},
                                                  {"feed_mm_min", kFeedRate}};
  return kAll;
}

enum class OperationTime { since_start, since_speed_change };

struct NetworkRequest {
  NetworkOptions options;
  OperationTime time = OperationTime::since_start;
};

struct Shift {
  Inputs inputs;
  bool after_log = false;
  std::optional<Batch> batch;
};

struct ThermalRequest {
  DriftLog log;
  std::vector<double> feed_mm_min;
  std::size_t trained = 0;  // rows fitted, the first ones
  FitOptions options;
  std::optional<NetworkRequest> network;
  std::optional<Shift> shift;
};

Columns read_table(Reader& r, const std::vector<std::string>& required,
                   const std::vector<std::string>& optional) {
  Columns out;
  for (const auto& key : required)
    out[key] = r.numbers(key, log_bounds().at(key), 1, kLogRows);
  for (const auto& key : optional)
    if (r.has(key)) out[key] = r.numbers(key, log_bounds().at(key), 1, kLogRows);
  return out;
}

Columns read_csv_log(Reader& r) {
  std::map<std::string, std::string> names;  // of the columns
  for (const char* key : {"time_s", "rpm", "ambient_degC", "error_um"}) names[key] = key;
  if (auto given = r.optional_object("columns")) {
    for (const auto& [key, bounds] : log_bounds())
      if (const auto name = given->optional_text(key)) names[key] = *name;
    given->finish();
  }
  std::vector<CsvColumn> columns;
  for (const auto& [key, name] : names) columns.push_back({.name = name});
  Columns out;
  for (const CsvRow& row :
       csv_rows(r.at("csv"), columns, OtherColumns::ignored, kLogRows)) {
    Reader cells(row.value, r.problems(), row.pointer);
    for (const auto& [key, name] : names)
      out[key].push_back(cells.number(name, log_bounds().at(key)));
  }
  return out;
}

/// Checks that all columns have equally many rows, at rising times.
void check_rows(Reader& r, const Columns& columns) {
  const auto time = columns.find("time_s");
  if (time == columns.end()) return;
  const auto& t = time->second;
  for (const auto& [key, values] : columns)
    if (!values.empty() && !t.empty() && values.size() != t.size())
      r.problem_at(key, tr("as many values as time_s has"), "count");
  const auto falls =
      std::ranges::adjacent_find(t, [](double a, double b) { return a >= b; });
  if (falls != t.end())
    r.problem(say("time_s {} before {}", number_text(*falls), number_text(falls[1])),
              tr("times that rise"), "order");
}

Inputs inputs_of(Columns& c) {
  return {std::move(c["time_s"]), std::move(c["rpm"]), std::move(c["ambient_degC"])};
}

void read_log(Reader r, ThermalRequest& q) {
  r = r.as_object();
  Columns columns =
      r.has("csv")
          ? read_csv_log(r)
          : read_table(r, {"time_s", "rpm", "ambient_degC", "error_um"}, {"feed_mm_min"});
  r.finish();
  check_rows(r, columns);
  q.feed_mm_min = std::move(columns["feed_mm_min"]);
  q.log.error_um = std::move(columns["error_um"]);
  q.log.inputs = inputs_of(columns);
}

FitOptions read_model(Reader r) {
  FitOptions o;
  o.lags = static_cast<int>(r.integer_or("lags", 1, 2, 0));
  o.T0_degC = r.number_or("T0_degC", kAmbient, o.T0_degC);
  o.soaked_start =
      r.choice_or<bool>("start", {{"fitted", false}, {"soaked", true}}, false);
  o.n_max_rpm = r.optional_number("n_max_rpm", above_up_to(0, 1e6, "1/min"));
  o.p = r.optional_number("p", above_up_to(0, 10));
  o.tau_min_s = r.optional_number("tau_min_s", kSpan);
  o.tau_max_s = r.optional_number("tau_max_s", kSpan);
  o.tau_amb_max_s = r.optional_number("tau_amb_max_s", kSpan);
  r.finish();
  return o;
}

NetworkRequest read_network(Reader r) {
  NetworkRequest q;
  q.options.hidden = static_cast<std::size_t>(r.integer_or("hidden", 1, 20, 6));
  q.options.seed = static_cast<std::uint64_t>(r.integer("seed", 0, 2147483647));
  q.options.decay = r.number_or("decay", within(0, 1), q.options.decay);
  q.options.starts = static_cast<std::size_t>(r.integer_or("starts", 1, 20, 4));
  q.time = r.choice_or<OperationTime>(
      "operation_time",
      {{"since-start", OperationTime::since_start},
       {"since-speed-change", OperationTime::since_speed_change}},
      OperationTime::since_start);
  r.finish();
  return q;
}

std::optional<Batch> read_batch(Reader& shift, const Inputs& inputs) {
  auto r = shift.optional_object("batch");
  if (!r) return std::nullopt;
  const Batch batch{.first_s = r->number("first_s", kTime),
                    .cycle_s = r->number("cycle_s", kSpan),
                    .parts = static_cast<std::size_t>(r->integer("parts", 1, kParts)),
                    .offset_every = static_cast<std::size_t>(
                        r->integer_or("offset_every", 1, kParts, 0))};
  r->finish();
  if (inputs.time_s.empty()) return batch;
  const double last =
      batch.first_s + (static_cast<double>(batch.parts) - 1) * batch.cycle_s;
  if (batch.first_s < inputs.time_s.front())
    r->problem_at("first_s", tr("not before the shift's first time_s"), "conflict");
  if (last > inputs.time_s.back())
    r->problem_at("parts", tr("a last part not after the shift's last time_s"),
                  "conflict");
  return batch;
}

Shift read_shift(Reader r) {
  Shift shift;
  shift.after_log = r.choice<bool>("start", {{"cold", false}, {"after-log", true}});
  Columns columns = read_table(r, {"time_s", "rpm", "ambient_degC"}, {});
  check_rows(r, columns);
  shift.inputs = inputs_of(columns);
  shift.batch = read_batch(r, shift.inputs);
  r.finish();
  return shift;
}

ThermalRequest read_thermal_request(const json& document) {
  Problems problems{.document = "thermal"};
  Reader r = Reader(document, problems).as_object();
  ThermalRequest q;
  read_format(r, "turnwright-thermal/1");
  read_log(r.object("log"), q);
  const auto before = r.optional_number("train_before_s", kTime);
  if (auto model = r.optional_object("model")) q.options = read_model(*model);
  if (auto network = r.optional_object("network")) q.network = read_network(*network);
  if (auto shift = r.optional_object("shift")) q.shift = read_shift(*shift);
  r.finish();
  problems.throw_if_any();
  const auto& t = q.log.inputs.time_s;
  q.trained =
      static_cast<std::size_t>(before ? std::ranges::lower_bound(t, *before) - t.begin()
                                      : static_cast<std::ptrdiff_t>(t.size()));
  return q;
}

json model_json(const LagModel& m) {
  json lags = json::array();
  for (const Lag& lag : m.lags)
    lags.push_back({{"tau_s", lag.tau_s}, {"K_um", lag.K_um}});
  return {{"lags", lags},
          {"p", m.p},
          {"n_max_rpm", m.n_max_rpm},
          {"tau_amb_s", m.tau_amb_s},
          {"b_um_K", m.b_um_K},
          {"a_um", m.a_um},
          {"c_um", m.c_um},
          {"T0_degC", m.T0_degC}};
}

const char* word(Found found) {
  switch (found) {
    case Found::inside:
      return "inside";
    case Found::at_lower:
      return "at-lower-bound";
    case Found::at_upper:
      return "at-upper-bound";
    case Found::given:
      return "given";
    case Found::unknown:
      break;
  }
  return "unknown";
}

json parameters_json(const LagFit& fit) {
  json list = json::array();
  for (const Parameter& p : fit.parameters) {
    json one{{"name", p.name},
             {"value", p.value},
             {"found", word(p.found)},
             {"ill_determined", p.ill_determined}};
    if (p.found == Found::inside) one["u"] = p.u;
    list.push_back(std::move(one));
  }
  return list;
}

json choice_json(const Choice& choice, const FitOptions& options) {
  json out{{"lags", choice.fit.model.lags.size()},
           {"by", options.lags        ? "request"
                  : choice.one_lag_um ? "cross-validation"
                                      : "too-few-rows"}};
  if (choice.one_lag_um) {
    out["one_lag_um"] = *choice.one_lag_um;
    out["two_lags_um"] = *choice.two_lags_um;
  }
  return out;
}

/// Errors of predictions; without rows only their number.
json errors_json(std::span<const double> residual_um) {
  json out{{"rows", residual_um.size()}};
  if (residual_um.empty()) return out;
  double sum = 0, square = 0, most = 0;
  for (const double r : residual_um) {
    sum += r;
    square += r * r;
    most = std::max(most, std::abs(r));
  }
  const auto n = static_cast<double>(residual_um.size());
  out["rms_um"] = std::sqrt(square / n);
  out["mean_um"] = sum / n;
  out["largest_um"] = most;
  return out;
}

std::vector<double> difference(const std::vector<double>& a,
                               const std::vector<double>& b) {
  std::vector<double> out(a.size());
  std::ranges::transform(a, b, out.begin(), std::minus<>());
  return out;
}

std::vector<Row> network_rows(const ThermalRequest& q) {
  const Inputs& in = q.log.inputs;
  std::vector<Row> out;
  double since = in.time_s.front();
  for (std::size_t i = 0; i < in.time_s.size(); ++i) {
    if (q.network->time == OperationTime::since_speed_change && i > 0 &&
        in.rpm[i] != in.rpm[i - 1])
      since = in.time_s[i];
    out.push_back({in.rpm[i], q.feed_mm_min.empty() ? 0 : q.feed_mm_min[i],
                   in.time_s[i] - since, in.ambient_degC[i]});
  }
  return out;
}

json network_json(const ThermalRequest& q) {
  const auto rows = network_rows(q);
  const Network net =
      train(std::span(rows).first(q.trained), std::span(q.log.error_um).first(q.trained),
            q.network->options);
  std::vector<double> prediction, held, inside;
  std::size_t beyond = 0, between = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    prediction.push_back(drift_um(net, rows[i]));
    if (i < q.trained) continue;
    held.push_back(q.log.error_um[i] - prediction.back());
    switch (reach(net, rows[i])) {
      case Reach::inside:
        inside.push_back(held.back());
        break;
      case Reach::between_rows:
        ++between;
        break;
      case Reach::outside:
        ++beyond;
        break;
    }
  }
  return {{"rms_um", net.rms_um},
          {"held_out", errors_json(held)},
          {"held_out_inside", errors_json(inside)},
          {"extrapolated", {{"outside", beyond}, {"between_rows", between}}},
          {"prediction_um", prediction}};
}

json batch_json(const BatchDrift& d) {
  return {{"time_s", d.time_s},
          {"drift_um", d.drift_um},
          {"since_offset_um", d.since_offset_um},
          {"range_um", d.range_um},
          {"between_offsets_um", d.between_offsets_um},
          {"largest_step_um", d.largest_step_um}};
}

json shift_json(const ThermalRequest& q, const LagFit& fit) {
  const Shift& shift = *q.shift;
  LagFit used = fit;
  Inputs inputs = shift.inputs;
  std::size_t skip = 0;
  double clock = 0;  // of the model less that of the shift
  if (shift.after_log) {
    inputs = joined(q.log.inputs, shift.inputs);
    skip = q.log.inputs.time_s.size() - 1;
    clock = q.log.inputs.time_s.back() - shift.inputs.time_s.front();
  } else {
    used.model.a_um = 0;  // a cold start is a soaked one
  }
  const auto e = drift_um(used.model, inputs), u = drift_uncertainty_um(used, inputs);
  const auto part = [skip](const std::vector<double>& v) {
    return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(skip), v.end());
  };
  json out{{"time_s", shift.inputs.time_s}, {"drift_um", part(e)}, {"u_um", part(u)}};
  if (shift.batch) {
    Batch batch = *shift.batch;
    batch.first_s += clock;
    BatchDrift d = batch_drift(used.model, inputs, batch);
    for (double& t : d.time_s) t -= clock;
    out["batch"] = batch_json(d);
  }
  return out;
}

/// Warnings of rows outside the ranges of the first `trained` rows of the log.
void warn_of_range(const std::string& what, std::span<const double> seen,
                   std::span<const double> asked, const char* unit,
                   const std::string& where, json& warnings) {
  const auto [low, high] = std::ranges::minmax(seen);
  const double rounding = 1e-12 * std::max(std::abs(low), std::abs(high));
  const auto beyond = std::ranges::count_if(
      asked,
      [l = low - rounding, h = high + rounding](double x) { return x < l || x > h; });
  if (beyond > 0)
    warnings.push_back(say("{}: {} rows with {} outside the fitted {:.6g} to {:.6g} {}",
                           where, beyond, what, low, high, unit));
}

json warnings_json(const ThermalRequest& q, const LagFit& fit) {
  json out = json::array();
  for (const Parameter& p : fit.parameters) {
    if (p.found == Found::at_lower || p.found == Found::at_upper)
      out.push_back(p.found == Found::at_lower
                        ? say("{}: at its lower bound, {:.4g}", p.name, p.value)
                        : say("{}: at its upper bound, {:.4g}", p.name, p.value));
    else if (p.found == Found::unknown)
      out.push_back(say("{}: nothing in the log depends on it", p.name));
    else if (p.ill_determined)
      out.push_back(say("{}: ill-determined, standard uncertainty {:.3g} of {:.4g}",
                        p.name, p.u, p.value));
  }
  const Inputs& log = q.log.inputs;
  const auto check = [&](const Inputs& in, std::size_t from, const std::string& where) {
    warn_of_range(tr("speeds"), std::span(log.rpm).first(q.trained),
                  std::span(in.rpm).subspan(from), "1/min", where, out);
    warn_of_range(tr("ambients"), std::span(log.ambient_degC).first(q.trained),
                  std::span(in.ambient_degC).subspan(from), "degC", where, out);
  };
  check(log, q.trained, tr("held out"));
  if (q.shift) check(q.shift->inputs, 0, tr("shift"));
  return out;
}

}  // namespace

json thermal(const json& request) {
  const ThermalRequest q = read_thermal_request(request);
  const Choice choice = fit_lags(q.log, q.trained, q.options);
  const LagFit& fit = choice.fit;
  const auto e = drift_um(fit.model, q.log.inputs);
  const auto residual = difference(q.log.error_um, e);
  json result{{"model", model_json(fit.model)},
              {"parameters", parameters_json(fit)},
              {"choice", choice_json(choice, q.options)},
              {"fitted", errors_json(std::span(residual).first(q.trained))},
              {"autocorrelation", fit.autocorrelation},
              {"held_out", errors_json(std::span(residual).subspan(q.trained))},
              {"prediction_um", e},
              {"u_um", drift_uncertainty_um(fit, q.log.inputs)},
              {"residual_um", residual},
              {"warnings", warnings_json(q, fit)}};
  if (q.network) result["network"] = network_json(q);
  if (q.shift) result["shift"] = shift_json(q, fit);
  return result;
}

}  // namespace turnwright::document
