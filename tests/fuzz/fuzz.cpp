// libFuzzer target of every reader of what comes from outside: --target=NAME
// (targets.hpp). Documents are mutated as JSON, so that most of them get past the parser.
#include <cstring>

#include "option.hpp"
#include "targets.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most);

namespace {

turnwright::fuzz::Target target;
bool is_document = false;

std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  using namespace turnwright::fuzz;
  const auto name = option(*argc, *argv, "target");
  target = name == "http" ? http_target() : text_target(name);
  is_document = !target;
  if (is_document) target = door_target(name);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target(text(data, size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (!is_document || seed % 50 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string changed(text(data, size));
  if (!turnwright::fuzz::mutate_json(changed, seed) || changed.size() > most)
    return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
