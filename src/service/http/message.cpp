#include "message.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "service/problem_list.hpp"

namespace turnwright::service {
namespace {

constexpr std::size_t kWorthCompressing = 1024;  // bytes; below, one packet carries it

std::string gzip(const std::string& text) {
  constexpr int kGzipWrapper = 15 + 16;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzipWrapper, 8,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("gzip: zlib has no memory");
  std::string out(deflateBound(&stream, static_cast<uLong>(text.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int end = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) throw std::runtime_error("gzip: zlib did not finish");
  return out;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// What comes before the first `mark`, all of it where there is none.
std::string_view before(std::string_view text, char mark) {
  return text.substr(0, text.find(mark));
}

/// What comes behind the first `mark`, nothing where there is none.
std::string_view behind(std::string_view text, char mark) {
  const auto at = text.find(mark);
  return at == text.npos ? std::string_view() : text.substr(at + 1);
}

// RFC 9110, 12.5.3: a list of codings, each with an optional weight; weight 0 refuses.
bool takes_gzip(std::string_view codings) {
  while (!codings.empty()) {
    const auto comma = std::min(codings.find(','), codings.size());
    const auto item = codings.substr(0, comma);
    codings.remove_prefix(std::min(comma + 1, codings.size()));
    const auto semicolon = std::min(item.find(';'), item.size());
    if (trimmed(item.substr(0, semicolon)) != "gzip") continue;
    const auto weight = item.substr(semicolon);
    return weight.find_first_of("123456789") != std::string_view::npos || weight.empty();
  }
  return false;
}

}  // namespace

std::string_view Call::path() const {
  const std::string_view all = target;
  return all.starts_with('/') ? all.substr(0, all.find('?')) : std::string_view();
}

std::vector<std::pair<std::string_view, std::string_view>> Call::query() const {
  const std::string_view all = target;
  std::vector<std::pair<std::string_view, std::string_view>> parameters;
  for (auto rest = behind(all, '?'); !rest.empty(); rest = behind(rest, '&')) {
    const auto pair = before(rest, '&');
    if (!pair.empty()) parameters.emplace_back(before(pair, '='), behind(pair, '='));
  }
  return parameters;
}

bool is_type(std::string_view content_type, std::string_view type) {
  using boost::algorithm::iequals;
  if (!iequals(trimmed(before(content_type, ';')), type)) return false;
  for (auto rest = behind(content_type, ';'); !rest.empty(); rest = behind(rest, ';')) {
    const auto parameter = before(rest, ';');
    const auto value = trimmed(behind(parameter, '='));
    if (iequals(trimmed(before(parameter, '=')), "charset") && !iequals(value, "utf-8") &&
        !iequals(value, "\"utf-8\""))
      return false;
  }
  return true;
}

std::string_view reason(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 202:
      return "Accepted";
    case 204:
      return "No Content";
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 409:
      return "Conflict";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 421:
      return "Misdirected Request";
    case 422:
      return "Unprocessable Content";
    case 431:
      return "Request Header Fields Too Large";
    case 501:
      return "Not Implemented";
    case 503:
      return "Service Unavailable";
    case 504:
      return "Gateway Timeout";
    default:
      return "Internal Server Error";
  }
}

Reply problem(int status, const std::string& kind, const std::string& detail,
              const Call& call, const std::vector<Problem>& errors) {
  nlohmann::ordered_json document{{"type", "urn:turnwright:problem:" + kind},
                                  {"title", reason(status)},
                                  {"status", status},
                                  {"detail", detail},
                                  {"instance", "urn:turnwright:call:" + call.request_id}};
  if (!errors.empty()) document["errors"] = problem_list(errors);
  // What came may hold bytes that are no UTF-8; they are shown as U+FFFD.
  constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
  return {status,
          "application/problem+json",
          document.dump(2, ' ', false, kReplace) + '\n',
          {}};
}

void compress_for(const Call& call, Reply& reply) {
  if (reply.body.size() < kWorthCompressing) return;
  reply.headers.emplace_back("Vary", "Accept-Encoding");
  if (!takes_gzip(call.accept_encoding)) return;
  reply.body = gzip(reply.body);
  reply.headers.emplace_back("Content-Encoding", "gzip");
}

}  // namespace turnwright::service
