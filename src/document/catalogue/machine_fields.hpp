#pragma once
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/volumetric/kinematics.hpp"

/// Machines with their geometric errors, as requests and machine documents hold them:
///
///     "chain": "wCfZXt", "axes": [{"name": "X", "p_mm": [0, 0, 0], "Q": 100,
///       "err": {"EXX": {"c": [c0, c1, c2, c3], "b": 0, "f": [[a1, d1]]}},
///       "sq": {"EB0X": 0}, "loc": {"EX0C": 0}}]
///
/// Instead of coefficients an error may hold readings of a laser or a ball array,
/// {"table": {"q": [..], "plus": [..], "minus": [..], "unit": "um", "sign": "physical"}}.
namespace turnwright::document {

/// Reads the members "chain" and "axes".  If `r` has problems afterwards, the machine may
/// be incomplete and must not be given to Kinematics.
/// @param fitted_u  receives the standard uncertainties of errors fitted to tables.
volumetric::Machine read_chain(Reader& r,
                               std::vector<volumetric::Axis>* fitted_u = nullptr);

/// Reads the optional member "u", the standard uncertainties of the errors of the chain's
/// axes.  Its keys "name", "err", "sq" and "loc" are those above, without tables; no value
/// may be negative.  Where "u" gives none for an error, or zero, that of the fit to the
/// error's table, `fitted`, is taken.
std::vector<volumetric::Axis> read_uncertainties(
    Reader& r, const volumetric::Machine& machine,
    const std::vector<volumetric::Axis>& fitted);

volumetric::Vec3 read_vec3(Reader& r, std::string_view key, const Bounds& bounds);

/// {"q": {"X": 10}, "sign": {"X": 1}}; axes that are not named are at 0 and at rest.
volumetric::Position read_position(Reader r, const volumetric::Machine& machine);

/// The machine as read_chain reads it, without zeros.
nlohmann::json chain_json(const volumetric::Machine& machine);

/// One number of a calibration: "EXX1" to "EXX3" (c1 to c3 with Q = 100 mm or pi), "EXXb"
/// (half the reversal), "EB0Z" (squareness, place), physical, with its standard
/// uncertainty.
struct Calibrated {
  std::string name;
  double value = 0, u = 0;
};

/// A chain without errors.
catalogue::GeometricErrors blank_errors(const std::string& chain);

/// Replaces a value of the model; its axis is one of the chain.
void put(const Calibrated& found, catalogue::GeometricErrors& errors);

/// The member "errors" of a machine document, which read_lathe reads.
nlohmann::json errors_json(const catalogue::GeometricErrors& errors);

}  // namespace turnwright::document
