#include <gtest/gtest.h>

#include <BonBonminSetup.hpp>
#include <BonCbc.hpp>
#include <BonTMINLP.hpp>
#include <cmath>

#include "oracle.hpp"
#include "variants.hpp"

// Bonmin [Bonami 2008], branch and bound over Ipopt's local optima, is given the literature's
// equations alone, n among its variables.  It proves nothing here, as the problem is not convex.
namespace turnwright::multipass {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr Index kVariables = 6;  // those of Five, and n

class Posed : public Bonmin::TMINLP {
 public:
  explicit Posed(const Problem& m) : m_(m) {
    const double middle = std::log(m.dt_mm / 3);
    start_ = {std::log(100), std::log(0.5), middle, std::log(150), std::log(0.2), 2};
    limits_ = at(start_.data()).size() - 1;
  }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    Ipopt::TNLP::IndexStyleEnum& style) override {
    n = kVariables;
    m = static_cast<Index>(limits_);
    jacobian = n * m;
    hessian = 0;
    style = Ipopt::TNLP::C_STYLE;
    return true;
  }
  bool get_variables_types(Index, VariableType* types) override {
    std::fill(types, types + 5, CONTINUOUS);
    types[5] = INTEGER;
    return true;
  }
  bool get_variables_linearity(Index n, Ipopt::TNLP::LinearityType* types) override {
    std::fill(types, types + n, Ipopt::TNLP::NON_LINEAR);
    return true;
  }
  bool get_constraints_linearity(Index m, Ipopt::TNLP::LinearityType* types) override {
    std::fill(types, types + m, Ipopt::TNLP::NON_LINEAR);
    return true;
  }
  bool get_bounds_info(Index, Number* lower, Number* upper, Index m, Number* g_lower,
                       Number* g_upper) override {
    const Span s = span({m_, 1});
    std::copy(s.lower.begin(), s.lower.end(), lower);
    std::copy(s.upper.begin(), s.upper.end(), upper);
    lower[5] = 1;
    upper[5] = m_.n_max;
    std::fill(g_lower, g_lower + m, -1e20);
    std::fill(g_upper, g_upper + m, 0);
    return true;
  }
  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    std::copy(start_.begin(), start_.end(), x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& f) override {
    f = at(x)[0];
    return true;
  }
  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override {
    for (Index j = 0; j < kVariables; ++j) gradient[j] = slopes(x, j)[0];
    return true;
  }
  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    const auto all = at(x);
    std::copy(all.begin() + 1, all.end(), g);
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool, Index m, Index, Index* row, Index* column,
                  Number* values) override {
    for (Index j = 0, k = 0; j < kVariables; ++j) {
      const auto slope = values ? slopes(x, j) : std::vector<double>();
      for (Index i = 0; i < m; ++i, ++k) {
        if (values) {
          values[k] = slope[static_cast<std::size_t>(i) + 1];
        } else {
          row[k] = i;
          column[k] = j;
        }
      }
    }
    return true;
  }
  bool eval_h(Index, const Number*, bool, Number, Index, const Number*, bool, Index,
              Index*, Index*, Number*) override {
    return false;  // Ipopt approximates it
  }
  void finalize_solution(SolverReturn status, Index, const Number* x, Number f) override {
    if (status != SUCCESS) return;
    cost = f;
    passes = std::lround(x[5]);
  }
  const BranchingInfo* branchingInfo() const override { return nullptr; }
  const SosInfo* sosConstraints() const override { return nullptr; }

  double cost = std::numeric_limits<double>::infinity();
  long passes = 0;

 private:
  // The cost and the limits.
  std::vector<double> at(const Number* x) const {
    const Oracle o{m_, x[5]};
    Five y;
    std::copy(x, x + 5, y.begin());
    std::vector<double> all;
    o.limits(y, all);
    all.insert(all.begin(), o.cost(y));
    return all;
  }
  // Their central differences.
  std::vector<double> slopes(const Number* x, Index j) const {
    constexpr double kStep = 1e-6;
    std::array<double, kVariables> to;
    std::copy(x, x + kVariables, to.begin());
    to[static_cast<std::size_t>(j)] = x[j] + kStep;
    auto out = at(to.data());
    to[static_cast<std::size_t>(j)] = x[j] - kStep;
    const auto before = at(to.data());
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = (out[i] - before[i]) / (2 * kStep);
    return out;
  }

  const Problem m_;
  std::array<double, kVariables> start_{};
  std::size_t limits_ = 0;
};

TEST(BonminWitness, ItsOptimaAreOurs) {
  for (const double dt : {4., 5., 6., 7., 8., 9., 9.5, 10., 12., 14.})
    for (const Cost cost : {Cost::literal, Cost::physical}) {
      SCOPED_TRACE(dt);
      Ipopt::SmartPtr<Posed> posed = new Posed(literature(dt, cost));
      Bonmin::BonminSetup bonmin;
      bonmin.initializeOptionsAndJournalist();
      bonmin.readOptionsString(
          "bonmin.algorithm B-BB\nhessian_approximation limited-memory\n"
          "bonmin.allowable_gap 0\nbonmin.allowable_fraction_gap 0\n"
          "bonmin.nlp_log_level 0\nbonmin.bb_log_level 0\nsb yes\n"
          "bonmin.nlp_failure_behavior fathom\n");
      bonmin.initialize(Ipopt::SmartPtr<Bonmin::TMINLP>(GetRawPtr(posed)));
      Bonmin::Bab search;
      search(bonmin);
      const auto ours = optimum(literature(dt, cost)).best;
      ASSERT_TRUE(ours);
      EXPECT_NEAR(posed->cost, *ours->UC, 1e-6 * *ours->UC);
      EXPECT_EQ(posed->passes, ours->n);
    }
}

}  // namespace
}  // namespace turnwright::multipass
