#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/chatter/frf.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::document {

/// Modes fitted to a frequency response measured along an axis.
struct MeasuredAxis {
  chatter::Axis axis = chatter::Axis::x;
  std::string pointer;       ///< of its part of the request
  std::size_t lines = 0;     ///< used
  std::size_t left_out = 0;  ///< at 0 Hz, where nothing vibrates, or outside the band
  double from_Hz = 0, to_Hz = 0;
  chatter::ModalFit fit;
};

enum class AxisKey { asked, none };

/// {"axis", "unit": "mm/N" .. "g/N", "csv", "columns", "from_Hz", "to_Hz", "modes"}; what
/// cannot be fitted is reported with the line of the table that tells it.  Nothing if
/// there is a problem.
std::optional<MeasuredAxis> read_frequency_response(Reader r, AxisKey axis);

/// As the document of a result has it.
nlohmann::ordered_json described(const MeasuredAxis& measured);

/// What speaks for a wrong unit or table, though there are modes: less than 0.9 of the
/// squares explained, the most compliant mode outside 100 to 1e6 N/mm.
std::vector<std::string> doubts(const MeasuredAxis& measured);

}  // namespace turnwright::document
