#include "svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turnwright::report {
namespace {

// Black on white, red for what the cut adds, blue for what the path is corrected by; the
// sizes are mm of paper.
constexpr const char* kHead =
    R"svg(<defs><pattern id="hatch" width="1.4" height="1.4" patternUnits="userSpaceOnUse"
patternTransform="rotate(45)"><rect width="1.4" height="1.4" fill="#fff"/>
<line x1="0" y1="0" x2="0" y2="1.4"/></pattern></defs>
<style>
polyline, line { fill: none; stroke: #000; stroke-width: 0.3 }
text { font-family: Helvetica, Arial, sans-serif; font-size: 2.8px; fill: #000 }
.title { font-size: 4.2px; font-weight: bold }
.body { fill: #ececec }
.cut { stroke-width: 0.8; stroke-linecap: square }
.stock { stroke-width: 0.2; stroke-dasharray: 1.6 1 }
.hidden { stroke-width: 0.2; stroke-dasharray: 0.8 0.6 }
.axis { stroke-width: 0.2; stroke-dasharray: 5 1 0.8 1 }
.thin { stroke-width: 0.15 }
.leader { stroke-width: 0.12; stroke: #555 }
.jaw { fill: url(#hatch); stroke: #000; stroke-width: 0.3 }
.centre, .rest { fill: #fff; stroke: #000; stroke-width: 0.3 }
.feed { stroke-width: 0.25; stroke-linejoin: round }
.rapid { stroke: #666; stroke-width: 0.18; stroke-dasharray: 1.4 0.9 }
.tool0 { stroke: #c8102e } .tool1 { stroke: #0050b4 } .tool2 { stroke: #2a7d3b }
.tool3 { stroke: #b36b00 } .tool4 { stroke: #7a3e9d } .tool5 { stroke: #2593a3 }
.off { stroke: #fff; stroke-width: 0.08; fill-opacity: 0.35 } .off.deep { fill-opacity: 0.55 }
.off.tool0 { fill: #c8102e } .off.tool1 { fill: #0050b4 } .off.tool2 { fill: #2a7d3b }
.off.tool3 { fill: #b36b00 } .off.tool4 { fill: #7a3e9d } .off.tool5 { fill: #2593a3 }
.off.tool0, .off.tool1, .off.tool2, .off.tool3, .off.tool4, .off.tool5 { stroke: #fff }
.zero { fill: #0a6b3d; stroke: #0a6b3d; stroke-width: 0.35 } .open { fill: #fff }
text.zero { stroke: none; font-weight: bold }
.error { fill: #c8102e; fill-opacity: 0.2 }
.made { stroke: #c8102e; stroke-width: 0.35 }
.path { stroke: #0050b4; stroke-width: 0.35; stroke-dasharray: 1 0.7 }
text.path { fill: #0050b4; stroke: none }
text.accent { fill: #c8102e }
text.later { fill: #777 }
.bar { stroke-width: 0.6 }
.share { fill: #999; stroke: #fff; stroke-width: 0.1 }
.deflection { fill: #c8102e } .machine { fill: #0050b4 } .jaw-squeeze { fill: #7a3e9d }
.drift { fill: #e58a00 } .repeatability { fill: #4a9b57 } .wear { fill: #8c6d46 }
.heat { fill: #e86f9b } .rechucking { fill: #2ba4b5 } .measurement { fill: #666 }
.frame { fill: none; stroke: #000; stroke-width: 0.3 }
.count1 { fill: #fbe0e3 } .count2 { fill: #f5bcc3 } .count3 { fill: #ec929d }
.count4 { fill: #e06575 } .flip { stroke: #0050b4; stroke-width: 0.5 }
.hopf { stroke: #c8102e; stroke-width: 0.5 }
.fold { stroke: #7a3fb0; stroke-width: 0.5 } .robust { stroke: #4a9b57 }
.stable { fill: #fff; stroke: #000; stroke-width: 0.3 } .best { fill: #0050b4 }
.outside { fill: #777; fill-opacity: 0.35 }
</style>
)svg";

// Thousandths of a mm of paper; never "-0.000".
std::string coordinate(double value) {
  if (!std::isfinite(value))
    throw std::domain_error("a drawing's coordinate must be finite");
  return fmt::format("{:.3f}", std::abs(value) < 0.0005 ? 0.0 : value);
}

std::string class_of(const std::string& name) {
  return name.empty() ? "" : " class=\"" + name + '"';
}

const char* name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

// Bytes of the first character if XML 1.0 does not know it or HTML refuses it as a
// control character, else 0.
std::size_t unknown(std::string_view text) {
  const auto c = static_cast<unsigned char>(text[0]);
  const auto second = static_cast<unsigned char>(text.size() > 1 ? text[1] : 0);
  if (c == 0x7f) return 1;
  if (c == 0xc2 && second >= 0x80 && second < 0xa0) return 2;  // U+0080 to U+009F
  if (c < 0x20) return c != '\t' && c != '\n' && c != '\r' ? 1 : 0;
  const auto three = text.substr(0, 3);  // U+FFFE, U+FFFF
  return three == "\xef\xbf\xbe" || three == "\xef\xbf\xbf" ? 3 : 0;
}

}  // namespace

std::string plain(double value, int decimals) {
  if (!std::isfinite(value)) throw std::domain_error("a drawn number must be finite");
  auto text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (const auto bytes = unknown(text.substr(i)); bytes > 0) {
      out += "\ufffd";
      i += bytes - 1;
    } else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

void Svg::shape(const char* element, const std::string& css_class,
                const std::vector<Point>& points) {
  body_ += fmt::format("<{}{} points=\"", element, class_of(css_class));
  for (const auto& p : points) {
    if (&p != points.data()) body_ += ' ';
    body_ += coordinate(p.x) + ',' + coordinate(p.y);
  }
  body_ += "\"/>\n";
}

void Svg::polyline(const std::string& css_class, const std::vector<Point>& points) {
  shape("polyline", css_class, points);
}

void Svg::polygon(const std::string& css_class, const std::vector<Point>& points) {
  shape("polygon", css_class, points);
}

void Svg::line(const std::string& css_class, Point from, Point to) {
  body_ += fmt::format("<line{} x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n",
                       class_of(css_class), coordinate(from.x), coordinate(from.y),
                       coordinate(to.x), coordinate(to.y));
}

void Svg::text(Point at, Anchor anchor, std::string_view text,
               const std::string& css_class) {
  body_ += fmt::format("<text{} x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n",
                       class_of(css_class), coordinate(at.x), coordinate(at.y),
                       name(anchor), escaped(text));
}

void Svg::text_upwards(Point at, Anchor anchor, std::string_view text,
                       const std::string& css_class) {
  body_ += fmt::format(
      "<text{} transform=\"translate({} {}) rotate(-90)\" text-anchor=\"{}\">{}</text>\n",
      class_of(css_class), coordinate(at.x), coordinate(at.y), name(anchor),
      escaped(text));
}

void Svg::clip(Point corner, Point opposite) {
  const auto [x0, x1] = std::minmax(corner.x, opposite.x);
  const auto [y0, y1] = std::minmax(corner.y, opposite.y);
  body_ += fmt::format(
      "<clipPath id=\"view\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>"
      "</clipPath>\n<g clip-path=\"url(#view)\">\n",
      coordinate(x0), coordinate(y0), coordinate(x1 - x0), coordinate(y1 - y0));
}

void Svg::end_clip() { body_ += "</g>\n"; }

std::string Svg::page(double width, double height, std::string_view title) const {
  const auto w = coordinate(width), h = coordinate(height);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" "
             "height=\"{1}mm\" "
             "viewBox=\"0 0 {0} {1}\" role=\"img\">\n<title>{2}</title>\n",
             w, h, escaped(title)) +
         kHead + fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", w, h) +
         body_ + "</svg>\n";
}

}  // namespace turnwright::report
