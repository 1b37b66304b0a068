#pragma once
#include <string>
#include <string_view>

namespace turnwright::report {

/// A line of a text report with the colours of a terminal (SGR, ECMA-48 8.3.117): headings in
/// capitals are bold; what "status" says is green where every limit is kept, yellow where that
/// holds nominally only, and red otherwise.  Other lines stay as they are.
std::string styled(std::string_view line);

}  // namespace turnwright::report
