#pragma once
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "ways.hpp"

/// The canonical moves of LinuxCNC's interpreter as ways of the tools' tips.
namespace turnwright::nc::test {

inline std::vector<double> numbers(const std::string& call) {
  std::vector<double> all;
  auto text = call.substr(call.find('(') + 1);
  for (char& c : text)
    if (c == ',' || c == ')') c = ' ';
  std::istringstream in(text);
  for (double x; in >> x;) all.push_back(x);
  return all;
}

// ARC_FEED in the ZX plane: end z, end x, centre z, centre x, turns against the clock
// from Z to X.
inline void add_arc(std::vector<Way>& ways, Way w, const std::vector<double>& a) {
  const double R = std::hypot(w.z0 - a[2], w.x0 - a[3]);
  const double from = std::atan2(w.x0 - a[3], w.z0 - a[2]);
  double to = std::atan2(a[1] - a[3], a[0] - a[2]);
  if (a[4] > 0 && to < from) to += 2 * M_PI;
  if (a[4] < 0 && to > from) to -= 2 * M_PI;
  const int n = 1 + static_cast<int>(std::abs(to - from) * R / std::sqrt(1.6e-5 * R));
  for (int i = 1; i <= n; ++i) {
    const double t = from + (to - from) * i / n;
    w.x1 = i < n ? a[3] + R * std::sin(t) : a[1];
    w.z1 = i < n ? a[2] + R * std::cos(t) : a[0];
    ways.push_back(w);
    w.x0 = w.x1;
    w.z0 = w.z1;
  }
}

inline std::vector<Way> ways_of(const std::string& canonical) {
  std::vector<Way> ways;
  Way w;
  bool known = false, in_operation = false, mills = false;
  std::istringstream in(canonical);
  for (std::string line; std::getline(in, line);) {
    const auto has = [&](const char* word) { return line.find(word) != line.npos; };
    if (has("COMMENT") && brings_centre(line)) w.centred = true;
    const auto operation = line.find("operation ");
    if (has("COMMENT") && operation != line.npos) {
      const auto from = operation + 10;
      w.operation = line.substr(from, line.find(':', from) - from);
      in_operation = true;
      mills = w.operation.find("-mill-") != w.operation.npos;
    }
    if (has("SET_FEED_RATE")) w.f_mm_rev = numbers(line)[0];
    if (has("START_SPEED_FEED_SYNC")) {
      w.thread = true;
      w.f_mm_rev = numbers(line)[0];
    }
    if (has("STOP_SPEED_FEED_SYNC")) w.thread = false;
    if (has("SET_SPINDLE_MODE"))
      std::sscanf(line.c_str() + line.find('('), "(%*d %lf", &w.n_max_rpm);
    if (has("SET_SPINDLE_SPEED")) w.S = numbers(line)[1];
    const bool traverse = has("STRAIGHT_TRAVERSE"), arc = has("ARC_FEED");
    const bool tap = has("RIGID_TAP");  // in, and back
    if (!in_operation || mills || (!traverse && !arc && !tap && !has("STRAIGHT_FEED")))
      continue;
    const auto a = numbers(line);
    w.rapid = traverse;
    const double x = arc ? a[1] : a[0], z = arc ? a[0] : a[2];
    w.x0 = known ? w.x1 : x;
    w.z0 = known ? w.z1 : z;
    known = true;
    if (arc)
      add_arc(ways, w, a);
    else if (tap) {
      Way to = w, back = w;
      to.x1 = back.x0 = x;
      to.z1 = back.z0 = z;
      back.x1 = w.x0;
      back.z1 = w.z0;
      ways.push_back(to);
      ways.push_back(back);
      w.x1 = w.x0;
      w.z1 = w.z0;
      continue;
    } else {
      w.x1 = x;
      w.z1 = z;
      ways.push_back(w);
    }
    w.x1 = x;
    w.z1 = z;
  }
  return ways;
}

}  // namespace turnwright::nc::test
