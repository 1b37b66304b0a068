#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

/// Parts as nobody would draw them on purpose: steps, cones, arcs, grooves and threads in
/// any order outside, bores from either end inside.
namespace turnwright::nc::test {

/// How many are tried: as many as TURNWRIGHT_RANDOM_PARTS says, if it is set.
inline int parts_to_try(int otherwise) {
  const char* given = std::getenv("TURNWRIGHT_RANDOM_PARTS");
  return given ? std::atoi(given) : otherwise;
}

/// Where the limits of their sizes lie: fits from the size on, or now about it, below or
/// above it; beside arcs, which stand as drawn, about it.
enum class SizeLimits { fits, aside };

class RandomPart {
 public:
  explicit RandomPart(std::uint32_t seed, SizeLimits limits = SizeLimits::fits)
      : size_limits_(limits),
        random_(seed),
        tube_(below(3) == 0),
        bored_(tube_ || below(4) == 0) {}

  nlohmann::json document() {
    outer();
    const int left = below(3), right = below(3);
    const double stock_mm = most_mm_ + 1 + below(6);
    json stock{{"length_mm", length_mm_ + left + right}, {"left_allowance_mm", left}};
    if (tube_)
      stock.update({{"kind", "tube"}, {"outer_mm", stock_mm}, {"inner_mm", kHole_mm}});
    else
      stock.update({{"kind", "bar"}, {"diameter_mm", stock_mm}});
    json d{{"format", "turnwright-part/1"},
           {"name", "Random part"},
           {"material", "C45"},
           {"stock", stock},
           {"outer", outer_},
           {"machine", "lathe-medium"},
           {"setups",
            {{{"hold", "left"}, {"grip_mm", 12}, {"clampings", {"chuck"}}},
             {{"hold", "right"}, {"grip_mm", 12}, {"clampings", {"chuck"}}}}},
           {"damping_ratio", 0.4}};
    if (bored_) d["inner"] = inner();
    if (below(2)) d["faces"] = faces();
    if (below(2)) d["edges"] = edges();
    if (bored_ && below(2)) d["tolerances"] = depths(d["inner"]);
    return d;
  }

 private:
  using json = nlohmann::json;
  struct Body {
    bool thread;
    double D_mm;
  };
  static constexpr int kHole_mm = 30;

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  void add(const char* kind, int length_mm, const json& more) {
    json e{{"id", "e" + std::to_string(outer_.size() + 1)},
           {"kind", kind},
           {"length_mm", length_mm}};
    e.update(more);
    outer_.push_back(e);
    length_mm_ += length_mm;
  }

  Body body() {
    if (below(5) == 0) return {true, bored_ ? 56.0 : below(2) ? 30.0 : 36.0};
    return {false, (bored_ ? 50.0 : 26.0) + 2 * below(14)};
  }

  // Cylinders and threads with something or nothing between them, most of them rising
  // towards one place.
  void outer() {
    std::vector<Body> bodies(static_cast<std::size_t>(2 + below(4)));
    for (auto& b : bodies) b = body();
    const auto smaller = [](const Body& a, const Body& b) { return a.D_mm < b.D_mm; };
    if (below(4)) {
      const auto top = bodies.begin() + below(static_cast<int>(bodies.size()));
      std::sort(bodies.begin(), top, smaller);
      std::sort(top, bodies.end(),
                [&](const Body& a, const Body& b) { return smaller(b, a); });
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto& b = bodies[i];
      most_mm_ = std::max(most_mm_, b.D_mm);
      if (i > 0) between(bodies[i - 1].D_mm, b.D_mm);
      json e{{"diameter_mm", b.D_mm}};
      if (b.thread) e["pitch_mm"] = 1 + 0.5 * below(3);
      if (!b.thread && below(2)) e.update(limits("h9", i));
      if (!b.thread && below(2)) e["Ra_um"] = 3.2;
      add(b.thread ? "thread" : "cylinder", 14 + below(22), e);
    }
    for (std::size_t i = 0; i < outer_.size(); ++i)
      for (const std::size_t beside : {i - 1, i + 1})
        if (outer_[i]["kind"] == "arc" && beside < outer_.size() &&
            outer_[beside].contains("limits_mm"))
          outer_[beside].update(limits("h9", 0));
  }

  void between(double a, double b) {
    if (std::abs(a - b) > 4 && below(4) == 0) {  // cones and arcs side by side
      const double middle = std::round((a + b) / 2);
      between(a, middle, 1 + below(3));
      between(middle, b, 1 + below(3));
    } else {
      between(a, b, below(5));
    }
  }

  void between(double a, double b, int kind) {
    if (kind == 0) {
      json e{{"diameter_mm", std::min(a, b) - 2 - below(3)}};
      if (size_limits_ == SizeLimits::aside) e["limits_mm"] = {-0.4, 0};
      add("groove", 3 + below(2), e);
    } else if (kind == 1 && a != b) {
      add("cone", 4 + below(20), {{"left_mm", a}, {"right_mm", b}});
    } else if (kind == 2 || kind == 3) {
      const int length = 3 + below(8);
      const double h = std::abs(a - b) / 2, l = length;
      // From a quarter of a circle, or as much as there is, to nearly straight.
      const double least = (l * l + h * h) / (2 * std::min(std::max(h, 0.2 * l), l));
      const bool convex = below(2) == 1;
      const double R = std::ceil(10 * least) / 10 + 0.5 * below(8);
      if (convex) most_mm_ = std::max(most_mm_, std::max(a, b) + l / 2);
      add("arc", length,
          {{"left_mm", a},
           {"right_mm", b},
           {"radius_mm", R},
           {"bulge", convex ? "convex" : "concave"}});
    }
  }

  // Chamfers on some steps between cylinders and threads, and at the ends; steep ones of
  // cylinders are rounded edges instead.
  json edges() {
    json all = json::array();
    const auto turned = [](const json& e) {
      return e["kind"] == "cylinder" || e["kind"] == "thread";
    };
    const auto add = [&](const std::string& at, double most_mm, const json& of) {
      const double angles[] = {45, 45, 30, 60}, angle = angles[below(4)];
      const double mm = 0.25 * (1 + below(8));
      if (!(mm * std::tan(angle * std::acos(-1) / 180) < most_mm && below(4))) return;
      if (angle == 60 && of["kind"] == "cylinder" && mm + 0.9 < most_mm)
        all.push_back({{"at", at}, {"radius_mm", mm}});
      else
        all.push_back({{"at", at}, {"chamfer_mm", mm}, {"angle_deg", angle}});
    };
    if (turned(outer_.front())) add("left", 3, outer_.front());
    if (turned(outer_.back())) add("right", 3, outer_.back());
    for (std::size_t i = 1; i < outer_.size(); ++i) {
      const auto &a = outer_[i - 1], &b = outer_[i];
      if (!turned(a) || !turned(b)) continue;
      const double step =
          std::abs(a["diameter_mm"].get<double>() - b["diameter_mm"].get<double>()) / 2;
      add(a["id"].get<std::string>() + "|" + b["id"].get<std::string>(), step - 0.1,
          a["diameter_mm"] > b["diameter_mm"] ? a : b);
    }
    return all;
  }

  json limits(const char* fit, std::size_t i) const {
    if (size_limits_ == SizeLimits::fits) return {{"fit", fit}};
    constexpr std::array<std::pair<double, double>, 3> kAside_mm{
        {{-0.05, 0.05}, {-0.25, -0.1}, {0.1, 0.3}}};
    return {{"limits_mm", kAside_mm[i % kAside_mm.size()]}};
  }

  // A through hole, stepped from its ends towards the inside.
  json inner() {
    json all = json::array();
    const auto add = [&](const char* from, const char* kind, int length_mm, int D_mm) {
      json b{{"id", "b" + std::to_string(all.size() + 1)},
             {"kind", kind},
             {"from", from},
             {"length_mm", length_mm},
             {"diameter_mm", D_mm}};
      if (b["kind"] == "thread") b["pitch_mm"] = 1.5;
      if (b["kind"] == "cylinder" && below(2)) b.update(limits("H9", all.size()));
      all.push_back(b);
    };
    const int left = below(2) ? 10 + below(10) : 0, rest = length_mm_ - left;
    const int D = kHole_mm + 4 + below(3), groove = below(2) ? 3 : 0;
    add("right", below(3) ? "cylinder" : "thread", rest / 2, D);
    if (groove) add("right", "groove", groove, D + 2);
    add("right", "cylinder", rest - rest / 2 - groove, D - 2 - below(2));
    if (left) add("left", "cylinder", left, D - below(3));
    return all;
  }

  // From the ends to the shoulders between bores; bores from both ends meet.
  json depths(const json& inner) {
    json all = json::array();
    const auto add = [&](const std::string& end, const json& wide, const json& narrow) {
      if (narrow["kind"] != "cylinder" || wide["kind"] == "groove" ||
          !(wide["diameter_mm"] > narrow["diameter_mm"]))
        return;
      const double half = 0.05 * (1 + below(2));
      all.push_back(
          {{"id", "depth-" + end},
           {"kind", "length"},
           {"between",
            {end, wide["id"].get<std::string>() + "|" + narrow["id"].get<std::string>()}},
           {"limits_mm", {-half, half}}});
    };
    const bool from_left = inner.back()["from"] == "left";
    const auto& last = inner[inner.size() - (from_left ? 2 : 1)];
    const auto& before = inner[inner.size() - (from_left ? 3 : 2)];
    add("right", before, last);
    if (from_left) add("left", inner.back(), last);
    return all;
  }

  json faces() {
    json all{{{"id", "left"}, {"Ra_um", 3.2}}, {{"id", "right"}, {"Ra_um", 3.2}}};
    for (std::size_t i = 0; i + 1 < outer_.size(); ++i) {
      const auto &a = outer_[i], &b = outer_[i + 1];
      if (a["kind"] == "cylinder" && b["kind"] == "cylinder" &&
          a["diameter_mm"] != b["diameter_mm"] && below(2))
        all.push_back(
            {{"id", a["id"].get<std::string>() + "|" + b["id"].get<std::string>()},
             {"Ra_um", 3.2}});
    }
    return all;
  }

  SizeLimits size_limits_;
  std::mt19937 random_;
  bool tube_, bored_;
  json outer_ = json::array();
  int length_mm_ = 0;
  double most_mm_ = 0;
};

/// The same part forged: stock a few millimetres above each of its elements, steps of it up
/// to 3 mm before its shoulders, ends with draft.
inline nlohmann::json forged(nlohmann::json document, std::uint32_t seed) {
  using json = nlohmann::json;
  std::mt19937 random(seed);
  const auto below = [&](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  struct Piece {
    double length_mm, D_mm;
  };
  std::vector<Piece> pieces;
  const auto& outer = document["outer"];
  const auto drawn_mm = [&](std::size_t i) {
    const auto& e = outer[i];
    if (e.contains("diameter_mm")) return e["diameter_mm"].get<double>();
    const double larger =
        std::max(e["left_mm"].get<double>(), e["right_mm"].get<double>());
    return larger + (e["kind"] == "arc" ? e["length_mm"].get<double>() : 0);
  };
  for (std::size_t i = 0; i < outer.size(); ++i) {
    double left = 0, right = 0;  // grooves and necks are cut from what is beside them
    for (std::size_t k = 0; k < outer.size(); ++k)
      (k < i ? left : right) = std::max(k < i ? left : right, drawn_mm(k));
    const double D = std::max(drawn_mm(i), std::min(left, right));
    pieces.push_back({outer[i]["length_mm"].get<double>(), D + 3 + below(8)});
  }
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const bool rises = pieces[i].D_mm > pieces[i - 1].D_mm;
    auto &larger = pieces[rises ? i : i - 1], &smaller = pieces[rises ? i - 1 : i];
    const double by = std::min<double>(below(4), smaller.length_mm / 4);
    larger.length_mm += by;
    smaller.length_mm -= by;
  }
  auto& stock = document["stock"];
  const double left = stock["left_allowance_mm"].get<double>();
  double length = 0;
  for (const auto& e : outer) length += e["length_mm"].get<double>();
  pieces.front().length_mm += left;
  pieces.back().length_mm += stock["length_mm"].get<double>() - length - left;
  json outline = json::array();
  for (const auto& p : pieces)
    outline.push_back({{"length_mm", p.length_mm}, {"diameter_mm", p.D_mm}});
  const auto draft = [&](json& piece, const char* end, const char* other) {
    const double D = piece["diameter_mm"].get<double>();
    piece.erase("diameter_mm");
    piece.update({{end, D}, {other, D + 1 + below(2)}});
  };
  if (below(2)) draft(outline.back(), "right_mm", "left_mm");
  json blank{{"kind", "forging"},
             {"outline", outline},
             {"limits_mm", {-0.5 * below(3), 0.5 + 0.5 * below(2)}},
             {"left_allowance_mm", left}};
  if (stock.contains("inner_mm")) blank["inner_mm"] = stock["inner_mm"];
  stock = blank;
  return document;
}

}  // namespace turnwright::nc::test
