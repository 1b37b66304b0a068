#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "report/picture/figure.hpp"

/// Elements of HTML pages; all text is escaped.
namespace turnwright::report {

using Figures = std::vector<Figure>;

/// <name>text</name>
std::string tag(const std::string& name, std::string_view text);

/// The figure with that file name as an image element, which isolates its styles and
/// names from those of the page; "" if there is none.
std::string figure_named(const Figures& figures, const std::string& file,
                         const std::string& what);

/// A heading above numbered sentences; "" if there are none.
std::string section(const std::string& title, const std::vector<std::string>& sentences);

struct Heading {
  std::string title, unit;
  bool number = true;
};
std::string table_head(const std::vector<Heading>& headings,
                       const std::string& css_class = "");
inline constexpr const char* kTableFoot = "</tbody></table></div>\n";
std::string words_cell(std::string_view text);
std::string number_cell(std::string_view text);

/// An entry of a list of large numbers.
std::string key_figure(const std::string& name, const std::string& value,
                       const std::string& unit);

/// The request and the version of the program from which a result comes.
std::string origin(const nlohmann::ordered_json& result);

/// The table of `assumed`.
std::string assumptions(const nlohmann::ordered_json& result);

/// The whole page.
std::string page(std::string_view title, const std::string& body);

}  // namespace turnwright::report
