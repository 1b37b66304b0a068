#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/review/review.hpp"

/// Programs whose words F and S alone are changed, to the conditions of least cost for the
/// passes that they make.
namespace turnwright::review {

/// The plan of a review's operations with their tools, passes and depths, and the speeds and
/// feeds of least cost.  A reconstructed depth of roughing may be off by what a size's limits
/// and corrections are, which can take the finishing pass out of its tool's window: where the
/// depths have no plan, one whose depths are nearer than 0.05 mm or 5 % serves.
planning::ProcessPlan best_of_passes(
    const planning::PreparedPart& part,
    const std::vector<planning::OperationRequest>& operations,
    const std::vector<MountedTool>& tools);

/// Factors of the words of a program, by their lines.
struct WordFactors {
  std::map<std::size_t, double> F, S;
};

/// Factors by which a setup's program comes to a plan of its operations.  Where a word
/// serves several operations, the least of theirs counts: lower speeds and feeds press less.
/// The lead of a thread is none of these words.
WordFactors word_factors(const ReviewedSetup& setup, const TurningProgram& program,
                         const planning::SetupPlan& plan);

struct ChangedWord {
  std::size_t line = 0;
  std::string was, is;
};

struct CorrectedText {
  std::string text;
  std::vector<ChangedWord> words;
};

/// A program with these words multiplied, cut off at the last decimal (of S that of the
/// program, of F at least the third); words that change by less than a thousandth stay.
CorrectedText corrected_text(std::string_view text, gcode::Control control,
                             const WordFactors& factors);

}  // namespace turnwright::review
