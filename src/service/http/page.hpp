#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "message.hpp"

/// The planner's page: one HTML file with its styles and its script inside.
namespace turnwright::service {

/// The page that is built into the program (web/dist/index.html).
std::string built_in_page();

/// The page's Content Security Policy (level 3): it may run the scripts and use the
/// styles that it contains, known by their SHA-256, show data: and blob: images, and call
/// this server; nothing else.
std::string content_security_policy(std::string_view html);

/// The languages that the page speaks, by their tags: the query's "language" of its address
/// says it in another than the program's.
inline const std::vector<std::string> kPageLanguages{"en", "de"};

/// The page with its policy.  Its <html lang="en"> becomes the program's language, which
/// tells the page's script what to speak.
Reply page_reply(std::string html);

}  // namespace turnwright::service
