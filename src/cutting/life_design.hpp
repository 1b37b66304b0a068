#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "pooled_labs.hpp"
#include "turnwright/cutting/life_point.hpp"

namespace turnwright::cutting {

/// Logarithms of lives and conditions, one row each.
struct LifeRows {
  Eigen::VectorXd v, f, d;  ///< ln vc, ln f, ln ap
  Eigen::VectorXd y;        ///< ln T
  std::vector<bool> longer;
  std::vector<std::size_t> lab;

  /// @throws std::domain_error if a number is not positive and finite.
  explicit LifeRows(std::span<const LifePoint> lives);
  Eigen::Index size() const { return y.size(); }
  LifeRows rows(const std::vector<std::size_t>& which) const;
  std::vector<std::size_t> ended() const;  ///< rows of the lives that are known
  bool censored() const { return static_cast<Eigen::Index>(ended().size()) < size(); }
};

/// Columns behind those of the labs: ln vc with the terms of the given exponents, then ln f
/// and ln ap where their exponents are fitted.
Eigen::MatrixXd life_columns(const LifeRows& rows, bool with_a, bool with_b,
                             double given_a, double given_b);

}  // namespace turnwright::cutting
