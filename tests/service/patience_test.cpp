// The dearest documents that were found for each capability: what is not refused before it
// is begun hears at once that nobody waits any more.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "service/requests.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service::patience_test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const Request& row(const std::string& name) {
  for (const auto& one : requests())
    if (one.name == name) return one;
  throw std::domain_error("no row " + name);
}

/// How long the work goes on after a stop half a second from its begin; none if it ended
/// before.
std::optional<std::chrono::duration<double>> heard_after(const std::string& name,
                                                         const json& document) {
  static const auto kCatalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  std::stop_source stop;
  std::chrono::steady_clock::time_point asked;
  const std::jthread nobody_waits([&](const std::stop_token&) {
    std::this_thread::sleep_for(500ms);
    asked = std::chrono::steady_clock::now();
    stop.request_stop();
  });
  try {
    answer(row(name), document, {kCatalogue, stop.get_token()});
  } catch (const Cancelled&) {
    return std::chrono::steady_clock::now() - asked;
  }
  return std::nullopt;
}

json milling(int modes, const json& more) {
  json q = json::parse(R"({"model": "milling", "teeth": 3, "Kt_MPa": 700, "Kn_MPa": 250,
    "direction": "up", "radial_immersion": 0.4, "ap_max_mm": 4})");
  for (int i = 0; i < modes; ++i)
    q["modes"].push_back({{"axis", i % 2 == 0 ? "x" : "y"},
                          {"frequency_Hz", 900 + 40 * i},
                          {"damping_ratio", 0.02},
                          {"stiffness_N_mm", 9000}});
  q.update(more);
  return q;
}

json many_draws() {
  json budget{{"draws", 10'000'000}};
  for (int i = 0; i < 90; ++i)
    budget["sources"].push_back(
        {{"name", "a"}, {"distribution", "normal"}, {"value_um", 1}});
  return {{"cases",
           {{{"tolerance", "flatness"},
             {"e_mm", {0}},
             {"value_mm", 1},
             {"budget", budget}}}}};
}

/// Circles of `radius_mm`, which are cut to 1e-6 mm.
json circles(int count, int radius_mm) {
  json q{{"chain", "wXYfZt"},
         {"axes",
          {{{"name", "X"}, {"err", {{"EXX", {{"c", {0, 0.003, 0, 0}}}}}}},
           {{"name", "Y"}},
           {{"name", "Z"}}}},
         {"tolerance_mm", 1e-6},
         {"program", {"G17 G1 X0 Y0 F100"}}};
  for (int i = 0; i < count; ++i)
    q["program"].push_back("G2 I" + std::to_string(radius_mm));
  return q;
}

json drifts(int rows) {
  json q{{"model", {{"lags", 2}, {"start", "soaked"}}}};
  q["log"]["csv"] = {"time_s,rpm,ambient_degC,error_um"};
  for (int i = 0; i < rows; ++i)
    q["log"]["csv"].push_back(std::to_string(60 * i) + ',' +
                              std::to_string(i / 20 % 2 * 3000) + ",22," +
                              std::to_string(i % 37));
  return q;
}

json part() {
  std::ifstream file(TURNWRIGHT_SOURCE_DIR "/parts/gearbox-input-shaft.json");
  json all = json::parse(file);
  all["pareto"] = 12;
  return all;
}

// A second of a machine that does nothing else; under a sanitizer everything takes longer.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr double kHeard_s = 60;
#else
constexpr double kHeard_s = 3;
#endif

TEST(Patience, LongWorkHearsThatNobodyWaits) {
  const std::vector<std::pair<std::string, json>> dear = {
      {"acceptance", many_draws()},
      {"compensate", circles(700, 20'000)},
      {"stability", milling(1, {{"method", "simulation"}, {"speeds_rpm", {200}}})},
      {"stability",
       milling(5, {{"method", "tfea"}, {"elements", 59}, {"speeds_rpm", {1000}}})},
      {"stability", milling(20, {{"method", "semi-discretisation"},
                                 {"intervals", 200},
                                 {"speeds_rpm", {1000}}})},
      {"stability",
       milling(20, {{"speeds_rpm", {{"from", 300}, {"to", 400}, {"count", 1000}}}})},
      {"thermal", drifts(50'000)},
      {"plan", part()}};
  // On a busy machine a bound on the work may be met before anybody leaves.
  const auto heard_of = [](const std::string& name, const json& document) {
    try {
      return heard_after(name, document);
    } catch (const InputError&) {
      return decltype(heard_after(name, document))();
    }
  };
  for (const auto& [name, document] : dear) {
    const auto heard = heard_of(name, document);
    EXPECT_LT(heard.value_or(std::chrono::seconds(0)).count(), kHeard_s)
        << name << ' ' << document.dump().substr(0, 300);
  }
}

TEST(Patience, WorkWithoutEndIsRefusedBeforeItIsBegun) {
  const auto refused = [](const std::string& name, const json& document) -> std::string {
    try {
      heard_after(name, document);
    } catch (const InputError& error) {
      return error.problems().at(0).pointer;
    }
    return "nothing";
  };
  json draws = many_draws();
  draws["cases"].push_back(draws["cases"][0]);
  EXPECT_EQ(refused("acceptance", draws), "/cases");
  for (const double n_rpm : {1.0, 20.0})
    EXPECT_EQ(refused("stability",
                      milling(1, {{"method", "simulation"}, {"speeds_rpm", {n_rpm}}})),
              "/method");
  EXPECT_EQ(
      refused(
          "stability",
          milling(20, {{"method", "tfea"}, {"elements", 60}, {"speeds_rpm", {1000}}})),
      "/elements");
  EXPECT_EQ(
      refused("stability",
              milling(2, {{"method", "tfea"},
                          {"elements", 60},
                          {"speeds_rpm", {{"from", 100}, {"to", 200}, {"count", 200}}}})),
      "/method");
  EXPECT_EQ(refused("compensate", circles(1, 90'000)), "/program#line 2");
}

}  // namespace
}  // namespace turnwright::service::patience_test
