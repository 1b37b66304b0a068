#pragma once
#include <span>
#include <vector>

#include "turnwright/part/shaft.hpp"

namespace turnwright::deflection {

/// Length by which a thin section of diameter d is extended into a thick one of diameter
/// D, in units of d.  The corner of a shoulder carries no stress, so the thick section is
/// softer near the shoulder than a beam of its diameter.
///
///     d/D     0.85   0.7    0.6    0.5   0.4   0.3
///     lambda  0.035  0.105  0.145  0.17  0.19  0.205
///
/// Linear between these values, constant beyond them, 0 for d = D.  Against
/// three-dimensional elasticity plain beam theory is wrong by up to 21 % at shoulders,
/// with this correction by 3 % at most (ten stepped cantilevers in shoulder_test: 18 %
/// and 2.1 %).
/// Source: handbook values, fitted to solid steps.
/// @throws std::domain_error unless 0 < d/D <= 1.
double shoulder_lambda(double d_over_D);

/// The segments with every thin section, of its outer and inner diameter at the step,
/// extended by lambda d into the thick one, but at most to the next step or to where the
/// thick section ceases to be thicker.  Where two extensions meet the thinner one counts.
/// Nothing is changed at z = 0, where the jaws are.
std::vector<part::Segment> shoulder_corrected(std::span<const part::Segment> segments);

}  // namespace turnwright::deflection
