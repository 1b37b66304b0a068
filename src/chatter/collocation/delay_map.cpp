#include "delay_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "chatter/model/eigenvalues.hpp"
#include "chatter/model/free_vibration.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The number of nodes p of (4).
std::size_t nodes_for(double phase, double error) {
  constexpr std::size_t kFewest = 4, kMost = 40;
  double left = 2;
  for (std::size_t p = 1; p < kMost; ++p) {
    left *= phase / 2 / static_cast<double>(p);
    if (left <= error && p >= kFewest) return p;
  }
  return kMost;
}

}  // namespace

DelayMap::DelayMap(const Cutter& cutter, double n_rpm, double ap_mm, const Range& range,
                   const Fineness& fineness)
    : cutter_(cutter),
      contact_(cutter, n_rpm, ap_mm),
      rad_s_(2 * units::kPi * n_rpm / 60),
      period_s_(period_s(cutter, n_rpm)),
      unit_N_(cutter.system.modes.front().k_N_mm) {
  for (const Mode& m : cutter.system.modes) {
    auto& row = row_of_axis_[m.axis == Axis::x ? 0 : 1];
    if (row < 0) row = axes_++;
    axis_of_.push_back(static_cast<std::size_t>(row));
    states_ += 2;
  }
  const double turning = turns(CutterEngagement(cutter, n_rpm, range.to_mm));
  lay_out(turning, longest(n_rpm, range), fineness);
  connect();
  assemble();
}

// Between depths at which the order of the ends changes lengths are linear in the depth.
std::vector<double> DelayMap::longest(double n_rpm, const Range& range) const {
  constexpr double kInside = 1e-3;  // at a range's ends lengths may vanish
  const auto lengths = [](const std::vector<double>& breaks) {
    std::vector<double> out(breaks.size());
    std::adjacent_difference(breaks.begin(), breaks.end(), out.begin());
    return out;
  };
  std::vector<double> out = lengths(contact_.breaks());
  for (const double share : {kInside, 1 - kInside}) {
    const double ap = std::lerp(range.from_mm, range.to_mm, share);
    const auto there = lengths(CutterEngagement(cutter_, n_rpm, ap).breaks());
    if (there.size() != out.size()) continue;
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = std::max(out[i], (1 + 4 * kInside) * there[i]);
  }
  return out;
}

/// Largest rate at which the motion oscillates or decays, for depths up to that of the
/// engagement [1/s]: that of the free modes, of the modes stiffened by the force, and
/// twice that of the spindle for the directional factors.
double DelayMap::turns(const CutterEngagement& contact) const {
  double fastest = 0, push = 0;
  for (const Mode& m : cutter_.system.modes) {
    fastest = std::max(fastest, rate(m));
    push += m.wn_rad_s * m.wn_rad_s / m.k_N_mm;
  }
  const auto size = [](const Directional& h) {
    return std::max(std::abs(h.xx) + std::abs(h.xy), std::abs(h.yx) + std::abs(h.yy));
  };
  double force = 0, damping = 0;
  constexpr int kSamples = 64;
  for (int k = 0; k < kSamples; ++k) {
    const Load load = contact.load(contact.period_rad() * (k + 0.5) / kSamples);
    double all = 0;
    for (const Directional& h : load.regenerative) all += size(h);
    force = std::max(force, all);
    damping = std::max(damping, size(load.damping));
  }
  return fastest + std::sqrt(fastest * fastest + force * push) + damping * push +
         2 * rad_s_;
}

void DelayMap::lay_out(double turns, const std::vector<double>& longest,
                       const Fineness& fineness) {
  const std::vector<double> breaks = contact_.breaks();
  size_ = states_;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double begin = breaks[i] / rad_s_, length = breaks[i + 1] / rad_s_ - begin;
    if (!contact_.cuts((breaks[i] + breaks[i + 1]) / 2)) {
      pieces_.push_back({.begin_s = begin, .length_s = length, .state = {}});
      continue;
    }
    const double turned = longest[i + 1] / rad_s_ * turns / 2,
                 parts = std::ceil(turned / fineness.phase_rad);
    const std::size_t nodes = nodes_for(turned / parts, fineness.error);
    for (double k = 0; k < parts; ++k) {
      pieces_.push_back({.begin_s = begin + length * k / parts,
                         .length_s = length / parts,
                         .rule = &quadrature(nodes),
                         .first = size_,
                         .state = {}});
      size_ += axes_ * static_cast<Index>(nodes);
      if (size_ > kMostUnknowns)
        throw TooManyVibrations(
            tr("milling: a period of this cutter holds too many vibrations; ask for a "
               "higher speed or a smaller depth"));
    }
  }
}

// The state at the beginning of each piece by the unknowns before it.
void DelayMap::connect() {
  Matrix state = Matrix::Zero(states_, size_);
  state.leftCols(states_).setIdentity();
  for (Piece& piece : pieces_) {
    const Index known = piece.rule ? piece.first : size_;
    piece.state = state.leftCols(known);
    Matrix next = Matrix::Zero(states_, size_);
    for (std::size_t k = 0; k < cutter_.system.modes.size(); ++k) {
      const Mode& mode = cutter_.system.modes[k];
      const auto at = static_cast<Index>(2 * k);
      const Transition t = transition(mode, piece.length_s);
      next.row(at) = t.xx * state.row(at) + t.xv * state.row(at + 1);
      next.row(at + 1) = t.vx * state.row(at) + t.vv * state.row(at + 1);
      if (!piece.rule) continue;
      const std::size_t p = piece.rule->size;
      for (std::size_t j = 0; j < p; ++j) {
        const double s = piece.rule->nodes[j];
        const Transition to_end = transition(mode, piece.length_s * (1 - s));
        const double by = unit_N_ * mode.wn_rad_s / mode.k_N_mm * piece.length_s *
                          piece.rule->weights[j];
        const auto column = piece.first + static_cast<Index>(axis_of_[k] * p + j);
        next(at, column) += by * to_end.xv;
        next(at + 1, column) += by * to_end.vv;
      }
    }
    state.swap(next);
  }
  last_ = std::move(state);
}

DelayMap::Rows DelayMap::rows_at(const Piece& piece, double offset_s) const {
  Rows out{Matrix::Zero(axes_, size_), Matrix::Zero(axes_, size_)};
  const Index known = piece.state.cols();
  std::vector<double> integrals;
  if (piece.rule)
    integrals =
        integrals_to(*piece.rule, std::clamp(offset_s / piece.length_s, 0.0, 1.0));
  for (std::size_t k = 0; k < cutter_.system.modes.size(); ++k) {
    const Mode& mode = cutter_.system.modes[k];
    const auto at = static_cast<Index>(2 * k), axis = static_cast<Index>(axis_of_[k]);
    const Transition t = transition(mode, offset_s);
    const double wn = mode.wn_rad_s;
    out.q.row(axis).head(known) +=
        t.xx * piece.state.row(at) + t.xv * piece.state.row(at + 1);
    out.rate.row(axis).head(known) +=
        wn * (t.vx * piece.state.row(at) + t.vv * piece.state.row(at + 1));
    for (std::size_t j = 0; j < integrals.size(); ++j) {
      const Transition back =
          transition(mode, offset_s - piece.length_s * piece.rule->nodes[j]);
      const double by = unit_N_ * wn / mode.k_N_mm * piece.length_s * integrals[j];
      const auto column =
          piece.first + static_cast<Index>(axis_of_[k] * integrals.size() + j);
      out.q(axis, column) += by * back.xv;
      out.rate(axis, column) += wn * by * back.vv;
    }
  }
  return out;
}

DelayMap::Rows DelayMap::rows_at(double time_s) const {
  const auto after = std::ranges::upper_bound(pieces_, time_s, {}, &Piece::begin_s);
  const Piece& piece = after == pieces_.begin() ? *after : *std::prev(after);
  return rows_at(piece, std::clamp(time_s - piece.begin_s, 0.0, piece.length_s));
}

DelayMap::Matrix DelayMap::between_axes(const Directional& h) const {
  Matrix out(axes_, axes_);
  const auto [x, y] = row_of_axis_;
  if (x >= 0) out(x, x) = h.xx;
  if (y >= 0) out(y, y) = h.yy;
  if (x >= 0 && y >= 0) {
    out(x, y) = h.xy;
    out(y, x) = h.yx;
  }
  return out / unit_N_;
}

// Eq. (2).
void DelayMap::assemble() {
  m0_ = Matrix::Identity(size_, size_);
  m1_ = Matrix::Zero(size_, size_);
  fed_ = VectorXd::Zero(size_);
  m1_.topRows(states_) = -last_;
  for (Index i = 0; i < states_; ++i) delayed_.push_back(i);
  const double least = 1e-12 * period_s_;
  for (const Piece& piece : pieces_) {
    if (!piece.rule) continue;
    const auto p = static_cast<Index>(piece.rule->size);
    for (Index node = 0; node < p; ++node) {
      const double offset =
          piece.length_s * piece.rule->nodes[static_cast<std::size_t>(node)];
      const double time = piece.begin_s + offset;
      const Load load = contact_.load(time * rad_s_);
      const Rows now = rows_at(piece, offset);
      Matrix here = between_axes(load.damping) * now.rate,
             before = Matrix::Zero(axes_, size_);
      bool reaches = false;
      for (std::size_t l = 0; l < load.regenerative.size(); ++l) {
        const Matrix h = between_axes(load.regenerative[l]);
        if (h.isZero(0)) continue;
        here += h * now.q;
        const double delay = contact_.delays_rad()[l] / rad_s_, then = time - delay;
        if (then >= 0) {
          here -= h * rows_at(then).q;
        } else {
          reaches = true;
          const double wrapped = then + period_s_;
          before -= h * (std::abs(wrapped - time) < least ? now.q : rows_at(wrapped).q);
        }
      }
      const std::array<double, 2> fed{load.fed_x_N / unit_N_, load.fed_y_N / unit_N_};
      for (std::size_t a = 0; a < 2; ++a) {
        if (row_of_axis_[a] < 0) continue;
        const Index row = piece.first + row_of_axis_[a] * p + node;
        m0_.row(row) += here.row(row_of_axis_[a]);
        m1_.row(row) = before.row(row_of_axis_[a]);
        fed_(row) = fed[a];
        if (reaches) delayed_.push_back(row);
      }
    }
  }
}

// Elimination of all unknowns, and the eigenvalues of the few that are delayed.
double DelayMap::work() const {
  const auto all = static_cast<double>(size_), few = static_cast<double>(delayed_.size());
  return all * all * few + 2 * all * few * few + 25 * few * few * few;
}

double DelayMap::work_near() const {
  const auto all = static_cast<double>(size_), few = static_cast<double>(delayed_.size());
  return all * all * few + 2 * all * few * few + 8 * few * few * few / 3;
}

DelayMap::Matrix DelayMap::inverse_columns() const {
  const auto few = static_cast<Index>(delayed_.size());
  Matrix out = Matrix::Zero(size_, few);
  for (Index i = 0; i < few; ++i) out(delayed_[static_cast<std::size_t>(i)], i) = 1;
  Index reached = states_;  // columns before it are not 0 so far
  for (const Piece& piece : pieces_) {
    if (!piece.rule) continue;
    const Index first = piece.first, size = axes_ * static_cast<Index>(piece.rule->size);
    const Index before = reached;
    while (reached < few && delayed_[static_cast<std::size_t>(reached)] < first + size)
      ++reached;
    out.block(first, 0, size, before) -=
        m0_.block(first, 0, size, first) * out.topLeftCorner(first, before);
    out.block(first, 0, size, reached) = m0_.block(first, first, size, size)
                                             .partialPivLu()
                                             .solve(out.block(first, 0, size, reached))
                                             .eval();
  }
  return out;
}

DelayMap::Matrix DelayMap::map() const {
  leave_if_asked();
  return -m1_(delayed_, Eigen::all) * inverse_columns();
}

std::vector<std::complex<double>> DelayMap::multipliers() const {
  constexpr double kNegligible = 1e-12;
  const auto all = eigenvalues(map());
  std::vector<std::complex<double>> out;
  for (const std::complex<double>& mu : all)
    if (std::abs(mu) > kNegligible) out.push_back(mu);
  std::ranges::sort(out, std::ranges::greater{}, [](auto mu) { return std::abs(mu); });
  return out;
}

std::complex<double> DelayMap::multiplier_near(std::complex<double> mu) const {
  constexpr int kIterations = 60;
  constexpr double kSettled = 1e-10;  // of the distance, which is far below 1
  Eigen::MatrixXcd shifted = map();
  shifted.diagonal().array() -= mu;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(shifted);
  Eigen::VectorXcd x = Eigen::VectorXcd::Ones(shifted.rows()).normalized();
  std::complex<double> before = 0;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::VectorXcd next = inverse.solve(x);
    const std::complex<double> largest = x.dot(next);
    if (std::abs(largest - before) <= kSettled * std::abs(largest))
      return mu + 1.0 / largest;
    x = next.normalized();
    before = largest;
  }
  const auto all = multipliers();  // several are equally near
  return *std::ranges::min_element(all, {}, [&](auto m) { return std::abs(m - mu); });
}

DelayMap::Forced DelayMap::forced() const {
  Forced out;
  out.map_ = this;
  out.x_ = (m0_ + m1_).partialPivLu().solve(fed_);
  return out;
}

std::array<double, 2> DelayMap::Forced::displacement_mm(double angle_rad) const {
  const double turns = std::floor(angle_rad / map_->contact_.period_rad());
  const Rows rows =
      map_->rows_at((angle_rad - turns * map_->contact_.period_rad()) / map_->rad_s_);
  const VectorXd q = rows.q * x_;
  std::array<double, 2> out{};
  for (std::size_t a = 0; a < 2; ++a)
    if (map_->row_of_axis_[a] >= 0) out[a] = q(map_->row_of_axis_[a]);
  return out;
}

}  // namespace turnwright::chatter
