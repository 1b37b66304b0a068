#include "turnwright/service/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace turnwright::service {
namespace {

using Digest = std::array<unsigned char, 32>;

Digest sha256(std::string_view bytes) {
  Digest digest{};
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(),
                 nullptr) != 1)
    throw std::runtime_error("sha256: the library refused");
  return digest;
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string hex;
  for (const auto byte : sha256(bytes)) {
    hex += kHex[byte >> 4];
    hex += kHex[byte & 15];
  }
  return hex;
}

std::string sha256_base64(std::string_view bytes) {
  const auto digest = sha256(bytes);
  std::array<unsigned char, 45> out{};  // 44 characters and the end that is written
  const int size = EVP_EncodeBlock(out.data(), digest.data(), digest.size());
  return {out.begin(), out.begin() + size};
}

}  // namespace turnwright::service
