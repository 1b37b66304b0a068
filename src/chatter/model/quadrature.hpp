#pragma once
#include <vector>

namespace turnwright::chatter {

/// Gauss-Legendre nodes s_i on [0, 1] with their weights, and the integrals from 0 to
/// each node of the polynomial through all of them:
///
///     int_0^1 f ds = sum_j weights[j] f(s_j)
///     int_0^s_i f ds = sum_j to_node[i * size + j] f(s_j)
///
/// exact for polynomials of degree 2 size - 1 and size - 1.
struct Quadrature {
  std::size_t size = 0;
  std::vector<double> nodes, weights, to_node;
  std::vector<double> legendre;  ///< P_k(2 s_j - 1), [j size + k]
};

/// @param size  from 2 to 40.
const Quadrature& quadrature(std::size_t size);

/// The integrals from 0 to s of the polynomials that are 1 at one node and 0 at the
/// others: int_0^s f = sum_j out[j] f(s_j), as above.
std::vector<double> integrals_to(const Quadrature& rule, double s);

}  // namespace turnwright::chatter
