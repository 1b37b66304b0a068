#include <array>
#include <random>

#include "answered.hpp"
#include "targets.hpp"

namespace turnwright::fuzz {
namespace {

using nlohmann::json;

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
    static const std::array kNumbers{
        0.0, -1.0,  1.0,    5e-324, 1e-310, 1e-14, 0.5,  1e-300, 1e-9, 1e-3,  1e3,  1e6,
        1e9, 1e300, -1e300, 1e-15,  2.0,    360.0, 90.0, 1e12,   7.0,  100.0, -0.0, 3.0};
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

Target door_target(const std::string& name) {
  return [&door = door_named(name)](std::string_view input) {
    json request;
    try {
      request = document::parse(input, "fuzz");
    } catch (const InputError&) {
      return;
    }
    answered(door, request);
  };
}

bool mutate_json(std::string& text, unsigned seed) {
  auto document = json::parse(text, nullptr, false);
  if (document.is_discarded()) return false;
  for (unsigned i = 0; i <= seed % 3; ++i) Mutation(document, seed + i).apply();
  text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  return true;
}

}  // namespace turnwright::fuzz
