#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "learn_statistics.hpp"

namespace turnwright::document::measured_parts {

/// Factors of the models as the measured parts leave them, and the documents with them.
struct Updated {
  nlohmann::ordered_json factors, documents;
  std::vector<std::string> warnings;
};

/// The part is planned; its plan's sizes are compared with those measured
/// (planning/factor_effects.hpp, learning/factors.hpp):
///
///     forces, compliance   mean of each size - plan = by_force ln F + by_compliance ln C + a
///                          with an unknown setting a of each tool
///     drift, wear          d = 2 rho, w = wear_mm_part omega, of the size with the most
///                          values of each tool
///     repeatability        s^2/4 of the same sizes
///     rechucking           (y/2)^2 of run-outs to a datum of another setup, two components
///
/// Priors are those of the documents: passive force and stiffness by their uncertainties,
/// rho ~ N(0, (2 drift_um/tau)^2) with tau the time between two corrections of the plan,
/// omega ~ N(1, (u(C)/n)^2), one at most; scatters by the uncertainty of the machine's budget.
Updated updated(const Request& request, const std::vector<Learned>& all,
                const Catalogue& catalogue);

}  // namespace turnwright::document::measured_parts
