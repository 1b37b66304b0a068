#pragma once
#include <string>

/// Words that result documents have from a fixed list, in the program's language.
namespace turnwright::report {

/// A kind, status, clamping or source of a budget ("bore-rough") as a reader says it; whatever
/// else, an id say, as it is.
std::string spoken(const std::string& word);

}  // namespace turnwright::report
