#pragma once
#include <string>
#include <string_view>

#include "message.hpp"

/// The planner's page: one HTML file with its styles and its script inside.
namespace turnwright::service {

/// The page that is built into the program (web/dist/index.html).
std::string built_in_page();

/// The page's Content Security Policy (level 3): it may run the scripts and use the
/// styles that it contains, known by their SHA-256, show data: and blob: images, and call
/// this server; nothing else.
std::string content_security_policy(std::string_view html);

/// The page with its policy.
Reply page_reply(std::string html);

}  // namespace turnwright::service
