#pragma once
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"

/// What people call a material.
namespace turnwright::document {

/// The materials that `name` may mean: the one with this id; otherwise all that have it as
/// id, name or synonym, letters and digits compared in lower case, without the system that
/// a designation belongs to.  So "AISI 1045", "aisi1045" and "1045" are one, and "1.7225"
/// means 42CrMo4 in every state that the catalogue has.
std::vector<catalogue::Material> materials_called(
    const std::string& name, const std::vector<catalogue::Material>& materials);

/// What is expected in place of a name that means several: their ids, each with its name.
std::string expected_state(const std::vector<catalogue::Material>& candidates);

}  // namespace turnwright::document
