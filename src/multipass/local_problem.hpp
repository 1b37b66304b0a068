#pragma once
#include <limits>
#include <span>
#include <vector>

#include "rows.hpp"
#include "turnwright/optimise/local.hpp"

/// The original problem with ln ds as a function of ln dr, for NLopt and for prices.
namespace turnwright::multipass {

Pass roughing(const Log& y);
/// The finishing pass removes the remaining depth, so that the depths add up to dt.
Pass finishing(const Log& y, const Depths& depths);
Log logarithms(const Pass& rough, const Pass& finish);
double ln_cost(const Problem& problem, const Depths& depths, const Log& y);

struct Best {
  double ln_UC =
      std::numeric_limits<double>::infinity();  ///< infinity: no feasible point
  Log y = Log::Zero();
};

/// min ln UC over the first five variables; every limit is a constraint.
class LocalProblem {
 public:
  /// Both must outlive it.
  LocalProblem(const Problem& problem, const std::vector<Row>& rows,
               const Depths& depths);

  Best from(const Log& start) const;
  /// d ln UC over the relaxation of a limit, one for each row.
  std::vector<double> multipliers(const Log& y) const;

 private:
  static constexpr std::size_t kFree = kDs;

  Log whole(std::span<const double> x) const;
  void evaluate(std::span<const double> x, optimise::Values& out) const;
  Log gradient(const Log& y) const;  // of ln UC

  const Problem& m_;
  const std::vector<Row>& rows_;
  Depths depths_;
  optimise::Problem problem_;
};

}  // namespace turnwright::multipass
