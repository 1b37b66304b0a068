#pragma once
#include <functional>

#include "reader.hpp"

namespace turnwright::document {

/// Reads a document that is a member of another: problems that `work` throws are added below
/// the member's pointer.  Whether there were none.
bool read_below(const Reader& member, Problems& problems,
                const std::function<void()>& work);

}  // namespace turnwright::document
