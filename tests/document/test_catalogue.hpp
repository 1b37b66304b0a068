#pragma once
#include "schema_check.hpp"
#include "turnwright/document/catalogue.hpp"

namespace turnwright::document {

/// The catalogue of tests/data, which knows "test-steel".
inline const Catalogue& test_catalogue() {
  static const auto kCatalogue = load_catalogue(source_path("tests/data/catalogue"));
  return kCatalogue;
}

}  // namespace turnwright::document
