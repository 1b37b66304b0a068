#include "html_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/say.hpp"
#include "report/picture/svg.hpp"
#include "report/text/json_fields.hpp"
#include "report/text/layout.hpp"
#include "report/text/plan_words.hpp"

namespace turnwright::report {

using nlohmann::ordered_json;

namespace {

constexpr const char* kStyle = R"css(
@page { size: A4; margin: 11mm 12mm }
body { max-width: 186mm; margin: 10mm auto; padding: 0 4mm; color: #1a1d21;
  font: 8.5pt/1.3 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif;
  font-variant-numeric: tabular-nums }
h1 { font-size: 18pt; line-height: 1.15; margin: 0 0 1mm; overflow-wrap: anywhere }
h2 { font-size: 11pt; margin: 4mm 0 1mm; padding-bottom: 0.8mm;
  border-bottom: 0.3mm solid #1a1d21; break-after: avoid }
p { margin: 0.8mm 0 } h2 + p { break-after: avoid }
.status { font-weight: 600 } .status.infeasible { color: #b00d26 }
.from { color: #5b626b; font-size: 8pt }
dl { display: flex; flex-wrap: wrap; gap: 1mm 10mm; margin: 2mm 0 }
dt { color: #5b626b; font-size: 8pt } dd { margin: 0; font-size: 14pt }
dd small { font-size: 8.5pt; color: #5b626b }
table { border-collapse: collapse; width: 100%; font-size: 7.5pt; margin: 1mm 0 }
th { text-align: left; font-weight: 600; border-bottom: 0.2mm solid #8b929b;
  vertical-align: bottom }
th small { display: block; font-weight: 400; color: #5b626b }
th, td { padding: 0.4mm 1.6mm 0.4mm 0 }
td { border-bottom: 0.1mm solid #d8dce1; vertical-align: top; overflow-wrap: anywhere }
td.n, th.n { text-align: right; white-space: nowrap }
tr { break-inside: avoid } thead { display: table-header-group }
tr.first td { border-bottom: 0 } td.note { color: #454b53; padding-left: 3mm }
.bad { color: #b00d26; font-weight: 600 }
ol { padding-left: 6mm; margin: 1mm 0 } li { margin: 0.4mm 0 }
ul { padding-left: 5mm; margin: 1mm 0; color: #454b53 }
figure { margin: 2mm 0; break-inside: avoid }
figure img { width: 100%; display: block }
small { font-size: inherit }
tbody tr:nth-child(-n+4):not(:last-child), tr.first:not(:last-child) { break-after: avoid }
tbody tr:nth-last-child(-n+4):not(:first-child) { break-before: avoid }
.setup-sheet { break-before: page } .cut { break-inside: avoid }
.setup-sheet h1 { font-size: 16pt; display: flex; justify-content: space-between; border-bottom: 0.5mm solid #1a1d21 }
.setup-sheet table, .sign { break-inside: avoid } .setup-sheet td.nowrap { white-space: nowrap }
.setup-sheet table { line-height: 1.15; margin: 0.3mm 0 } .setup-sheet p { margin: 0.3mm 0 } .setup-sheet td { padding-top: 0.3mm; padding-bottom: 0.3mm } .setup-sheet th small { display: inline; margin-left: 1mm } .setup-sheet h2 { margin-top: 1.6mm }
.setup-sheet figure { width: 90%; margin: 0 auto }
.title { display: flex; flex-wrap: wrap; gap: 0.5mm 7mm; margin: 1mm 0 }
.title dd { font-size: 9pt; font-weight: 600; overflow-wrap: anywhere }
.facts { display: block; columns: 2; column-gap: 8mm; margin: 0 } .facts div { display: flex; gap: 2mm; break-inside: avoid }
.facts dt { flex: 0 0 19mm } .facts dd { font-size: 8.5pt }
td.blank { border: 0.1mm solid #8b929b; min-width: 18mm }
.sign { display: grid; grid-template-columns: repeat(3, 1fr); gap: 6mm; margin-top: 8mm }
.sign p { border-top: 0.2mm solid #1a1d21 }
.assumed td:first-child { white-space: nowrap } .assumed { font-size: 7.5pt }
@media print { body { margin: 0; padding: 0; max-width: none } }
@media (max-width: 640px) { .scroll { overflow-x: auto } .sign { grid-template-columns: 1fr } .facts { columns: 1 } }
)css";

/// Bytes of a URL (RFC 3986): what is not unreserved as %XX.
std::string percent_encoded(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = (byte | 0x20) >= 'a' && (byte | 0x20) <= 'z';
    if (letter || (byte >= '0' && byte <= '9') ||
        std::string_view("-._~ ,:;=/()@!*'").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}

/// An image of its own, so that its styles and names stay apart from the page's.
std::string figure(const Figure& f, const std::string& what) {
  return "<figure><img alt=\"" + escaped(what) + "\" src=\"data:image/svg+xml," +
         percent_encoded(f.svg) + "\"></figure>\n";
}

std::string numbered(const std::vector<std::string>& sentences) {
  std::string out = "<ol>\n";
  for (const auto& sentence : sentences) out += tag("li", sentence);
  return out + "</ol>\n";
}

}  // namespace

std::string tag(const std::string& name, std::string_view text) {
  return '<' + name + '>' + escaped(text) + "</" + name + ">\n";
}

std::string figure_named(const Figures& figures, const std::string& file,
                         const std::string& what) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const Figure& f) { return f.file == file; });
  return found == figures.end() ? "" : figure(*found, what);
}

std::string section(const std::string& title, const std::vector<std::string>& sentences) {
  return sentences.empty() ? "" : tag("h2", title) + numbered(sentences);
}

std::string table_head(const std::vector<Heading>& headings,
                       const std::string& css_class) {
  std::string out =
      "<div class=\"scroll\"><table class=\"" + css_class + "\"><thead><tr>";
  for (const auto& h : headings) {
    out += h.number ? "<th class=\"n\">" : "<th>";
    out += escaped(h.title);
    if (!h.unit.empty()) out += "<small>" + escaped(h.unit) + "</small>";
    out += "</th>";
  }
  return out + "</tr></thead><tbody>\n";
}

std::string words_cell(std::string_view text) { return "<td>" + escaped(text) + "</td>"; }
std::string number_cell(std::string_view text) {
  return "<td class=\"n\">" + escaped(text) + "</td>";
}

std::string key_figure(const std::string& name, const std::string& value,
                       const std::string& unit) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + " <small>" +
         escaped(unit) + "</small></dd></div>\n";
}

std::string origin(const ordered_json& result) {
  const auto version = word(result, "turnwright_version");
  const auto digest = word(result, "request_digest");
  if (version.empty() || digest.empty()) return "";
  return "<p class=\"from\">" +
         escaped(say("Turnwright {}, request {}", version, digest)) + "</p>\n";
}

std::string assumptions(const ordered_json& result) {
  constexpr std::size_t kMost = 64;  // a line of the paper; the result has it whole
  std::string rows;
  for (const auto& a : list(result, "assumed")) {
    const auto found = a.find("value");
    auto value = found == a.end() ? "-" : value_text(*found);
    if (value.size() > kMost) value = clipped(value, kMost);
    rows += "<tr>" + words_cell(word(a, "pointer")) + words_cell(value) +
            words_cell(word(a, "why")) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return tag("h2", tr("Assumed: what the request left open")) +
         table_head(
             {{tr("where"), "", false}, {tr("taken"), "", false}, {tr("why"), "", false}},
             "assumed") +
         rows + kTableFoot;
}

std::string page(std::string_view title, const std::string& body) {
  return "<!doctype html>\n<html lang=\"" + escaped(language()) +
         "\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "img-src data:; style-src 'unsafe-inline'\">\n<title>" +
         escaped(title) + "</title>\n<style>" + kStyle +
         "</style>\n</head>\n<body>\n<main>\n" + body + "</main>\n</body>\n</html>\n";
}

}  // namespace turnwright::report
