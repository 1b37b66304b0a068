#pragma once
#include <span>
#include <vector>

#include "turnwright/part/shaft.hpp"

namespace turnwright::deflection {

/// How far a thin section of diameter d reaches into a thick one of diameter D, in parts
/// of d: the corner of a shoulder carries no stress, so the thick part is softer near it
/// than its section says.
///
///     d/D     0.85   0.7    0.6    0.5   0.4   0.3
///     lambda  0.035  0.105  0.145  0.17  0.19  0.205
///
/// Linear between, held at the ends, 0 for d = D.  Plain beam theory is off by up to 21 %
/// at shoulders, with this by 3 % at most, against three-dimensional elasticity (ten
/// stepped cantilevers in shoulder_test: 18 % and 2.1 %).
/// Source: handbook values, fitted to solid steps.
/// @throws std::domain_error unless 0 < d/D <= 1.
double shoulder_lambda(double d_over_D);

/// The segments with every thin section (its outer and inner diameter at the step)
/// extended by lambda d into the thick one, at most to where that stops being thicker or
/// steps again.  Where two extensions meet the thinner one stands.  Nothing happens at
/// z = 0, where the jaws are.
std::vector<part::Segment> shoulder_corrected(std::span<const part::Segment> segments);

}  // namespace turnwright::deflection
