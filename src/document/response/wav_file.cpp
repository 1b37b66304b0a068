#include "wav_file.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace turnwright::document {
namespace {

constexpr std::size_t kChunkHeader = 8, kFormat = 16, kExtended = 40;
constexpr std::uint32_t kPcm = 1, kFloat = 3, kExtensible = 0xfffe;

/// A whole number of a file, least byte first.
std::uint32_t word_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t out = 0;
  for (std::size_t i = size; i-- > 0;)
    out = out << 8 | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

class WavReader {
 public:
  WavReader(const Reader& at, std::string_view bytes) : at_(at), bytes_(bytes) {}

  WavFile read() {
    if (bytes_.size() < 12 || bytes_.substr(0, 4) != "RIFF" ||
        bytes_.substr(8, 4) != "WAVE")
      return wrong(0, "no RIFF header of WAVE", "a .wav file");
    for (std::size_t at = 12; at < bytes_.size();) {
      if (at + kChunkHeader > bytes_.size())
        return wrong(at, "the begin of a chunk", "its name and length");
      const std::size_t length = word_at(bytes_, at + 4, 4), body = at + kChunkHeader;
      const auto name = bytes_.substr(at, 4);
      if (length > bytes_.size() - body)
        return wrong(at,
                     "a chunk of " + std::to_string(length) + " bytes, " +
                         std::to_string(bytes_.size() - body) + " of them in the file",
                     "a file that is not cut off");
      if (name == "fmt " && !read_format(body, length)) return {};
      if (name == "data") {
        if (width_ == 0) return wrong(at, "data before fmt", "fmt before data");
        return read_data(body, length);
      }
      at = body + length + length % 2;
    }
    return wrong(bytes_.size(), "no chunk \"data\"", "samples");
  }

 private:
  WavFile wrong(std::size_t byte, const std::string& got, const std::string& expected) {
    at_.problems().add(
        {at_.pointer(), "byte " + std::to_string(byte) + ": " + got, expected, "format"});
    return {};
  }

  bool read_format(std::size_t at, std::size_t length) {
    if (length < kFormat)
      return refused(at, "a fmt of " + std::to_string(length) + " bytes",
                     "16 bytes or more");
    std::uint32_t kind = word_at(bytes_, at, 2);
    if (kind == kExtensible && length >= kExtended) kind = word_at(bytes_, at + 24, 2);
    const std::uint32_t channels = word_at(bytes_, at + 2, 2),
                        rate = word_at(bytes_, at + 4, 4),
                        frame = word_at(bytes_, at + 12, 2),
                        bits = word_at(bytes_, at + 14, 2);
    const bool known = (kind == kPcm && (bits == 16 || bits == 24 || bits == 32)) ||
                       (kind == kFloat && bits == 32);
    if (!known)
      return refused(
          at, "format " + std::to_string(kind) + " of " + std::to_string(bits) + " bits",
          "PCM of 16, 24 or 32 bits, or floating point of 32");
    if (channels < 1 || channels > 2)
      return refused(at + 2, std::to_string(channels) + " channels", "one or two");
    if (rate < 1000 || rate > 400'000)
      return refused(at + 4, std::to_string(rate) + " samples a second",
                     "1000 to 400000");
    if (frame != channels * bits / 8)
      return refused(at + 12, std::to_string(frame) + " bytes a sample of all channels",
                     std::to_string(channels * bits / 8));
    width_ = bits / 8;
    out_.rate_Hz = rate;
    out_.bits = static_cast<int>(bits);
    out_.floating = kind == kFloat;
    out_.channels.resize(channels);
    return true;
  }

  bool refused(std::size_t byte, const std::string& got, const std::string& expected) {
    wrong(byte, got, expected);
    return false;
  }

  WavFile read_data(std::size_t at, std::size_t length) {
    const std::size_t frame = width_ * out_.channels.size(), count = length / frame;
    if (length % frame != 0)
      return wrong(at, std::to_string(length) + " bytes of samples",
                   "a multiple of " + std::to_string(frame));
    if (count > kWavSamples)
      return wrong(at, std::to_string(count) + " samples a channel",
                   "at most " + std::to_string(kWavSamples));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < out_.channels.size(); ++c) {
        const std::size_t byte = at + i * frame + c * width_;
        const double x = sample(byte);
        if (!std::isfinite(x))
          return wrong(byte, "a sample that is no number", "numbers");
        out_.channels[c].push_back(x);
      }
    return std::move(out_);
  }

  double sample(std::size_t byte) const {
    const std::uint32_t word = word_at(bytes_, byte, width_);
    if (out_.floating) return std::bit_cast<float>(word);
    constexpr double kFull = 2147483648.0;  // of 32 bits
    return static_cast<std::int32_t>(word << (32 - 8 * width_)) / kFull;
  }

  const Reader& at_;
  std::string_view bytes_;
  std::size_t width_ = 0;  // bytes of a sample of one channel
  WavFile out_;
};

}  // namespace

WavFile read_wav(const Reader& at, std::string_view bytes) {
  return WavReader(at, bytes).read();
}

}  // namespace turnwright::document
