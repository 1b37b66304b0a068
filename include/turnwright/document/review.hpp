#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/review/corrected.hpp"

namespace turnwright::document {

/// A number of the turret and what the request says of its tool.
struct NumberedTool {
  std::string pointer;  ///< where the request says it
  int number = 0;
  std::string id;
  std::optional<double> size_mm = {};
};

/// The request of `review` (schemas/review.request.json): a part document, programs of its
/// setups, the tools in the turret.
struct ReviewRequest {
  Candidates part = {};
  gcode::Control control = gcode::Control::linuxcnc;
  struct Text {
    std::size_t setup = 0;
    std::string text;
    double zero_mm = 0;
  };
  std::vector<Text> programs = {};
  std::vector<NumberedTool> tools = {};
  bool correct = false;  ///< whether corrected programs are asked for
};

/// @throws InputError with every problem, those of the part below "/part".
ReviewRequest load_review_request(const nlohmann::json& json, const Catalogue& catalogue);

/// What a review is made from, once it is known which of the part's candidates is meant.
struct ReviewInput {
  std::vector<review::ReviewedProgram> programs;
  std::vector<review::MountedTool> tools;
};

/// Reads the programs, and finds the documents of their tools in the part and in the
/// catalogue: those that the request names, and those that comments name as `nc` does.
/// @throws InputError naming ids and sizes that are in neither.
ReviewInput review_input(const ReviewRequest& request, const planning::PreparedPart& part,
                         const Catalogue& catalogue);

/// What planning says of a review.
struct ReviewedPlan {
  planning::ProcessPlan plan;  ///< of the part, for comparison
  /// The programs' own operations, predicted; none if `cannot` says why.
  std::optional<planning::ProcessPlan> predicted = {};
  std::vector<std::string> cannot = {};
};

/// Corrected programs of the setups, with their own review and prediction; none if `cannot`
/// says why.
struct CorrectedPrograms {
  std::vector<review::CorrectedText> texts = {};
  review::Review review = {};
  ReviewedPlan plan = {};
  std::vector<std::string> cannot = {};
};

/// The result of `review` (schemas/review.result.json); `corrected` if it was asked for.
nlohmann::ordered_json review_result(const ReviewRequest& request,
                                     const PreparedDocument& part,
                                     const ReviewInput& input,
                                     const review::Review& review,
                                     const ReviewedPlan& plan,
                                     const std::optional<CorrectedPrograms>& corrected);

}  // namespace turnwright::document
