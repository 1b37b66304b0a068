#pragma once
#include <string>

/// Words that result documents have from a fixed list, in the program's language.
namespace turnwright::report {

/// A kind, status, clamping, source of a budget or limit ("bore-rough", "grip of the
/// chuck") as a reader says it; whatever else, an id say, as it is.
std::string spoken(const std::string& word);

/// The name of a limit; of a tolerance its id and its kind, "t1 cylindricity"; where a window
/// ends by its cost, "cost +5 %".
std::string spoken_limit(const std::string& name);

}  // namespace turnwright::report
