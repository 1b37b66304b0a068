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

constexpr double kAlike = 1e-13;  // of a piece's length: times so near count as one

/// A matrix with the eigenvalues of A but for those that are 0 to within rounding.  With the
/// residuals' largest columns as pivots A = Q R, where R has as many rows as A has rank; the
/// eigenvalues are those of R Q.
Eigen::MatrixXd of_full_rank(Eigen::MatrixXd a) {
  constexpr double kLost = 1e-14;  // of |A|; an eigenvalue's own error is no smaller
  constexpr Index kSmall = 50;     // eigenvalues of so few rows are found as soon
  const Index n = a.rows();
  if (n <= kSmall) return a;
  const double least = kLost * a.norm();
  Eigen::MatrixXd rest = a, q(n, n);
  Index rank = 0;
  for (; rank < n && rest.norm() > least; ++rank) {
    Index pivot = 0;
    rest.colwise().squaredNorm().maxCoeff(&pivot);
    VectorXd next = rest.col(pivot).normalized();
    const auto known = q.leftCols(rank);
    next -= known * (known.transpose() * next);  // again, for rounding
    q.col(rank) = next.normalized();
    const Eigen::RowVectorXd along = q.col(rank).transpose() * rest;
    rest.noalias() -= q.col(rank) * along;
  }
  constexpr double kWorthIt = 0.8;
  if (static_cast<double>(rank) > kWorthIt * static_cast<double>(n)) return a;
  // Q R is A less its rest, so that R = Q' A.
  return of_full_rank(q.leftCols(rank).transpose() * a * q.leftCols(rank));
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
  for (Piece& piece : pieces_) connect(piece);
  fed_ = VectorXd::Zero(size_);
  for (Index i = 0; i < states_; ++i) delayed_.push_back(i);
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (pieces_[i].rule) assemble(i);
  node_rows_.clear();
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
    leave_if_asked();
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
    leave_if_asked();
    const double begin = breaks[i] / rad_s_, length = breaks[i + 1] / rad_s_ - begin;
    if (!contact_.cuts((breaks[i] + breaks[i + 1]) / 2)) {
      pieces_.emplace_back();
      pieces_.back().begin_s = begin;
      pieces_.back().length_s = length;
      continue;
    }
    const double turned = longest[i + 1] / rad_s_ * turns / 2,
                 parts = std::ceil(turned / fineness.phase_rad);
    const std::size_t nodes = nodes_for(turned / parts, fineness.error);
    for (double k = 0; k < parts; ++k) {
      Piece& piece = pieces_.emplace_back();
      piece.begin_s = begin + length * k / parts;
      piece.length_s = length / parts;
      piece.rule = &quadrature(nodes);
      piece.first = size_;
      piece.size = axes_ * static_cast<Index>(nodes);
      size_ += piece.size;
      if (size_ > kMostUnknowns)
        throw TooManyVibrations(
            tr("milling: a period of this cutter holds too many vibrations; ask for a "
               "higher speed or a smaller depth"));
    }
  }
}

void DelayMap::connect(Piece& piece) const {
  piece.to_end = Matrix::Zero(states_, states_);
  piece.push = Matrix::Zero(states_, piece.size);
  for (std::size_t k = 0; k < cutter_.system.modes.size(); ++k) {
    const Mode& mode = cutter_.system.modes[k];
    const auto at = static_cast<Index>(2 * k);
    const Transition t = transition(mode, piece.length_s);
    piece.to_end.block<2, 2>(at, at) << t.xx, t.xv, t.vx, t.vv;
    if (!piece.rule) continue;
    const std::size_t p = piece.rule->size;
    for (std::size_t j = 0; j < p; ++j) {
      const Transition to_end =
          transition(mode, piece.length_s * (1 - piece.rule->nodes[j]));
      const double by =
          unit_N_ * mode.wn_rad_s / mode.k_N_mm * piece.length_s * piece.rule->weights[j];
      const auto column = static_cast<Index>(axis_of_[k] * p + j);
      piece.push(at, column) = by * to_end.xv;
      piece.push(at + 1, column) = by * to_end.vv;
    }
  }
}

DelayMap::Rows DelayMap::rows_at(const Piece& piece, double offset_s,
                                 bool with_rate) const {
  Rows out{Matrix::Zero(axes_, states_), Matrix::Zero(axes_, piece.size), {}, {}};
  if (with_rate) {
    out.rate_by_state = Matrix::Zero(axes_, states_);
    out.rate_by_force = Matrix::Zero(axes_, piece.size);
  }
  std::vector<double> integrals;
  if (piece.rule)
    integrals =
        integrals_to(*piece.rule, std::clamp(offset_s / piece.length_s, 0.0, 1.0));
  for (std::size_t k = 0; k < cutter_.system.modes.size(); ++k) {
    const Mode& mode = cutter_.system.modes[k];
    const auto at = static_cast<Index>(2 * k), axis = static_cast<Index>(axis_of_[k]);
    const Transition t = transition(mode, offset_s);
    const double wn = mode.wn_rad_s;
    out.by_state(axis, at) = t.xx;
    out.by_state(axis, at + 1) = t.xv;
    if (with_rate) {
      out.rate_by_state(axis, at) = wn * t.vx;
      out.rate_by_state(axis, at + 1) = wn * t.vv;
    }
    for (std::size_t j = 0; j < integrals.size(); ++j) {
      const Transition back =
          transition(mode, offset_s - piece.length_s * piece.rule->nodes[j]);
      const double by = unit_N_ * wn / mode.k_N_mm * piece.length_s * integrals[j];
      const auto column = static_cast<Index>(axis_of_[k] * integrals.size() + j);
      out.by_force(axis, column) += by * back.xv;
      if (with_rate) out.rate_by_force(axis, column) += wn * by * back.vv;
    }
  }
  return out;
}

const std::vector<DelayMap::Rows>& DelayMap::rows_at_nodes(const Piece& piece) {
  for (const NodeRows& known : node_rows_)
    if (known.rule == piece.rule &&
        std::abs(known.length_s - piece.length_s) <= kAlike * piece.length_s)
      return known.rows;
  NodeRows made{piece.length_s, piece.rule, {}};
  for (const double s : piece.rule->nodes)
    made.rows.push_back(rows_at(piece, piece.length_s * s, cutter_.indentation_N_mm > 0));
  node_rows_.push_back(std::move(made));
  return node_rows_.back().rows;
}

std::size_t DelayMap::piece_at(double time_s) const {
  const auto after = std::ranges::upper_bound(pieces_, time_s, {}, &Piece::begin_s);
  return after == pieces_.begin() ? 0
                                  : static_cast<std::size_t>(after - pieces_.begin()) - 1;
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
void DelayMap::assemble(std::size_t at) {
  Piece& piece = pieces_[at];
  const auto p = static_cast<Index>(piece.rule->size);
  const double least = 1e-12 * period_s_;
  Matrix own = Matrix::Identity(piece.size, piece.size);
  piece.by_state = Matrix::Zero(piece.size, states_);
  const auto link = [&](std::vector<Link>& links, std::size_t to) -> Link& {
    const auto known = std::ranges::find(links, to, &Link::piece);
    if (known != links.end()) return *known;
    return links.emplace_back(Link{to, Matrix::Zero(piece.size, states_),
                                   Matrix::Zero(piece.size, pieces_[to].size)});
  };
  for (Index node = 0; node < p; ++node) {
    // Rows of the axes at this node.
    const auto add = [&](Matrix& to, const Matrix& h, const Matrix& rows) {
      to(Eigen::seqN(node, axes_, p), Eigen::all) += h * rows;
    };
    const double offset =
        piece.length_s * piece.rule->nodes[static_cast<std::size_t>(node)];
    const double time = piece.begin_s + offset;
    const Load load = contact_.load(time * rad_s_);
    const Matrix damping = between_axes(load.damping);
    const auto i = static_cast<std::size_t>(node);
    const Rows now = rows_at_nodes(piece)[i];
    if (!damping.isZero(0)) {
      add(own, damping, now.rate_by_force);
      add(piece.by_state, damping, now.rate_by_state);
    }
    bool reaches = false;
    for (std::size_t l = 0; l < load.regenerative.size(); ++l) {
      const Matrix h = between_axes(load.regenerative[l]);
      if (h.isZero(0)) continue;
      add(own, h, now.by_force);
      add(piece.by_state, h, now.by_state);
      double then = time - contact_.delays_rad()[l] / rad_s_;
      const bool wraps = then < 0;
      reaches = reaches || wraps;
      if (wraps) then += period_s_;
      if (std::abs(then - time) < least) then = time;
      const std::size_t to = piece_at(then);
      const Piece& past = pieces_[to];
      const double since = std::clamp(then - past.begin_s, 0.0, past.length_s);
      const bool at_node = past.rule == piece.rule &&
                           std::abs(since - past.length_s * piece.rule->nodes[i]) <=
                               kAlike * past.length_s;
      const Rows delayed = at_node ? rows_at_nodes(past)[i] : rows_at(past, since, false);
      if (!wraps && to == at) {
        add(own, -h, delayed.by_force);
        add(piece.by_state, -h, delayed.by_state);
        continue;
      }
      Link& from = link(wraps ? piece.before : piece.earlier, to);
      add(from.by_force, h, delayed.by_force);
      add(from.by_state, h, delayed.by_state);
    }
    const std::array<double, 2> fed{load.fed_x_N / unit_N_, load.fed_y_N / unit_N_};
    for (std::size_t a = 0; a < 2; ++a) {
      if (row_of_axis_[a] < 0) continue;
      const Index row = piece.first + row_of_axis_[a] * p + node;
      fed_(row) = fed[a];
      if (reaches) delayed_.push_back(row);
    }
  }
  piece.own.compute(own);
}

double DelayMap::work_of_map() const {
  const auto few = static_cast<double>(delayed_.size());
  double all = 0;
  for (const Piece& piece : pieces_) {
    double each = static_cast<double>(2 * states_ + 2 * piece.size);
    for (const auto* links : {&piece.earlier, &piece.before})
      for (const Link& link : *links)
        each += static_cast<double>(states_ + link.by_force.cols());
    all += static_cast<double>(piece.size) * each;
  }
  return all * few;
}

// Elimination of all unknowns, and the eigenvalues of the few that are delayed.
double DelayMap::work() const {
  const auto few = static_cast<double>(delayed_.size());
  return work_of_map() + 25 * few * few * few;
}

double DelayMap::work_near() const {
  const auto few = static_cast<double>(delayed_.size());
  return work_of_map() + 8 * few * few * few / 3;
}

template <class Columns>
DelayMap::Motion DelayMap::follow(const Matrix& right, Columns columns) const {
  Motion out{.states = {}, .end = right.topRows(states_), .forces = right};
  for (const Piece& piece : pieces_) {
    out.states.push_back(out.end);
    const Matrix& state = out.states.back();
    out.end = piece.to_end * state;
    if (!piece.rule) continue;
    const Index some = columns(piece.first + piece.size);
    auto forces = out.forces.block(piece.first, 0, piece.size, some);
    forces.noalias() -= piece.by_state * state.leftCols(some);
    for (const Link& link : piece.earlier) {
      const Piece& from = pieces_[link.piece];
      forces.noalias() += link.by_state * out.states[link.piece].leftCols(some);
      forces.noalias() +=
          link.by_force * out.forces.block(from.first, 0, from.size, some);
    }
    forces = piece.own.solve(forces).eval();
    out.end.leftCols(some).noalias() += piece.push * forces;
  }
  return out;
}

DelayMap::Matrix DelayMap::handed_on(const Motion& motion) const {
  Matrix out(size_, motion.end.cols());
  out.topRows(states_) = motion.end;
  for (const Piece& piece : pieces_) {
    if (!piece.rule) continue;
    auto rows = out.middleRows(piece.first, piece.size);
    rows.setZero();
    for (const Link& link : piece.before) {
      const Piece& from = pieces_[link.piece];
      rows.noalias() += link.by_state * motion.states[link.piece];
      rows.noalias() += link.by_force * motion.forces.middleRows(from.first, from.size);
    }
  }
  return out(delayed_, Eigen::all);
}

DelayMap::Matrix DelayMap::units() const {
  const auto few = static_cast<Index>(delayed_.size());
  Matrix out = Matrix::Zero(size_, few);
  for (Index i = 0; i < few; ++i) out(delayed_[static_cast<std::size_t>(i)], i) = 1;
  return out;
}

DelayMap::Matrix DelayMap::map() const {
  leave_if_asked();
  return handed_on(follow(units(), [&](Index end) {
    return static_cast<Index>(
        std::ranges::count_if(delayed_, [&](Index row) { return row < end; }));
  }));
}

std::vector<std::complex<double>> DelayMap::multipliers() const {
  constexpr double kNegligible = 1e-12;
  const auto all = eigenvalues(of_full_rank(map()));
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

// With z = 1: M_0 x = fed + E_W r, where r = -M_1,W x is what x hands on.
DelayMap::Forced DelayMap::forced() const {
  const auto all = [](Index) { return Index{1}; };
  const Matrix own = handed_on(follow(fed_, all)), map = this->map();
  const Matrix r =
      (Matrix::Identity(map.rows(), map.cols()) - map).partialPivLu().solve(own);
  Forced out;
  out.map_ = this;
  out.motion_ = follow(fed_ + units() * r, all);
  return out;
}

std::array<double, 2> DelayMap::Forced::displacement_mm(double angle_rad) const {
  const double turns = std::floor(angle_rad / map_->contact_.period_rad());
  const double time = (angle_rad - turns * map_->contact_.period_rad()) / map_->rad_s_;
  const std::size_t at = map_->piece_at(time);
  const Piece& piece = map_->pieces_[at];
  const Rows rows =
      map_->rows_at(piece, std::clamp(time - piece.begin_s, 0.0, piece.length_s), false);
  const VectorXd q = rows.by_state * motion_.states[at] +
                     rows.by_force * motion_.forces.middleRows(piece.first, piece.size);
  std::array<double, 2> out{};
  for (std::size_t a = 0; a < 2; ++a)
    if (map_->row_of_axis_[a] >= 0) out[a] = q(map_->row_of_axis_[a]);
  return out;
}

}  // namespace turnwright::chatter
