#include "stabilisation_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/say.hpp"
#include "chart.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

class StabilisationDiagram {
 public:
  explicit StabilisationDiagram(const ordered_json& response)
      : response_(response),
        frequency_{response.at("from_Hz"), response.at("to_Hz"), kLeft, kRight},
        order_{0, response.at("stabilisation").at("orders").get<double>(), kBottom,
               kTop} {}

  /// The magnitude, with its axis on the right.
  void curve() {
    const auto& curve = response_.at("stabilisation").at("curve");
    const auto f = curve.at("frequency_Hz").get<std::vector<double>>(),
               magnitude = curve.at("magnitude").get<std::vector<double>>();
    const double highest = std::ranges::max(magnitude);
    const Scale decibel{-kRange_dB, 0, kBottom, kTop};
    std::vector<Point> line;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double dB =
          magnitude[i] > 0 ? 20 * std::log10(magnitude[i] / highest) : -kRange_dB;
      line.push_back({frequency_.place(f[i]), decibel.place(std::max(dB, -kRange_dB))});
    }
    if (line.size() > 1) svg_.polyline("leader", line);
    for (double dB = -kRange_dB; dB <= 0; dB += kStep_dB)
      svg_.text({kRight + 1.5, decibel.place(dB) + 1}, Anchor::start, plain(dB, 0));
    svg_.text_upwards({kRight + 14, (kTop + kBottom) / 2}, Anchor::middle,
                      tr("magnitude, dB of the highest line"));
  }

  void modes() {
    for (const auto& m : response_.at("modes")) {
      const bool stable = !m.at("stable_from_order").is_null();
      upright(stable ? "hopf" : "hidden", m.at("frequency_Hz"), stable ? "" : "accent");
    }
    for (const auto& m : response_.at("stabilisation").at("unfitted"))
      upright("fold", m.at("frequency_Hz"), "accent");
  }

  void poles() {
    for (const auto& p : response_.at("stabilisation").at("poles"))
      mark(p.at("stable").get_ref<const std::string&>(),
           {frequency_.place(p.at("frequency_Hz")), order_.place(p.at("order"))});
  }

  void axes() {
    frame(svg_, frequency_, order_, tr("frequency, Hz"), tr("order of the model"), 8, 8);
    svg_.text(
        {kLeft, 9}, Anchor::start,
        say("Stabilisation diagram along {}", response_.at("axis").get<std::string>()),
        "title");
  }

  void key() {
    double x = kLeft;
    for (const auto& [stable, name] :
         {std::pair{"all", tr("stable")}, std::pair{"damping", tr("in damping")},
          std::pair{"frequency", tr("in frequency")}, std::pair{"no", tr("new")}}) {
      mark(stable, {x, kBottom + 15});
      svg_.text({x + 2, kBottom + 16}, Anchor::start, name);
      x += 38;
    }
    x = kLeft;
    for (const auto& [css_class, name] :
         {std::pair{"hopf", tr("mode")}, std::pair{"hidden", tr("mode, never stable")},
          std::pair{"fold", tr("stable, not fitted")}}) {
      svg_.line(css_class, {x, kBottom + 20}, {x + 6, kBottom + 20});
      svg_.text({x + 7.5, kBottom + 21}, Anchor::start, name);
      x += 50;
    }
  }

  std::string page() const {
    return svg_.page(kPage, kHeight,
                     tr("Stabilisation diagram: order of the model over frequency"));
  }

 private:
  // Millimetres of paper.
  static constexpr double kPage = 190, kHeight = 128, kLeft = 20, kRight = 172, kTop = 20,
                          kBottom = 104, kMark = 0.8;
  static constexpr double kRange_dB = 80, kStep_dB = 20;

  /// A stroke at a frequency, with the frequency above it.
  void upright(const std::string& css_class, double f_Hz, const std::string& of_text) {
    const double x = frequency_.place(f_Hz);
    svg_.line(css_class, {x, kBottom}, {x, kTop});
    svg_.text_upwards({x + 1, kTop - 1}, Anchor::start, plain(f_Hz, 0), of_text);
  }

  void mark(const std::string& stable, Point at) {
    const auto [x, y] = at;
    if (stable == "all" || stable == "damping") {
      svg_.polygon(stable == "all" ? "best" : "stable",
                   {{x - kMark, y}, {x, y - kMark}, {x + kMark, y}, {x, y + kMark}});
    } else if (stable == "frequency") {
      svg_.line("thin", {x - kMark, y}, {x + kMark, y});
      svg_.line("thin", {x, y - kMark}, {x, y + kMark});
    } else {
      svg_.line("thin", {x - kMark / 2, y - kMark / 2}, {x + kMark / 2, y + kMark / 2});
      svg_.line("thin", {x - kMark / 2, y + kMark / 2}, {x + kMark / 2, y - kMark / 2});
    }
  }

  const ordered_json& response_;
  Scale frequency_, order_;
  Svg svg_;
};

}  // namespace

std::string stabilisation_drawing(const ordered_json& response) {
  StabilisationDiagram diagram(response);
  diagram.curve();
  diagram.modes();
  diagram.poles();
  diagram.axes();
  diagram.key();
  return diagram.page();
}

}  // namespace turnwright::report
