#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::document {

/// The capability `multipass`: the literature's multi-pass turning problem, or under the
/// key `single_pass` a sum of powers of speed and feed -> certified optimum, or the
/// limits in conflict.  Computed by multipass/; the documents are described by
/// schemas/multipass.request.json and schemas/multipass.result.json.
/// @throws InputError with every problem of the request.
nlohmann::json multipass(const nlohmann::json& request);

}  // namespace turnwright::document
