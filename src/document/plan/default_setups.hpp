#pragma once
#include <string>

#include "document/part/choices.hpp"

namespace turnwright::document {

/// A variant, read.  If it names neither setups nor what belongs to one of them (operations,
/// the setup of a milled place), it gets both ends held, right then left, where that leaves
/// fewer surfaces uncut than left then right; its document then says so.
/// @throws InputError as load_variant does.
LoadedPart with_setups(Variant& variant, const Catalogue& catalogue,
                       const std::string& document);

}  // namespace turnwright::document
