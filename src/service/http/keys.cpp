#include "keys.hpp"

#include <openssl/crypto.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <fstream>

#include "base/say.hpp"
#include "server.hpp"
#include "service/digest.hpp"

namespace turnwright::service {
namespace {

bool is_key(const std::string& line) {
  return line.size() >= 16 && line.size() <= 200 &&
         std::all_of(line.begin(), line.end(),
                     [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

std::vector<std::string> read_keys(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file))
    throw InputError(file.string(),
                     {{"", tr("no regular file"), tr("a file of keys"), "file"}});
  std::ifstream in(file);
  if (!in)
    throw InputError(file.string(),
                     {{"", tr("nothing readable"), tr("a file of keys"), "file"}});
  std::vector<std::string> keys;
  std::vector<Problem> problems;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    if (is_key(line))
      keys.push_back(line);
    else  // a key is not shown
      problems.push_back({say("line {}", number), say("{} bytes", line.size()),
                          tr("16 to 200 visible ASCII characters"), "range"});
  }
  if (keys.empty() && problems.empty())
    problems.push_back({"", tr("no key"), tr("at least one"), "missing"});
  if (!problems.empty()) throw InputError(file.string(), problems);
  return keys;
}

// Digests have one length, so that comparing them tells nothing of the keys'.
bool authorized(const std::vector<std::string>& keys, std::string_view authorization) {
  constexpr std::string_view kScheme = "Bearer ";
  const bool scheme = boost::algorithm::istarts_with(authorization, kScheme);
  const auto given =
      sha256_hex(authorization.substr(std::min(kScheme.size(), authorization.size())));
  bool found = false;
  for (const auto& key : keys) {
    const auto wanted = sha256_hex(key);
    found |= CRYPTO_memcmp(wanted.data(), given.data(), wanted.size()) == 0;
  }
  return scheme && found;
}

}  // namespace turnwright::service
