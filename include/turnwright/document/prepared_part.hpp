#pragma once
#include <set>
#include <string>

#include "turnwright/document/part_plan.hpp"
#include "turnwright/planning/changed_request.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/planning/rules.hpp"

/// A part document, read and prepared for planning.
namespace turnwright::document {

struct PreparedDocument {
  planning::PreparedPart part;
  std::vector<Assumption>
      assumed;  ///< by the reader and by what follows from the request
  std::vector<planning::WhatIf> what_if;
};

/// What follows from a request that was read: holes that are drilled, jaws that are eased,
/// the setups of milled places.
/// @throws InputError of milled places that no setup leaves free, and of changed requests
///   (`what_if`) that cannot be read.
PreparedDocument prepared(LoadedPart loaded, const Catalogue& catalogue);

/// The same of a document.
/// @throws InputError also as load_part_plan does.
PreparedDocument prepared_part(const nlohmann::json& json, const Catalogue& catalogue,
                               const std::string& document,
                               Purpose purpose = Purpose::plan);

/// The documents among which a part document leaves the choice ("choose").
struct Candidates {
  struct Usable {
    std::string name;  ///< "lathe-small; bar 50 x 188 mm", empty without a choice
    PreparedDocument document;
    std::vector<planning::WithoutRule> without = {};
    std::optional<double> unless_within = {};  ///< as of a planning::Candidate
  };
  struct Refused {
    std::string name, why;  ///< a bar that is too thin for the part, say
  };
  std::vector<Usable> usable;  ///< one at least
  std::vector<Refused> refused;
};

/// The currencies that the candidates' rates name.
std::set<std::string> currencies(const Candidates& candidates);

/// @param window_curves  as in the request for a plan.
/// @throws InputError if no candidate can be read, with the problems of the first one; if
///   rates are in several currencies.
Candidates prepared_candidates(const nlohmann::json& json, const Catalogue& catalogue,
                               const std::string& document, bool window_curves = false);

}  // namespace turnwright::document
