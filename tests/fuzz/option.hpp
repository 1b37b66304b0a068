#pragma once
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

namespace turnwright::fuzz {

/// The value of --NAME=.. among the arguments; libFuzzer passes over what begins with two
/// dashes.  Ends the program without it.
inline std::string option(int argc, char** argv, std::string_view name) {
  const std::string start = "--" + std::string(name) + "=";
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]).starts_with(start)) return argv[i] + start.size();
  std::cerr << "give " << start << "..\n";
  std::exit(2);
}

}  // namespace turnwright::fuzz
