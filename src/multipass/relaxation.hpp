#pragma once
#include <vector>

#include "rows.hpp"
#include "turnwright/optimise/posynomial.hpp"
#include "turnwright/optimise/relaxation_search.hpp"

/// One number of roughing passes: convex programs below and above its cost.
namespace turnwright::multipass {

/// Variables of a search box: ln dr and s = ln(Ts/Tr).
enum BoxVariable { kLnDr, kLifeRatio };

/// An affine function of s.
struct Line {
  double alpha = 0, beta = 0;
  double at(double s) const { return alpha + beta * s; }
};

/// ln(theta + (1 - theta) exp(s)), the mean tool life over Tr with s = ln(Ts/Tr): convex.
class MeanLife {
 public:
  explicit MeanLife(double theta) : theta_(theta) {}
  double at(double s) const;
  Line chord(const Interval& s) const;  ///< nowhere below it on s
  Line tangent(double s) const;         ///< nowhere above it

 private:
  double theta_;
};

/// ln ds - ln(dt - n exp(ln dr)) over a range of ln dr, as limits: the chord, below which
/// no ds lies, and three tangents, above which none does.
std::vector<Affine> depth_limits(const Depths& depths, const Interval& ln_dr);

optimise::Monomials monomials(const std::vector<Affine>& rows);

/// The programs of one n; limits of a single variable are bounds.
class Relaxation {
 public:
  Relaxation(const Problem& problem, const std::vector<Row>& rows, const Depths& depths);

  /// UC with the mean life replaced by `line`, over a range of ln dr and of s.  Where the
  /// range of ln dr has a width, limit 0 is the chord of the depths.
  optimise::Posynomial program(const Interval& ln_dr, const Interval& s,
                               const Line& line) const;

  double life_ratio(const Log& y) const { return ratio_.at(y); }  ///< s
  double tool_share(
      const Log& y) const;  ///< share of the tool in UC by the true mean life

 private:
  Depths depths_;
  bool literal_;
  MeanLife mean_life_;
  std::vector<Affine> limits_;  // of more than one variable, or of none
  Log lower_, upper_;
  Affine roughing_life_, finishing_life_, ratio_, roughing_time_, finishing_time_;
  double fixed_cost_, k0_, tool_;
};

}  // namespace turnwright::multipass
