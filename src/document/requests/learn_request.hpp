#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/learning/series.hpp"

/// The request of the capability `learn`.
namespace turnwright::document::measured_parts {

struct Characteristic {
  std::string id;
  double nominal_mm = 0;  ///< 0 of form and place
  learning::Limits limits;
  std::optional<long> parts_per_edge = {};
  std::string device = {};  ///< that measured it, where the values say so
};

struct Row {
  std::string part, edge;
  std::size_t characteristic = 0;
  double value_mm = 0, offset_mm = 0;
  std::optional<double> time_s = {}, age = {};
  std::string pointer;
};

struct Request {
  std::vector<Characteristic> characteristics;
  std::vector<Row> rows;
  double confidence = 0.95, outlier_p = 0.01;
  std::optional<PreparedDocument> part;
  nlohmann::json part_document;            ///< as written
  bool update = false;                     ///< of the factors of the models
  std::vector<std::string> warnings = {};  ///< of what was not read
};

/// @throws InputError with every problem.
Request read(const nlohmann::json& request, const Catalogue& catalogue);

/// The rows of one characteristic in the order of making, as a series.
struct MadeSeries {
  std::vector<std::size_t> rows;  ///< of the request
  learning::Series series;
  bool timed = false;              ///< `at` is in hours
  std::vector<std::string> edges;  ///< names by index
};
MadeSeries series_of(const Request& request, std::size_t characteristic);

}  // namespace turnwright::document::measured_parts
