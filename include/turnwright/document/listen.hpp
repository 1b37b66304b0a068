#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// The capability `listen`: the sound of a cut as a .wav file -> chatter if it is heard, and
/// speeds that would be without it.  Computed by chatter/sound.hpp and, where the request
/// has a chart, by stability(); the documents are described by schemas/listen.request.json
/// and schemas/listen.result.json.
/// @throws InputError with every problem of the request; ModelRangeError if the sound is too
///   short; Cancelled soon after a stop was requested.
nlohmann::ordered_json listen(const nlohmann::json& request,
                              const Catalogue& catalogue = {},
                              const std::stop_token& stop = {});

/// Bytes of base64 of a sound.
inline constexpr std::size_t kLargestSound = 40'000'000;

/// The text of base64 of a file's bytes, as `wav` of the request has it.
std::string sound_base64(const std::string& bytes);

}  // namespace turnwright::document
