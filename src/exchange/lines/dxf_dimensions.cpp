#include "dxf_dimensions.hpp"

#include <fmt/format.h>

#include "base/say.hpp"
#include "dxf_text.hpp"
#include "exchange/text/notation_words.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/pattern.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr double kSameSize = 1e-3;        // of a size: what drawn texts are rounded to
constexpr std::size_t kMostListed = 200;  // texts and dimensions that are not used
constexpr double kDirection = 1e-3;       // rad

// An element with its place along the part.
struct Placed {
  Element* element = nullptr;
  double z0_mm = 0, z1_mm = 0;
};

std::vector<Placed> placed(Outline& o) {
  std::vector<Placed> out;
  double z = 0;
  for (Element& e : o.outer) {
    out.push_back({&e, z, z + e.length_mm});
    z += e.length_mm;
  }
  double left = 0, right = z;
  for (Element& e : o.inner) {
    const double from = e.from == part::End::left ? left : right - e.length_mm;
    out.push_back({&e, from, from + e.length_mm});
    (e.from == part::End::left ? left : right) +=
        e.from == part::End::left ? e.length_mm : -e.length_mm;
  }
  return out;
}

class Dimensions {
 public:
  Dimensions(Outline& out, const View& view, double z0_mm, double join_mm)
      : out_(out), view_(view), z0_(z0_mm), within_(10 * join_mm), placed_(placed(out)) {}

  void add() {
    for (const Dimension& d : view_.drawn->dimensions) {
      leave_if_asked();
      add(d);
    }
    for (const Note& n : view_.drawn->notes) {
      leave_if_asked();
      add(n);
    }
    if (listed_ > kMostListed)
      out_.ignored.push_back(
          {"", say("{} texts and dimensions in all are not used.", listed_)});
  }

 private:
  Place part_place(const Place& p) const {
    const Place local = view_.axis.local(p);
    return {local.x - z0_, local.y};
  }

  void ignore(const Dimension& d, const std::string& shown, const std::string& why) {
    list(d.name, say("The dimension \"{}\" {}.",
                     shown.empty() ? tr("of the measured size") : shown, why));
  }

  void add(const Dimension& d) {
    const std::string shown = shown_text(d.text);
    auto words = said(shown);
    if (!words) return ignore(d, shown, tr("has words that are not understood"));
    if (d.limits && !words->demands.fit && !words->demands.limits)
      words->demands.limits = d.limits;  // in mm already
    else if (words->demands.limits)
      words->demands.limits = {view_.drawn->unit_mm * words->demands.limits->lower_mm,
                               view_.drawn->unit_mm * words->demands.limits->upper_mm};
    const Place a = part_place(d.first), b = part_place(d.second);
    Place along = b - a;
    if (d.kind == Dimension::Kind::linear) {
      const Place u{std::cos(d.angle_rad), std::sin(d.angle_rad)};
      along = {dot(u, view_.axis.u), cross(view_.axis.u, u)};
    }
    const bool measured =
        d.kind == Dimension::Kind::linear || d.kind == Dimension::Kind::aligned;
    if (!measured || !(length(along) > 0))
      return ignore(d, shown, tr("does not measure a diameter or a length"));
    const double size = length(along);
    if (std::abs(along.x) <= kDirection * size)
      return add_diameter(d, shown, *words, a, b);
    if (std::abs(along.y) <= kDirection * size) return add_length(d, shown, *words, a, b);
    ignore(d, shown, tr("is neither along the axis nor across it"));
  }

  // Whether the text has the size that is drawn, or none.
  bool drawn_size(const Dimension& d, const std::string& shown, const Said& words,
                  double drawn_mm) {
    if (!words.size) return true;
    const double says_mm = *words.size * (words.thread ? 1 : view_.drawn->unit_mm);
    if (std::abs(says_mm - drawn_mm) <= kSameSize * drawn_mm) return true;
    ignore(d, shown, say("does not say the drawn size, {:.6g} mm", drawn_mm));
    return false;
  }

  static bool asks(const Said& words) {
    const Demands& d = words.demands;
    return words.thread || d.fit || d.limits || d.Ra_um || d.Rz_um;
  }

  void add_diameter(const Dimension& d, const std::string& shown, const Said& words,
                    const Place& a, const Place& b) {
    const double r = std::max(std::abs(a.y), std::abs(b.y));
    const bool both = std::abs(a.y + b.y) <= within_;
    const bool one = std::min(std::abs(a.y), std::abs(b.y)) <= within_ && words.diameter;
    if (!both && !one)
      return asks(words) ? ignore(d, shown, tr("does not measure from side to side"))
                         : void();
    if (!drawn_size(d, shown, words, 2 * r) || !asks(words)) return;
    std::vector<Element*> on;
    const auto lies_on = [&](const Placed& p, const Place& at) {
      return std::abs(at.y) <= within_ ||
             (at.x >= p.z0_mm - within_ && at.x <= p.z1_mm + within_);
    };
    for (const Placed& p : placed_)
      if (p.element->left_mm == p.element->right_mm &&
          std::abs(p.element->left_mm / 2 - r) <= within_ && lies_on(p, a) &&
          lies_on(p, b))
        on.push_back(p.element);
    if (on.size() != 1)
      return ignore(
          d, shown,
          on.empty() ? tr("lies on no cylinder") : tr("lies on more than one cylinder"));
    give(d, shown, words, *on[0]);
  }

  void give(const Dimension& d, const std::string& shown, const Said& words, Element& e) {
    Demands& has = e.demands;
    const Demands& asked = words.demands;
    if ((has.fit || has.limits) && (asked.fit || asked.limits))
      return ignore(d, shown, say("asks for a second size of {}", e.id));
    if (words.thread && e.shape == Shape::cylinder) {
      e.shape = Shape::thread;
      e.pitch_mm = words.pitch;
    }
    if (asked.fit) has.fit = asked.fit;
    if (asked.limits) has.limits = asked.limits;
    if (asked.Ra_um) has.Ra_um = asked.Ra_um;
    if (asked.Rz_um) has.Rz_um = asked.Rz_um;
    e.sources.push_back(d.name);
  }

  std::string face_at(double z_mm) const {
    if (std::abs(z_mm) <= within_) return "left";
    for (std::size_t i = 0; i < out_.outer.size(); ++i) {
      if (std::abs(z_mm - placed_[i].z1_mm) > within_) continue;
      if (i + 1 == out_.outer.size()) return "right";
      if (std::abs(out_.outer[i].right_mm - out_.outer[i + 1].left_mm) > within_)
        return out_.outer[i].id + '|' + out_.outer[i + 1].id;
    }
    return "";
  }

  void add_length(const Dimension& d, const std::string& shown, const Said& words,
                  const Place& a, const Place& b) {
    if (!drawn_size(d, shown, words, std::abs(b.x - a.x)) || !asks(words)) return;
    const std::string from = face_at(std::min(a.x, b.x)),
                      to = face_at(std::max(a.x, b.x));
    if (from.empty() || to.empty() || from == to)
      return ignore(d, shown, tr("does not measure between two faces"));
    if (!words.demands.limits || words.diameter || words.thread || words.demands.Ra_um ||
        words.demands.Rz_um)
      return ignore(d, shown, tr("asks something that a length cannot have"));
    part::Tolerance t;
    t.id = fmt::format("t{}", out_.tolerances.size() + 1);
    t.kind = part::ToleranceKind::length;
    t.between = {from, to};
    t.limits = words.demands.limits;
    t.value_mm = t.limits->upper_mm - t.limits->lower_mm;
    out_.tolerances.push_back(std::move(t));
  }

  void add(const Note& n) {
    static const Pattern kGeneral("ISO *2768 *- *([fmcv][HKL]?|[HKL])");
    constexpr std::size_t kLongest = 1000;  // of a text that is searched and listed
    const std::string shown =
        std::string(notated::beginning(shown_text(n.text), kLongest));
    const auto m =
        shown.find("2768") != std::string::npos ? kGeneral.find_in(shown) : std::nullopt;
    if (m && out_.general.empty())
      out_.general = "ISO 2768-" + (*m)[1];
    else
      list(n.name, say("The text \"{}\" is left to the reader.", shown));
  }

  void list(const std::string& at, std::string sentence) {
    if (++listed_ <= kMostListed) out_.ignored.push_back({at, std::move(sentence)});
  }

  Outline& out_;
  const View& view_;
  double z0_, within_;
  std::size_t listed_ = 0;
  std::vector<Placed> placed_;
};

}  // namespace

void add_dimensions(Outline& out, const View& view, double z0_mm, double join_mm) {
  Dimensions(out, view, z0_mm, join_mm).add();
}

}  // namespace turnwright::exchange::dxf
