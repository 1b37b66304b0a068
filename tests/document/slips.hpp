#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "schema_check.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {

/// What a door's InputError says to a request, "" if it answers it.
template <class Door>
std::string input_refusal(Door door, const nlohmann::json& request) {
  try {
    door(request);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// The same, "" also for what is well formed but beyond the model.
template <class Door>
std::string refusal(Door door, const nlohmann::json& request) {
  try {
    return input_refusal(door, request);
  } catch (const ModelRangeError&) {
    return "";
  }
}

/// Every key of `good` left out, and every value replaced, one at a time: the schema
/// refuses what the reader refuses.  `skip` names pointers the schema cannot judge.
class SlipsOf {
 public:
  SlipsOf(const SchemaCheck& schema,
          std::function<std::string(const nlohmann::json&)> refused, nlohmann::json good,
          std::function<bool(const std::string&)> skip = {})
      : schema_(schema),
        refused_(std::move(refused)),
        good_(std::move(good)),
        skip_(std::move(skip)) {}

  int try_all() {
    EXPECT_EQ(schema_.fault(good_), "");
    EXPECT_EQ(refused_(good_), "");
    walk(good_, nlohmann::json::json_pointer());
    return tried_;
  }

 private:
  using json = nlohmann::json;
  void walk(const json& value, const json::json_pointer& at) {
    if (value.is_number())
      for (const json& slip :
           {json(-1e12), json(-1e9), json(1e12), json("x"), json(nullptr)})
        replace(at, slip);
    if (value.is_string())
      for (const json& slip : {json(""), json(3)}) replace(at, slip);
    if (value.is_array()) {
      replace(at, json::object());
      if (!value.empty()) replace(at, json::array());
      for (std::size_t i = 0; i < value.size(); ++i) walk(value[i], at / i);
    }
    if (value.is_object()) {
      replace(at / "no_such_key", 1);
      for (const auto& [key, member] : value.items()) {
        json document = good_;
        document[at].erase(key);
        compare(document, (at / key).to_string() + " left out");
        walk(member, at / key);
      }
    }
  }
  void replace(const json::json_pointer& at, const json& slip) {
    json document = good_;
    document[at] = slip;
    compare(document, at.to_string() + " = " + slip.dump());
  }
  void compare(const json& document, const std::string& what) {
    if (skip_ && skip_(what)) return;
    ++tried_;
    const std::string schema = schema_.fault(document), reader = refused_(document);
    EXPECT_EQ(schema.empty(), reader.empty())
        << what << "\nschema: " << schema << "\nreader: " << reader;
  }

  const SchemaCheck& schema_;
  std::function<std::string(const json&)> refused_;
  json good_;
  std::function<bool(const std::string&)> skip_;
  int tried_ = 0;
};

}  // namespace turnwright::document
