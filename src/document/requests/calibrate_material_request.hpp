#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/force_fit.hpp"
#include "turnwright/document/catalogue.hpp"

/// The request of the capability `calibrate-material`.
namespace turnwright::document::material_calibration {

/// A force component: its column, its error in `left_out`, its constants in the result
/// and in a material, a lab's factor on them.
struct Component {
  const char *column, *error, *group, *k11, *m, *factor;
};
constexpr std::array<Component, cutting::kComponents> kComponents{
    {{"Fc_N", "Fc_rms_pct", "cutting", "kc11_MPa", "mc", "kc11_factor"},
     {"Ff_N", "Ff_rms_pct", "feed", "kf11_MPa", "mf", "kf11_factor"},
     {"Fp_N", "Fp_rms_pct", "passive", "kp11_MPa", "mp", "kp11_factor"}}};
constexpr std::size_t kCutting = 0, kFeed = 1, kPassive = 2;

struct Life {
  double T_min = 0;
  bool longer = false;     ///< the edge was still good
  bool from_wear = false;  ///< where its wear curve reaches the criterion
};

struct MeasuredCut {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0;
  double h_mm = 0, b_mm = 0;
  std::array<std::optional<double>, cutting::kComponents> F_N;
  std::optional<Life> life;
  std::optional<double> Ra_um, Rz_um;
  std::optional<std::string> edge;
  std::size_t lab = 0;                 ///< in Request::labs, if it has any
  std::optional<std::size_t> replica;  ///< in Request::replicas
  bool has_force() const;
  bool has_roughness() const { return Ra_um || Rz_um; }
};

struct UsedTool {
  std::string name;
  double re_mm = 0, kapr_deg = 0, rake_deg = 0;
  bool wiper = false;
};

struct Request {
  std::string cuts_pointer, source;
  std::vector<MeasuredCut> cuts;
  std::vector<std::string> labs, replicas;  ///< names, as they first come
  UsedTool tool;
  std::optional<nlohmann::json> material;  ///< the document to start from
  std::optional<catalogue::Material> base;
  std::optional<std::string> id, name;
  cutting::Cut edge;  ///< the tool in the material as it was given
  double given_a = 0, given_b = 0;
  cutting::FitOptions options;
};

/// @throws InputError with every problem.
Request read(const nlohmann::json& request, const Catalogue& catalogue);

}  // namespace turnwright::document::material_calibration
