#pragma once
#include <string>
#include <vector>

#include "turnwright/exchange/outline.hpp"
#include "turnwright/exchange/part21.hpp"
#include "turnwright/exchange/step.hpp"

namespace turnwright::exchange {

/// A face of a body; `outward` if its normal, the surface's unless same_sense is false,
/// points out of the material.
struct FaceUse {
  Instance face;
  bool outward = true;
};

/// One solid of a file, or the faces of a shell.
struct Body {
  std::string name;  ///< of the product, else of the solid; "" if they have none
  double mm = 1;     ///< length of its unit
  double rad = 1;    ///< angle of its unit
  std::vector<FaceUse> faces;
  std::vector<Remark> assumed;
};

/// @throws InputError as read_step.
Body step_body(const Exchange& file, const StepOptions& options);

}  // namespace turnwright::exchange
