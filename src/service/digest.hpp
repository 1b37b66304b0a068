#pragma once
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's EVP_MD_CTX

namespace turnwright::service {

/// SHA-256 of bytes that are added piece by piece.  Source: FIPS 180-4.
class Sha256 {
 public:
  Sha256();
  void update(std::string_view bytes);
  /// The digest of all bytes as 64 lower-case hexadecimal digits; nothing may be added
  /// then.
  std::string hex();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> state_;
};

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

/// The same in base64 (RFC 4648, section 4).
std::string sha256_base64(std::string_view bytes);

}  // namespace turnwright::service
