#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <string>

#include "exchange/demands/pmi.hpp"

/// PMI as text, a line each, for the tests to compare.
namespace turnwright::exchange {

/// "A B(maximum material requirement) C-D"; "" without datums.
inline std::string datums_text(const GeometricTolerance& t) {
  std::vector<std::string> all;
  for (const auto& d : t.datums) {
    auto text = fmt::format("{}", fmt::join(d.letters, "-"));
    if (!d.modifiers.empty()) text += fmt::format("({})", fmt::join(d.modifiers, ", "));
    all.push_back(std::move(text));
  }
  return fmt::format("{}", fmt::join(all, " "));
}

inline std::string faces_text(const Feature& f) {
  return fmt::format("{}{}", f.axis ? "axis of " : "", fmt::join(f.faces, " "));
}

/// "0.75 dia | A B C | #840"
inline std::string text(const GeometricTolerance& t) {
  auto out = std::string(name(t.symbol));
  out += t.width_mm ? fmt::format(" {:.6g}", *t.width_mm) : " no value";
  if (t.diametral) out += " dia";
  if (!t.modifiers.empty()) out += fmt::format(" [{}]", fmt::join(t.modifiers, ", "));
  if (!t.datums.empty()) out += " | " + datums_text(t);
  return out + " | " + faces_text(t.of);
}

/// "diameter 35 -0.2 0 | #854 #853"
inline std::string text(const Dimension& d) {
  auto out = d.name;
  out += d.nominal_mm ? fmt::format(" {:.6g}", *d.nominal_mm) : " no value";
  if (d.limits)
    out += fmt::format(" {:.6g} {:.6g}", d.limits->lower_mm, d.limits->upper_mm);
  if (!d.fit.empty()) out += " " + d.fit;
  if (!d.notes.empty()) out += fmt::format(" [{}]", fmt::join(d.notes, ", "));
  out += " | " + faces_text(d.of);
  return d.to ? out + " -> " + faces_text(*d.to) : out;
}

inline std::string text(const AngularDimension& a) {
  const auto deg = [](double rad) { return rad * 180 / std::numbers::pi; };
  auto out = a.name;
  if (a.nominal_rad) out += fmt::format(" {:.6g} deg", deg(*a.nominal_rad));
  if (a.lower_rad && a.upper_rad)
    out += fmt::format(" {:.6g} {:.6g}", deg(*a.lower_rad), deg(*a.upper_rad));
  return out;
}

inline std::string text(const Pmi& pmi) {
  std::string out;
  for (const auto& d : pmi.dimensions) out += text(d) + "\n";
  for (const auto& a : pmi.angles) out += text(a) + "\n";
  for (const auto& t : pmi.tolerances) out += text(t) + "\n";
  for (const auto& d : pmi.datums)
    out += fmt::format("datum {}{} | {}\n", d.letter, d.targets ? " by targets" : "",
                       faces_text(d.of));
  for (const auto& t : pmi.textures)
    out += fmt::format("{} {:.6g} um | {}\n", t.parameter, t.value_um, faces_text(t.of));
  out += fmt::format("part \"{}\" \"{}\" revision \"{}\" material \"{}\"\n",
                     pmi.part_number, pmi.part_name, pmi.revision, pmi.material);
  for (const auto& r : pmi.unread) out += r.at + ": " + r.text + "\n";
  return out;
}

}  // namespace turnwright::exchange
