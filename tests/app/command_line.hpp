#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "../temporary_folder.hpp"
#include "service/requests.hpp"

// Runs the program itself, as a shell would.
namespace turnwright::app {

namespace fs = std::filesystem;

inline std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// Each test has a folder of its own, which is also the working directory.
class CommandLine : public TemporaryFolder {
 protected:
  Outcome shell(const std::string& command, const fs::path& where) const {
    const fs::path program = TURNWRIGHT_PROGRAM;
    const std::string line = "cd '" + where.string() + "' && PATH='" +
                             program.parent_path().string() + "':\"$PATH\" && { " +
                             command + "\n} > '" + (folder_ / "out").string() + "' 2> '" +
                             (folder_ / "err").string() + "'";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "out"),
            contents(folder_ / "err")};
  }
  Outcome shell(const std::string& command) const { return shell(command, folder_); }

  const service::Request& row(const std::string& name) const {
    for (const auto& row : service::requests())
      if (row.name == name) return row;
    throw std::logic_error("no row " + name);
  }

  /// Names in the folder, but for the redirected streams.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const auto name = entry.path().filename().string();
      if (name != "out" && name != "err") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

}  // namespace turnwright::app
