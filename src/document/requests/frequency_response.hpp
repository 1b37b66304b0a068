#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "document/response/measured_response.hpp"
#include "turnwright/chatter/frf.hpp"
#include "turnwright/chatter/stabilisation.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::document {

/// Modes fitted to a frequency response measured along an axis.
struct MeasuredAxis {
  chatter::Axis axis = chatter::Axis::x;
  std::string pointer;       ///< of its part of the request
  std::size_t lines = 0;     ///< lines used
  std::size_t left_out = 0;  ///< lines outside the band, or at 0 Hz
  double from_Hz = 0, to_Hz = 0;
  MeasuredResponse response;  ///< as read; without the lines left out
  bool conjugate = false;     ///< it was measured under a force e^(-i w t)
  chatter::ModalFit fit;
  chatter::Stabilisation stabilisation;  ///< its diagram
};

enum class AxisKey { asked, none };

/// {"axis", a response (response/response_table.hpp), "reversed", "from_Hz", "to_Hz",
/// "modes"}.  A response that cannot be fitted is reported with the line that shows it.
/// Nothing if there is a problem.
///
/// Measured under a force e^(-i w t) it is the conjugate of what (1) of chatter/frf.hpp
/// fits.  It is taken as such if as measured less than 0.98 is explained, and the conjugate
/// leaves less than a quarter of what the response as measured and the one of opposite sign
/// leave.
///
/// Lines with a coherence have errors by it (chatter/coherence.hpp); those below 0.1 are left
/// out.
std::optional<MeasuredAxis> read_frequency_response(Reader r, AxisKey axis);

/// The fit as in the document of a result.
nlohmann::ordered_json described(const MeasuredAxis& measured);

/// Warnings of a possibly wrong unit or table although there are modes: less than 0.9 of
/// the squares explained, the most compliant mode outside 100 to 1e6 N/mm, noise that
/// may hide a mode of a tenth of the highest peak, the other sign of phase, a coherence
/// below 0.8 at a mode, a mode of a tenth of the highest peak or of 2 % of the least depth
/// that never becomes stable in the diagram (of 20 orders at least), or a stable pole that
/// no mode explains.
std::vector<std::string> doubts(const MeasuredAxis& measured);

}  // namespace turnwright::document
