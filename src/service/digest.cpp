#include "digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace turnwright::service {
namespace {

using Digest = std::array<unsigned char, 32>;

void require(int done) {
  if (done != 1) throw std::runtime_error("sha256: the library refused");
}

Digest sha256(std::string_view bytes) {
  Digest digest{};
  require(EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(),
                     nullptr));
  return digest;
}

std::string hex_of(const Digest& digest) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string hex;
  for (const auto byte : digest) {
    hex += kHex[byte >> 4];
    hex += kHex[byte & 15];
  }
  return hex;
}

}  // namespace

Sha256::Sha256() : state_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
  require(EVP_DigestInit_ex(state_.get(), EVP_sha256(), nullptr));
}

void Sha256::update(std::string_view bytes) {
  require(EVP_DigestUpdate(state_.get(), bytes.data(), bytes.size()));
}

std::string Sha256::hex() {
  Digest digest{};
  require(EVP_DigestFinal_ex(state_.get(), digest.data(), nullptr));
  return hex_of(digest);
}

std::string sha256_hex(std::string_view bytes) { return hex_of(sha256(bytes)); }

std::string sha256_base64(std::string_view bytes) {
  const auto digest = sha256(bytes);
  std::array<unsigned char, 45> out{};  // 44 characters and the end that is written
  const int size = EVP_EncodeBlock(out.data(), digest.data(), digest.size());
  return {out.begin(), out.begin() + size};
}

}  // namespace turnwright::service
