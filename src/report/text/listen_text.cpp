#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "stability_words.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string heard(const ordered_json& result) {
  const auto& chatter = object(result, "chatter");
  if (chatter.empty())
    return '\n' + paragraph("", say("No chatter is heard from {} to {} Hz.",
                                    shown(number(result, "from_Hz"), 0),
                                    shown(number(result, "to_Hz"), 0)));
  std::vector<std::string> speeds;
  for (const auto& s : list(result, "speeds"))
    speeds.push_back(say("{} 1/min ({} a tooth)", shown(number(s, "n_rpm"), 0),
                         shown(number(s, "harmonic"), 0)));
  std::string out = say("It chatters at {} Hz, {} dB over the noise.",
                        shown(number(chatter, "frequency_Hz"), 1),
                        shown(number(chatter, "over_noise_dB"), 0));
  if (!speeds.empty())
    out +=
        say(" Speeds at which its waves keep step with the teeth: {}.", joined(speeds));
  return '\n' + paragraph("", out);
}

/// Speed and teeth that were taken, and the speed that the harmonics tell.
std::string taken(const ordered_json& result) {
  const auto& cut = object(result, "taken");
  if (cut.empty()) return "";
  return '\n' + paragraph("", say("Taken: {} 1/min, teeth {}; by the harmonics {} 1/min.",
                                  significant(number(cut, "n_rpm"), 6),
                                  shown(number(cut, "teeth"), 0),
                                  significant(number(result, "n_rpm"), 6)));
}

std::string charted(const ordered_json& result) {
  const auto& chart = object(result, "stability");
  std::string out;
  for (const auto& p : list(chart, "points"))
    out += paragraph("  ",
                     fmt::format("{} 1/min, {} mm: {}", shown(number(p, "n_rpm"), 0),
                                 significant(number(p, "ap_mm"), 3), verdict_words(p)));
  if (const auto& best = object(chart, "best"); !best.empty())
    out += paragraph(tr("  best: "), best_words(best));
  return out.empty() ? "" : '\n' + tr("BY THE MODES GIVEN") + '\n' + out;
}

std::string lines(const ordered_json& result) {
  std::vector<Row> rows;
  const auto add = [&](const ordered_json& line, const std::string& what) {
    rows.push_back({{shown(number(line, "frequency_Hz"), 1),
                     significant(number(line, "amplitude"), 3),
                     shown(number(line, "over_noise_dB"), 0), what},
                    ""});
  };
  for (const auto& line : list(result, "others")) add(line, tr("no harmonic"));
  for (const auto& line : list(result, "harmonics")) {
    const auto order = shown(number(line, "order"), 0);
    add(line, flag(line, "of_teeth") ? say("teeth, {} times the spindle", order)
                                     : say("run-out, {} times the spindle", order));
  }
  if (rows.empty()) return "";
  return '\n' + tr("LINES OF THE SOUND") + '\n' +
         table({{"Hz"}, {tr("amplitude")}, {"dB"}, {"", Align::left}}, rows);
}

}  // namespace

std::string listen_text(const ordered_json& result) {
  return tr("SOUND OF THE CUT") + '\n' + made_by(result) + taken(result) + heard(result) +
         charted(result) + lines(result);
}

}  // namespace turnwright::report
