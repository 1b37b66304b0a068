#pragma once
#include <complex>
#include <span>
#include <vector>

namespace turnwright::chatter {

/// Sizes of the errors of a response, to a common factor, by its ordinary coherence g:
///
///     s^2 = N + (0.003 |Y|)^2 + (0.001 max |Y|)^2
///
/// with N the mean of |Y|^2 (1 - g)/g, the power of the motion that the force does not
/// explain over that of the force, over nine neighbouring lines, because the coherence of
/// few averages scatters.  The two shares stand for what coherence does not see.
/// Valid for g in (0, 1].  Source: [Bendat 2010] for N, derived here again; the shares are
/// chosen here.
std::vector<double> errors_by_coherence(std::span<const std::complex<double>> value,
                                        std::span<const double> coherence);

}  // namespace turnwright::chatter
