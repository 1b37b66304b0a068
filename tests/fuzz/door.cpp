// libFuzzer target of the document doors: --door=NAME, one of the request table.  Inputs
// are mutated as JSON, so that most of them get past the parser.
#include <array>
#include <cstdint>
#include <cstring>
#include <random>

#include "answered.hpp"
#include "option.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most);

namespace turnwright::fuzz {
namespace {

using nlohmann::json;

const service::Request* door = nullptr;

class Mutation {
 public:
  Mutation(json& document, unsigned seed) : document_(document), random_(seed) {
    collect(document_);
  }

  void apply() {
    json& at = *values_[below(values_.size())];
    switch (below(6)) {
      case 0:
        at = number(at);
        break;
      case 1:
        at = *values_[below(values_.size())];
        break;
      case 2:
        at = other();
        break;
      case 3:
        shrink(at);
        break;
      default:
        grow(at);
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }

  void collect(json& value) {
    values_.push_back(&value);
    if (value.is_structured())
      for (json& member : value) collect(member);
  }

  json number(const json& at) {
    static const std::array kNumbers{0.0,   -1.0, 1.0,  0.5,   1e-300, 1e-9,  1e-3,
                                     1e3,   1e6,  1e9,  1e300, -1e300, 1e-15, 2.0,
                                     360.0, 90.0, 1e12, 7.0,   100.0,  -0.0,  3.0};
    if (at.is_number() && below(2))
      return at.get<double>() * std::array{0.5, 2.0, -1.0, 0.99, 1.01, 10.0}[below(6)];
    const double x = kNumbers[below(kNumbers.size())];
    return below(2) && std::abs(x) < 1e12 ? json(static_cast<long>(x)) : json(x);
  }

  json other() {
    static const std::array<json, 8> kOthers{json(nullptr),  json(true),  json("x"),
                                             json(""),       json(1),     json::array(),
                                             json::object(), json("auto")};
    return kOthers[below(kOthers.size())];
  }

  void grow(json& at) {
    if (at.is_array() && !at.empty()) {
      at.push_back(json(at[below(at.size())]));
    } else if (at.is_object()) {
      const json& from = *values_[below(values_.size())];
      if (from.is_object() && !from.empty() && &from != &at) {
        auto member = from.begin();
        std::advance(member, below(from.size()));
        at[member.key()] = json(*member);
      }
    } else {
      at = number(at);
    }
  }

  void shrink(json& at) {
    if (!at.is_structured() || at.empty()) {
      at = number(at);
      return;
    }
    auto member = at.begin();
    std::advance(member, below(at.size()));
    at.erase(member);
  }

  json& document_;
  std::minstd_rand random_;
  std::vector<json*> values_;
};

}  // namespace
}  // namespace turnwright::fuzz

using namespace turnwright;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  fuzz::door = &fuzz::door_named(fuzz::option(*argc, *argv, "door"));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nlohmann::json request;
  try {
    request = document::parse({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const InputError&) {
    return 0;
  }
  fuzz::answered(*fuzz::door, request);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  auto document = nlohmann::json::parse(data, data + size, nullptr, false);
  if (document.is_discarded() || seed % 50 == 0)
    return LLVMFuzzerMutate(data, size, most);
  for (unsigned i = 0; i <= seed % 3; ++i) fuzz::Mutation(document, seed + i).apply();
  const std::string text =
      document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
