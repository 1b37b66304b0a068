#include "page.hpp"

#include <stdexcept>

#include "service/digest.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::service {
namespace {

/// " 'sha256-..'" for every element of this name, of what stands between its tags.
std::string hashes(std::string_view html, const std::string& element) {
  const std::string close = "</" + element + '>';
  std::string all;
  for (auto at = html.find('<' + element); at != std::string_view::npos;
       at = html.find('<' + element, at)) {
    const auto begin = html.find('>', at) + 1;
    const auto end = html.find(close, begin);
    if (begin == 0 || end == std::string_view::npos)
      throw std::domain_error("content_security_policy: <" + element + "> has no end");
    all += " 'sha256-" + sha256_base64(html.substr(begin, end - begin)) + '\'';
    at = end;
  }
  return all;
}

std::string in_own_language(std::string html) {
  constexpr std::string_view kEnglish = "<html lang=\"en\">";
  if (const auto at = html.find(kEnglish); at != std::string::npos)
    html.replace(at, kEnglish.size(), "<html lang=\"" + language() + "\">");
  return html;
}

}  // namespace

std::string content_security_policy(std::string_view html) {
  return "default-src 'none'; connect-src 'self'; img-src data: blob:; script-src" +
         hashes(html, "script") + "; style-src" + hashes(html, "style") +
         "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

Reply page_reply(std::string html) {
  Reply reply{200, "text/html; charset=utf-8", in_own_language(std::move(html)), {}};
  reply.headers = {{"Content-Security-Policy", content_security_policy(reply.body)},
                   {"Referrer-Policy", "no-referrer"},
                   {"Cache-Control", "no-cache"}};
  return reply;
}

}  // namespace turnwright::service
