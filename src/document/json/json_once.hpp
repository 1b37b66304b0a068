#pragma once
#include <nlohmann/json.hpp>

/// Among the precompiled headers: the members of json are compiled once, in json_once.cpp, not
/// by every file that uses them.
extern template class nlohmann::basic_json<>;
