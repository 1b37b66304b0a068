#pragma once
#include "notation_words.hpp"
#include "turnwright/exchange/outline.hpp"

/// What is asked of a surface or cut at an edge, as a notation says it.
namespace turnwright::exchange::notated {

/// Checks that a size is > 0 and at most `most`, and says so at its word if it is not.
bool in_range(Word at, double x, double most, const char* unit, Mistakes& mistakes);
inline constexpr double kLargest_mm = 20000;

/// Whether the word has the form of a tolerance class of ISO 286: one or two letters and a
/// grade of one or two digits.
bool is_fit(Word word);

/// "+0.02/-0.01", "+0.1/0", "±0.05".
std::optional<part::Limits> limits(Word word);

/// A roughness "Ra1.6", "Rz6.3"; whether the word begins as one.
bool take_roughness(Word word, Demands& demands, Mistakes& mistakes);

/// The features of a corner, one edge each; without its place.
std::vector<Edge> corner(const std::vector<Word>& words, Mistakes& mistakes);
/// Whether a statement that begins with this word is a corner.
bool begins_corner(Word word);

}  // namespace turnwright::exchange::notated
