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
  std::size_t lines = 0;     ///< lines used
  std::size_t left_out = 0;  ///< lines outside the band, or at 0 Hz
  double from_Hz = 0, to_Hz = 0;
  chatter::ModalFit fit;
};

enum class AxisKey { asked, none };

/// {"axis", "unit": "mm/N" .. "g/N", "csv", "columns", "from_Hz", "to_Hz", "modes"}.  A
/// response that cannot be fitted is reported with the line of the table that shows it.
/// Nothing if there is a problem.
std::optional<MeasuredAxis> read_frequency_response(Reader r, AxisKey axis);

/// The fit as in the document of a result.
nlohmann::ordered_json described(const MeasuredAxis& measured);

/// Warnings of a possibly wrong unit or table although there are modes: less than 0.9 of
/// the squares explained, the most compliant mode outside 100 to 1e6 N/mm, or noise that
/// may hide a mode of a tenth of the highest peak.
std::vector<std::string> doubts(const MeasuredAxis& measured);

}  // namespace turnwright::document
