#pragma once
#include <string>

namespace turnwright::planning {

/// How sentences name a limit: the name of a Limit, constraint, conflict or end of an
/// operating window ("cost +5 %"), which is English, in the program's language, with its ids
/// as they are.
std::string limit_words(const std::string& name);

}  // namespace turnwright::planning
