#pragma once
#include <string>

namespace turnwright::exchange {

/// The name of a product, "" if it is the one that Open CASCADE writes for want of any:
/// "Open CASCADE STEP translator 7.6 1".
inline std::string given_name(std::string name) {
  return name.starts_with("Open CASCADE STEP translator") ? std::string() : name;
}

}  // namespace turnwright::exchange
