#pragma once
#include <string>
#include <string_view>
#include <vector>

/// A page of SVG, written in order.  Coordinates are mm of paper, y downwards.
namespace turnwright::report {

struct Point {
  double x = 0, y = 0;
};

/// A number with at most `decimals`, without trailing zeros: "30", "0.25".
std::string plain(double value, int decimals = 3);

/// Escapes text and attribute values of XML; what XML 1.0 does not know as a character
/// becomes U+FFFD, and so do other control characters.
std::string escaped(std::string_view text);

enum class Anchor { start, middle, end };

class Svg {
 public:
  void polyline(const std::string& css_class, const std::vector<Point>& points);
  void polygon(const std::string& css_class, const std::vector<Point>& points);
  void line(const std::string& css_class, Point from, Point to);
  void text(Point at, Anchor anchor, std::string_view text,
            const std::string& css_class = {});
  /// Text that reads upwards from `at`.
  void text_upwards(Point at, Anchor anchor, std::string_view text,
                    const std::string& css_class = {});

  /// What is drawn until end_clip() shows only inside a rectangle; once in a file.
  void clip(Point corner, Point opposite);
  void end_clip();

  /// The file; `title` is its text for readers that do not show images.
  std::string page(double width, double height, std::string_view title) const;

 private:
  void shape(const char* element, const std::string& css_class,
             const std::vector<Point>& points);
  std::string body_;
};

}  // namespace turnwright::report
