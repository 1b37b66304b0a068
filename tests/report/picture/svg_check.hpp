#pragma once
#include <algorithm>
#include <regex>
#include <string>
#include <vector>

/// What is asked of any picture.
namespace turnwright::report {

/// Whether tags nest, attributes are quoted and `<`, `&` appear in text as entities only.
inline bool well_formed(const std::string& xml) {
  const std::regex tag(
      "^<(/?)([a-zA-Z]+)((?:\\s+[A-Za-z][A-Za-z0-9:-]*=\"[^\"<&]*\")*)(/?)>",
      std::regex::optimize);
  const std::regex entity("^&(amp|lt|gt|quot);");
  std::vector<std::string> open;
  bool root_closed = false;
  for (std::size_t i = 0; i < xml.size();) {
    const auto rest = xml.begin() + static_cast<long>(i);
    std::smatch m;
    if (xml[i] == '&') {
      if (!std::regex_search(rest, xml.end(), m, entity)) return false;
      i += static_cast<std::size_t>(m.length());
    } else if (xml[i] == '<') {
      if (root_closed || !std::regex_search(rest, xml.end(), m, tag)) return false;
      const std::string name = m[2];
      if (m[1] == "/") {
        if (open.empty() || open.back() != name) return false;
        open.pop_back();
        root_closed = open.empty();
      } else if (m[4] != "/") {
        open.push_back(name);
      }
      i += static_cast<std::size_t>(m.length());
    } else {
      if (xml[i] == '>') return false;
      ++i;
    }
  }
  return root_closed;
}

/// A rectangle that a text takes, in a wide face (0.6 of the type a character).
struct Box {
  double x0, x1, y0, y1;
  std::string text;
};

inline std::vector<Box> texts(const std::string& svg) {
  std::vector<Box> all;
  const std::regex text(
      "<text(?: class=\"(\\w+)\")? (?:x=\"(\\S+)\" y=\"(\\S+)\"|transform=\"translate\\("
      "(\\S+) (\\S+)\\) rotate\\(-90\\)\") text-anchor=\"(\\w+)\">([^<]*)<");
  for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it) {
    const auto& m = *it;
    const double type = m[1] == "title" ? 4.2 : 2.8;
    const std::string shown = std::regex_replace(m[7].str(), std::regex("&\\w+;"), "&");
    const auto characters = std::ranges::count_if(
        shown, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    const double length = 0.6 * type * static_cast<double>(characters);
    const double from = m[6] == "start" ? 0 : m[6] == "middle" ? -length / 2 : -length;
    if (m[2].matched) {
      const double x = std::stod(m[2]), y = std::stod(m[3]);
      all.push_back({x + from, x + from + length, y - 0.75 * type, y, shown});
    } else {
      const double x = std::stod(m[4]), y = std::stod(m[5]);
      all.push_back({x - 0.75 * type, x, y - from - length, y - from, shown});
    }
  }
  return all;
}

/// Two texts on each other, or one beyond the page; "" if there are none.
inline std::string crowded(const std::string& svg) {
  std::smatch page;
  if (!std::regex_search(svg, page, std::regex("viewBox=\"0 0 (\\S+) (\\S+)\"")))
    return "no page";
  const double width = std::stod(page[1]), height = std::stod(page[2]);
  const auto all = texts(svg);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Box& a = all[i];
    if (a.x0 < 0 || a.y0 < 0 || a.x1 > width || a.y1 > height) return a.text + " is out";
    for (std::size_t k = 0; k < i; ++k) {
      const Box& b = all[k];
      if (a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1)
        return a.text + " on " + b.text;
    }
  }
  return all.size() < 5 ? "no texts" : "";
}

}  // namespace turnwright::report
