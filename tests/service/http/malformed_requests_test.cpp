// Every door is sent what is not quite its example: the answer is a problem document that
// points at the slip.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "document/json/parse.hpp"
#include "service/http/api.hpp"

namespace turnwright::service::malformed_requests_test {
namespace {

using nlohmann::json;

const HttpApi& api() {
  static const auto kCatalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  static const HttpApi kApi(TURNWRIGHT_SOURCE_DIR, kCatalogue, nullptr);
  return kApi;
}

Reply reply_to(const Request& row, std::string body) {
  return api().reply(
      {"POST", "/v1/" + row.name, "application/json", "", "", "id-1", std::move(body)},
      {});
}

// Pointers of all values below one, itself included.
void pointers_of(const json& value, const json::json_pointer& at,
                 std::vector<json::json_pointer>& all) {
  all.push_back(at);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) pointers_of(member, at / key, all);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) pointers_of(value[i], at / i, all);
}

struct Slip {
  std::string body;
  std::string pointer;  ///< where it is; unused without `in_document`
  bool in_document = true;
};

class Slips {
 public:
  explicit Slips(const std::string& example) : good_(json::parse(example)) {
    pointers_of(good_, json::json_pointer(), pointers_);
  }

  Slip next() {
    switch (below(4)) {
      case 0:
        return unknown_key();
      case 1:
        return other_type();
      case 2:
        return impossible_number();
      default:
        return broken_text();
    }
  }

 private:
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  template <class Is>
  json::json_pointer any(Is is) {
    for (;;) {
      const auto& p = pointers_[below(pointers_.size())];
      if (is(good_[p])) return p;
    }
  }

  Slip unknown_key() {
    auto bad = good_;
    const auto at = any([](const json& v) { return v.is_object(); });
    bad[at]["no such key"] = 1;
    return {bad.dump(), at.to_string()};
  }
  // A list where no list of lists can be.
  Slip other_type() {
    auto bad = good_;
    const auto at = pointers_[below(pointers_.size())];
    bad[at] = json{{"no such key", json::array()}};
    return {bad.dump(), at.to_string()};
  }
  Slip impossible_number() {
    const auto is_number = [](const json& v) { return v.is_number(); };
    if (std::ranges::none_of(pointers_,
                             [&](const auto& p) { return is_number(good_[p]); }))
      return other_type();
    auto bad = good_;
    const auto at = any(is_number);
    bad[at] = below(2) == 0 ? json("1") : json(nullptr);
    return {bad.dump(), at.to_string()};
  }
  Slip broken_text() {
    auto text = good_.dump();
    if (below(2) == 0)
      text.resize(1 + below(text.size() - 1));
    else
      text.insert(1 + below(text.size() - 1), 1, '\x01');
    return {text, "", false};
  }

  json good_;
  std::vector<json::json_pointer> pointers_;
  std::mt19937 random_{2026};
};

bool below(const std::string& pointer, const std::string& above) {
  return pointer == above || pointer.starts_with(above + '/');
}

// The lines of a table are told by their table.
std::string told_at(const std::string& pointer) {
  const auto table = pointer.find("/csv/");
  return table == pointer.npos ? pointer : pointer.substr(0, table + 4);
}

TEST(MalformedRequests, AreAnsweredByProblemsThatPointAtThem) {
  for (const auto& row : requests()) {
    Slips slips(row.example);
    for (int i = 0; i < 200; ++i) {
      const auto slip = slips.next();
      const auto reply = reply_to(row, slip.body);
      ASSERT_EQ(reply.status, slip.in_document ? 422 : 400)
          << row.name << ' ' << slip.pointer << '\n'
          << slip.body << '\n'
          << reply.body;
      ASSERT_EQ(reply.content_type, "application/problem+json");
      if (!slip.in_document) continue;
      const auto problem = json::parse(reply.body);
      bool found = false;
      for (const auto& error : problem.at("errors"))
        found = found || below(error.at("pointer"), told_at(slip.pointer));
      ASSERT_TRUE(found) << row.name << ' ' << slip.pointer << '\n'
                         << slip.body << '\n'
                         << reply.body;
    }
  }
}

}  // namespace
}  // namespace turnwright::service::malformed_requests_test
