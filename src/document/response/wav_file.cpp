#include "wav_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kChunkHeader = 8, kFormat = 16, kExtended = 40;
constexpr std::size_t kUnknownLength = 0x7ffff000;  // and more, of data in a pipe
constexpr std::uint32_t kPcm = 1, kFloat = 3, kExtensible = 0xfffe;

/// A whole number of a file, least byte first.
std::uint64_t word_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t out = 0;
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
      return wrong(0, tr("no RIFF header of WAVE"), tr("a .wav file"));
    for (std::size_t at = 12; at < bytes_.size();) {
      if (at + kChunkHeader > bytes_.size())
        return wrong(at, tr("the begin of a chunk"), tr("its name and length"));
      const std::size_t body = at + kChunkHeader, rest = bytes_.size() - body;
      const auto name = bytes_.substr(at, 4);
      std::size_t length = word_at(bytes_, at + 4, 4);
      if (name == "data" && length > rest && length >= kUnknownLength)
        length = rest - rest % frame();
      if (length > rest)
        return wrong(at, say("a chunk of {} bytes, {} of them in the file", length, rest),
                     tr("a file that is not cut off"));
      if (name == "fmt " && !read_format(body, length)) return {};
      if (name == "data") {
        if (width_ == 0) return wrong(at, tr("data before fmt"), tr("fmt before data"));
        return read_data(body, length);
      }
      at = body + length + length % 2;
    }
    return wrong(bytes_.size(), tr("no chunk \"data\""), "samples");
  }

 private:
  WavFile wrong(std::size_t byte, const std::string& got, const std::string& expected) {
    at_.problems().add(
        {at_.pointer(), say("byte {}: {}", byte, got), expected, "format"});
    return {};
  }

  bool read_format(std::size_t at, std::size_t length) {
    if (length < kFormat)
      return refused(at, say("a fmt of {} bytes", length), tr("16 bytes or more"));
    std::uint64_t kind = word_at(bytes_, at, 2);
    if (kind == kExtensible && length >= kExtended) kind = word_at(bytes_, at + 24, 2);
    const std::uint64_t channels = word_at(bytes_, at + 2, 2),
                        rate = word_at(bytes_, at + 4, 4),
                        frame = word_at(bytes_, at + 12, 2),
                        bits = word_at(bytes_, at + 14, 2);
    const bool known =
        (kind == kPcm && (bits == 8 || bits == 16 || bits == 24 || bits == 32)) ||
        (kind == kFloat && (bits == 32 || bits == 64));
    if (!known)
      return refused(at, say("format {} of {} bits", kind, bits),
                     tr("PCM of 8, 16, 24 or 32 bits, or floating point of 32 or 64"));
    if (channels < 1 || channels > 2)
      return refused(at + 2, say("{} channels", channels), tr("one or two"));
    if (rate < 1000 || rate > 400'000)
      return refused(at + 4, say("{} samples a second", rate), tr("1000 to 400000"));
    if (frame != channels * bits / 8)
      return refused(at + 12, say("{} bytes a sample of all channels", frame),
                     std::to_string(channels * bits / 8));
    width_ = bits / 8;
    out_.rate_Hz = static_cast<double>(rate);
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
    const std::size_t count = length / frame();
    if (length % frame() != 0)
      return wrong(at, say("{} bytes of samples", length),
                   say("a multiple of {}", frame()));
    if (count > kWavSamples)
      return wrong(at, say("{} samples a channel", count),
                   say("at most {}", kWavSamples));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < out_.channels.size(); ++c) {
        const std::size_t byte = at + i * frame() + c * width_;
        const double x = sample(byte);
        if (!(std::abs(x) <= std::numeric_limits<float>::max()))
          return wrong(byte, tr("a sample that is no number, or beyond single precision"),
                       "numbers");
        out_.channels[c].push_back(x);
      }
    return std::move(out_);
  }

  /// Bytes of a sample of all channels; 1 before the format is known.
  std::size_t frame() const {
    return std::max<std::size_t>(width_ * out_.channels.size(), 1);
  }

  double sample(std::size_t byte) const {
    const std::uint64_t word = word_at(bytes_, byte, width_);
    if (out_.floating)
      return width_ == 8 ? std::bit_cast<double>(word)
                         : std::bit_cast<float>(static_cast<std::uint32_t>(word));
    if (width_ == 1) return (static_cast<double>(word) - 128) / 128;  // without a sign
    constexpr double kFull = 2147483648.0;                            // of 32 bits
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word)
                                     << (32 - 8 * width_)) /
           kFull;
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
