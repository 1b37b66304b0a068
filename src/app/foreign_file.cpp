#include "foreign_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

#include "base/say.hpp"

namespace turnwright::app {
namespace {

std::string read_all(std::istream& in, const std::string& name, const ForeignFile& kind) {
  std::string bytes, block(1 << 20, '\0');
  while (in.read(block.data(), std::ssize(block)) || in.gcount() > 0) {
    bytes.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kind.most_bytes)
      throw InputError(name, {{"", say("more than {} bytes", kind.most_bytes),
                               tr(kind.small), "limit"}});
  }
  return bytes;
}

}  // namespace

std::string read_foreign_file(const std::string& file, const ForeignFile& kind) {
  if (file == "-") return read_all(std::cin, name_of_foreign_file(file), kind);
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(file, {{"", tr("nothing readable"), tr(kind.kinds), "file"}});
  return read_all(in, file, kind);
}

std::string name_of_foreign_file(const std::string& file) {
  return file == "-" ? tr("standard input") : file;
}

void rethrow_of_foreign_file(const InputError& error, const std::string& file) {
  auto problems = error.problems();
  const auto of_file = [](const Problem& p) {
    return p.pointer == "/text" || p.pointer == "/base64" || p.pointer.empty();
  };
  const bool all_of_file = std::all_of(problems.begin(), problems.end(), of_file);
  for (auto& p : problems) {
    if (of_file(p))
      p.pointer.clear();
    else
      p.pointer.replace(0, 1, "--");
  }
  throw InputError(all_of_file ? name_of_foreign_file(file) : tr("command line"),
                   std::move(problems));
}

}  // namespace turnwright::app
