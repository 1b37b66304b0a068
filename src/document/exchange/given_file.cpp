#include "given_file.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

std::string decoded(const Reader& r, const std::string& what) {
  auto text = r.json().get<std::string>();
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  const auto pads = static_cast<std::size_t>(std::count(
      text.end() - std::min<std::ptrdiff_t>(2, std::ssize(text)), text.end(), '='));
  std::string out(text.size() / 4 * 3, '\0');
  const int written = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                                      reinterpret_cast<const unsigned char*>(text.data()),
                                      static_cast<int>(text.size()));
  if (written < 0 || text.empty()) {
    r.problem(say("base64 (RFC 4648) of the {}'s bytes", tr(what)), "format");
    return {};
  }
  out.resize(static_cast<std::size_t>(written) - pads);
  return out;
}

}  // namespace

GivenFile read_given_file(Reader& r, const std::string& what, std::size_t most_bytes) {
  const bool text = r.has("text"), base64 = r.has("base64");
  if (text == base64) {
    r.problem(text ? tr("text and base64") : say("no {}", tr(what)),
              say("\"text\" with the {}, or \"base64\" with its bytes", tr(what)),
              "conflict");
    r.find("text");
    r.find("base64");
    return {};
  }
  const Reader at = text ? r.at("text") : r.at("base64");
  const std::string as_given = at.as_text(most_bytes);
  if (as_given.empty()) return {};
  return {text ? as_given : decoded(at, what), at.pointer()};
}

std::string read_base64(const Reader& at, const std::string& what,
                        std::size_t most_bytes) {
  return at.as_text(most_bytes).empty() ? "" : decoded(at, what);
}

std::string base64_of(const std::string& bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

void rethrow_at(const InputError& error, const std::string& document,
                const std::string& pointer) {
  Problems problems{.document = document};
  for (auto p : error.problems()) {
    if (!p.pointer.empty()) p.got = p.pointer + ": " + p.got;
    p.pointer = pointer;
    problems.add(std::move(p));
  }
  problems.throw_if_any();
  throw error;
}

}  // namespace turnwright::document
