#pragma once
#include <string>
#include <string_view>

#include "message.hpp"

/// The planner's page: one HTML file with its styles and its script inside.
namespace turnwright::service {

/// As built into the program (web/dist/index.html).
std::string built_in_page();

/// What the page may do (Content Security Policy, level 3): run the scripts and use the
/// styles that stand in it, known by their SHA-256, show data: and blob: images, ask this
/// server, nothing else.
std::string content_security_policy(std::string_view html);

/// The page with its policy.
Reply page_reply(std::string html);

}  // namespace turnwright::service
