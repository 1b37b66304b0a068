#pragma once

namespace turnwright::app {

/// Exit codes of the program; `turnwright --help` says what they mean.
enum Exit {
  kOk = 0,
  kInfeasible = 1,
  kInput = 2,
  kRange = 3,
  kInternal = 70,
  kOutput = 74
};

}  // namespace turnwright::app
