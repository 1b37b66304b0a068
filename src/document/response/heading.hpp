#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the name of a column of measured data says.
namespace turnwright::document {

/// "Phase [deg]", "Phase (deg)", "phase_deg", "Phase, deg" -> "Phase" and "deg": the unit
/// is the longest end, brackets around it not counted, that `is_unit` takes, behind a blank,
/// a bracket, a comma, a colon, a slash or an underscore; "" if there is none, or in a name of
/// more than 200 bytes.
struct Heading {
  std::string quantity, unit;
};
Heading heading(std::string_view name, bool (*is_unit)(std::string_view));

/// Words of a heading in lower case.
std::vector<std::string> words_of(std::string_view text);

/// A quantity that a column may hold, and words that name it: lower-case words, or their
/// beginnings, marked by a star, "phas*".
struct Quantity {
  std::string key;
  std::vector<std::string_view> words;
};

/// The first of the quantities one of whose words is among those of a heading.
const Quantity* quantity_named(std::string_view heading,
                               const std::vector<Quantity>& quantities);

}  // namespace turnwright::document
