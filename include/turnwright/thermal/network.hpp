#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// A small neural network for thermal drift, for comparison with the lag model.
namespace turnwright::thermal {

/// The inputs of the published model: spindle speed [1/min], feed [mm/min], operation
/// time [s], ambient temperature [degC].
inline constexpr std::size_t kInputs = 4;
using Row = std::array<double, kInputs>;

struct NetworkOptions {
  std::size_t hidden = 6;     ///< neurons; more fit more closely and extrapolate worse
  std::uint64_t seed = 1;     ///< of the initial weights
  double decay = 1e-3;        ///< penalty on the squared weights; larger is smoother
  std::size_t starts = 4;     ///< number of trainings, of which the best is kept
  int max_evaluations = 600;  ///< of one training
};

/// A network with one hidden layer on standardised inputs z_i = (x_i - m_i)/s_i.  An
/// input that does not vary, s_i = 0, is omitted (z_i = 0):
///
///     e = m_e + s_e (v_0 + sum_h v_h tanh(w_h0 + sum_i w_hi z_i)) (9)
struct Network {
  std::size_t hidden = 0;
  Row mean{}, scale{};
  double error_mean_um = 0, error_scale_um = 1;
  std::vector<double> weights = {};  ///< (w_h0, w_h1 .. w_h4, v_h) for each h, then v_0
  double rms_um = 0;                 ///< of the rows trained on
  Row least{}, largest{};            ///< of the rows trained on
  std::vector<Row> hull = {};        ///< their outermost rows
};

/// Trains a network: its weights minimise
///
///     1/2 mean((e - e_i)^2)/s_e^2 + decay/2 mean(w^2) (10)
///
/// by SLSQP, a dense quasi-Newton method suitable for few weights, with the gradient by
/// the chain rule, from `starts` sets of random weights.  The same seed gives the same
/// network.
///
/// Source: derived here; the inputs are those of [Valino 2008], section II.B.
/// @throws std::domain_error if rows and errors differ in number or there are none, or
///   without hidden neurons or starts.
Network train(std::span<const Row> rows, std::span<const double> error_um,
              const NetworkOptions& options = {});

double drift_um(const Network& network, const Row& row);

/// Whether a row is an extrapolation, for which the network gives no reliable value.
enum class Reach {
  inside,        ///< in the convex hull of the rows trained on
  between_rows,  ///< each input is in its range, but the combination is outside the hull
  outside,       ///< an input is outside its range
};

/// Decides by the ranges and then by the convex hull of the outermost rows.  These are
/// found along a fixed set of directions, so their hull is never larger than the true
/// one.
Reach reach(const Network& network, const Row& row);

}  // namespace turnwright::thermal
