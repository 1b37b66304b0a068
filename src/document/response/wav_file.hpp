#pragma once
#include <string_view>
#include <vector>

#include "document/json/reader.hpp"

namespace turnwright::document {

/// A sound file as it was read.
struct WavFile {
  double rate_Hz = 0;
  int bits = 0;
  bool floating = false;
  std::vector<std::vector<double>> channels;  ///< one or two; whole numbers in [-1, 1]
};

inline constexpr std::size_t kWavSamples = 8'000'000;  ///< of a channel

/// Reads a WAVE file (RIFF): whole numbers of 8 (without a sign), 16, 24 and 32 bits and
/// floating-point numbers of 32 and 64 bits, also as WAVE_FORMAT_EXTENSIBLE, one or two
/// channels, 1 to 400 kHz.  Chunks other than "fmt " and "data" are passed over.  Data that
/// state 0x7FFFF000 bytes or more, as programs write them to a pipe, end with the file.
/// Source: [RIFF 1991].
/// @param at  of the file in the request; problems tell the byte of the file in `got`.  An
///   empty result if there is one.
WavFile read_wav(const Reader& at, std::string_view bytes);

}  // namespace turnwright::document
