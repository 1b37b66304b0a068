#pragma once
#include <complex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "measured_unit.hpp"

namespace turnwright::document {

/// A line of a frequency response, with its place in what was read.
struct MeasuredLine {
  double frequency_Hz = 0;
  std::complex<double> value;            ///< [mm/(s^d N)]
  std::optional<double> coherence = {};  ///< ordinary coherence, gamma^2
  std::string pointer;
};

/// A frequency response from a table, a universal file or taps.
struct MeasuredResponse {
  std::string key;     ///< of the request, that holds it: "csv", "uff", "taps"
  int derivative = 0;  ///< d: 0 receptance, 1 mobility, 2 accelerance
  std::string unit;    ///< as written
  std::vector<MeasuredLine> lines;  ///< rising in frequency
  double decay_1_s = 0;             ///< of the window on its time series
  std::vector<std::string> doubts;  ///< for the warnings
  nlohmann::ordered_json told = nlohmann::ordered_json::object();  ///< for the result
};

/// A unit of a response with the text that named it.
struct WrittenUnit {
  std::string text;
  ResponseUnit unit;
};

/// How many problems the document of a reader has so far, listed or only counted.
std::size_t problems_of(const Reader& r);

/// "unit", if it is there.
std::optional<WrittenUnit> read_response_unit(Reader& r);

/// The unit that the data state, or else that under "unit"; they must not differ, and one
/// of them must be there.  `where` says in the problem where the data would state it.
std::optional<WrittenUnit> agreed_unit(Reader& r, const std::optional<WrittenUnit>& given,
                                       const std::optional<WrittenUnit>& stated,
                                       const std::string& where);

}  // namespace turnwright::document
