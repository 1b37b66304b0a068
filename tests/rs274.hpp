#pragma once
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

/// LinuxCNC's interpreter for tests: TURNWRIGHT_RS274 names it (see scripts/rs274), else
/// one on the path is taken.
namespace turnwright::test {

/// What the command prints; "" if it fails.
inline std::string printed(const std::string& command) {
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (!pipe) return "";
  std::string out;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe))
    out.append(buffer.data(), n);
  return pclose(pipe) == 0 ? out : "";
}

/// In a folder of its own, gone with it; its home too, since all of a home share one
/// table of tools, run at once or not.  G54 is active, G55 at (1, 0, -2) inches.
/// The machine has a second spindle, of driven tools.
class Rs274 {
 public:
  Rs274() {
    const char* given = std::getenv("TURNWRIGHT_RS274");
    path_ = given ? given : printed("command -v rs274");
    while (path_.ends_with('\n')) path_.pop_back();
    std::string name =
        (std::filesystem::temp_directory_path() / "turnwright-rs274-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no folder for rs274");
    folder_ = name;
    std::ofstream(folder_ / "machine.ini") << "[TRAJ]\nSPINDLES = 2\n";
    std::ofstream parameters(folder_ / "rs274.var");
    for (int i = 5161; i <= 5390; ++i)
      parameters << i << ' ' << (i == 5220 || i == 5241 ? 1 : i == 5243 ? -2 : 0) << '\n';
  }
  ~Rs274() { std::filesystem::remove_all(folder_); }
  Rs274(const Rs274&) = delete;
  Rs274& operator=(const Rs274&) = delete;

  /// Its canonical calls; "" if it refuses the program.
  std::string canonical(const std::string& program, const std::string& tools) const {
    std::ofstream(folder_ / "program.ngc") << program;
    std::ofstream(folder_ / "tools.tbl") << tools;
    return printed("cd " + folder_.string() + " && HOME=$PWD " + path_ +
                   " -g -i machine.ini -v rs274.var -t tools.tbl program.ngc");
  }

 private:
  std::string path_;
  std::filesystem::path folder_;
};

}  // namespace turnwright::test
