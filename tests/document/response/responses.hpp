#pragma once
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../schema_check.hpp"
#include "../slips.hpp"
#include "../test_catalogue.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/stability.hpp"

/// Responses of known modes through the door `stability`.
namespace turnwright::document::responses {

using nlohmann::json;
using Complex = std::complex<double>;

struct True {
  double f_Hz, zeta, k_N_mm;
};

/// H = sum 1/k / (1 - x^2 + 2 i zeta x), x = f/f_r, times (2 pi i f)^d [mm/(s^d N)].
inline Complex response_of(const std::vector<True>& modes, double f_Hz,
                           int derivative = 0) {
  Complex H = 0;
  for (const True& m : modes) {
    const double x = f_Hz / m.f_Hz;
    H += 1 / m.k_N_mm / Complex(1 - x * x, 2 * m.zeta * x);
  }
  return H * std::pow(Complex(0, 2 * M_PI * f_Hz), derivative);
}

/// A turned cut whose only mode data are `frf`.
inline json request(json frf) {
  return {{"model", "turning"}, {"kappa_deg", 75},
          {"kp_MPa", 900},      {"frf", json::array({std::move(frf)})},
          {"ap_max_mm", 1},     {"points", {{{"n_rpm", 900}, {"ap_mm", 0.01}}}}};
}

inline json answer(const json& asked) {
  static const SchemaCheck kAsked("stability.request.json"),
      kAnswered("stability.result.json");
  EXPECT_EQ(kAsked.fault(asked), "");
  json out = stability(asked, test_catalogue());
  EXPECT_EQ(kAnswered.fault(out), "");
  return out;
}

/// What the door says of a response.
inline json told(const json& frf) { return answer(request(frf)).at("frf").at(0); }

inline std::string refused(const json& frf) {
  return input_refusal([](const json& q) { return stability(q, test_catalogue()); },
                       request(frf));
}

inline void expect_modes(const json& told, const std::vector<True>& truth,
                         double relative) {
  ASSERT_EQ(told["modes"].size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const json& m = told["modes"][i];
    EXPECT_NEAR(m["frequency_Hz"].get<double>() / truth[i].f_Hz, 1, relative);
    EXPECT_NEAR(m["damping_ratio"].get<double>() / truth[i].zeta, 1, relative);
    EXPECT_NEAR(m["stiffness_N_mm"].get<double>() / truth[i].k_N_mm, 1, relative);
  }
}

}  // namespace turnwright::document::responses
