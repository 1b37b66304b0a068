#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

/// What is fuzzed, by name: each takes one input.
namespace turnwright::fuzz {

using Target = std::function<void(std::string_view input)>;

/// Bytes as a client sends them to the HTTP server: whatever they are, it closes, and
/// answers the next.
Target http_target();

/// Readers of text: program and program-lathe, that of `compensate`; csv-NAME, the table
/// of a door; review-CONTROL, a program of `review`; drawing-step, -dxf and -notation, a
/// drawing of `import`; frf-csv, -uff and -taps, a response of `stability`; comp-file, that of
/// `positioning`; qif, a file of results of `learn`; batch, a line of a batch; json, any text.  Readers of bytes, as the command
/// line takes files: library, that of `import-tools`; drawing-file, that of `import`;
/// frf-file, a response in any of its forms; sound, that of `listen`.  Empty for other names.
Target text_target(const std::string& name);

/// A document door of the request table; ends the program if there is none.
Target door_target(const std::string& name);

/// One to three changes of a document's values; false if `text` is no JSON.
bool mutate_json(std::string& text, unsigned seed);

}  // namespace turnwright::fuzz
