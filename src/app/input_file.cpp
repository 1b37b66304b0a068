#include "input_file.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "turnwright/base/errors.hpp"

namespace turnwright::app {
namespace {

std::string read_all(std::istream& in, const std::string& name, std::size_t most,
                     const std::string& what) {
  std::string bytes, block(1 << 20, '\0');
  while (in.read(block.data(), std::ssize(block)) || in.gcount() > 0) {
    bytes.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > most)
      throw InputError(name, {{"", "more than " + std::to_string(most) + " bytes",
                               what + " of at most so many", "limit"}});
  }
  return bytes;
}

}  // namespace

std::string bytes_of(const std::string& file, std::size_t most, const std::string& what) {
  if (file == "-") return read_all(std::cin, name_of(file), most, what);
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(file, {{"", "nothing readable", what, "file"}});
  return read_all(in, file, most, what);
}

std::string name_of(const std::string& file) {
  return file == "-" ? "standard input" : file;
}

}  // namespace turnwright::app
