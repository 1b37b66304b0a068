#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <unordered_map>

#include "running_ids.hpp"
#include "turnwright/exchange/notation.hpp"
#include "turnwright/part/inch_thread.hpp"

namespace turnwright::exchange {
namespace {

// The shortest decimal number that is read as x again.
std::string digits(double x) {
  std::array<char, 800> text{};  // 309 before the point, 1074 after it at most
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x == 0 ? 0 : x,
                                 std::chars_format::fixed);
  return {text.data(), end.ptr};
}

std::string deviation(double x) {
  return fmt::format("{}{}", x > 0 ? "+" : "", digits(x));
}

std::string limits_text(const part::Limits& l) {
  if (l.lower_mm == -l.upper_mm) return "±" + digits(l.upper_mm);
  return deviation(l.upper_mm) + "/" + deviation(l.lower_mm);
}

std::string size_text(const Demands& d) {
  if (d.fit) return ' ' + *d.fit;
  return d.limits ? ' ' + limits_text(*d.limits) : "";
}

std::string roughness_text(const Demands& d) {
  std::string out;
  if (d.Ra_um) out += " Ra" + digits(*d.Ra_um);
  if (d.Rz_um) out += " Rz" + digits(*d.Rz_um);
  return out;
}

std::string shape_text(const Element& e) {
  const std::string d = fmt::format("d{}", digits(e.left_mm));
  switch (e.shape) {
    case Shape::cylinder:
      return d;
    case Shape::cone:
      return fmt::format("cone {}-d{}", d, digits(e.right_mm));
    case Shape::arc:
      return fmt::format("arc {}-d{}", d, digits(e.right_mm));
    case Shape::groove:
      return fmt::format("groove {}", d);
    case Shape::hole:
      return fmt::format("hole {}", d);
    case Shape::as_stock:
      if (e.flats == 0) return fmt::format("stock {}", d);
      return fmt::format("stock {}{}", e.flats == 6 ? "hex" : "square",
                         digits(e.left_mm));
    case Shape::thread:
      break;
  }
  if (auto inch = part::inch_designation(e.left_mm, e.pitch_mm)) return *inch;
  return fmt::format("M{}{}", digits(e.left_mm),
                     e.pitch_mm > 0 ? fmt::format("x{}", digits(e.pitch_mm)) : "");
}

std::string element_text(const Element& e) {
  std::string out = shape_text(e) + size_text(e.demands) + " x " + digits(e.length_mm);
  if (e.shape == Shape::arc)
    out += " R" + digits(e.radius_mm) + (e.convex ? " convex" : " concave");
  if (e.knurl) out += ' ' + *e.knurl;
  out += roughness_text(e.demands);
  if (e.demands.grinding_mm) out += " grind" + digits(*e.demands.grinding_mm);
  return out + '\n';
}

std::string corner_text(const Edge& e) {
  std::string out;
  if (e.chamfer_mm) out += ' ' + digits(*e.chamfer_mm) + 'x' + digits(e.angle_deg);
  if (e.radius_mm) out += " round" + digits(*e.radius_mm);
  if (e.fillet_mm) out += " R" + digits(*e.fillet_mm);
  if (e.undercut) {  // "DIN 76-A" as one word
    out += ' ';
    std::ranges::remove_copy(*e.undercut, std::back_inserter(out), ' ');
  }
  return out;
}

// What is cut at each edge, by its name.
std::unordered_map<std::string, std::string> corners(const Outline& o) {
  std::unordered_map<std::string, std::string> out;
  for (const Edge& e : o.edges)
    if (const auto text = corner_text(e); !text.empty()) out[e.at] += text;
  return out;
}

// The corner after k outer elements.
std::string corner_after(const Outline& o, std::size_t k) {
  if (k == 0) return "left";
  if (k == o.outer.size()) return "right";
  return o.outer[k - 1].id + '|' + o.outer[k].id;
}

std::string tolerance_text(const part::Tolerance& t) {
  std::string out = part::name(t.kind);
  out +=
      ' ' + (t.kind == part::ToleranceKind::length ? t.between[0] + " to " + t.between[1]
                                                   : t.of);
  if (!t.datum.empty()) out += " to " + part::datum_words(t);
  return out + ' ' + (t.limits ? limits_text(*t.limits) : digits(t.value_mm)) + '\n';
}

// How far a cross hole goes.
std::string through_text(const Milled& m) {
  if (m.through == Milled::Through::no) return " x " + digits(m.depth_mm);
  return m.through == Milled::Through::wall ? " through wall" : " through part";
}

std::string milled_text(const Milled& m) {
  using enum Milled::Kind;
  std::string out = m.kind == flat ? "flat " : m.kind == slot ? "slot " : "keyway ";
  if (m.kind == cross_hole) {
    out = "cross-hole d" + digits(m.width_mm) + size_text(m.demands) + through_text(m);
  } else {
    if (m.kind != flat) out += digits(m.width_mm) + 'x';
    out += digits(m.depth_mm) + 'x' + digits(m.length_mm);
  }
  out += " on " + m.on + " at " + digits(m.z_mm);
  if (m.angle_deg != 0) out += " angle " + digits(m.angle_deg);
  if (m.count > 1) out += fmt::format(" times {}", m.count);
  return out + '\n';
}

std::string title_text(const char* head, std::string text) {
  if (text.empty()) return "";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const bool plain = text.find_first_of(";\"") == std::string::npos &&
                     text.front() != ' ' && text.back() != ' ';
  if (plain) return std::string(head) + ": " + text + '\n';
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '"');
  return std::string(head) + ": \"" + text + "\"\n";
}

// Without the name of the standard, in one word.
std::string centre_text(const CentreHole& c) {
  std::string size = c.designation;
  for (const char* standard : {"ISO 6411", "DIN 332"})
    if (size.starts_with(standard)) size.erase(0, size.find_first_not_of(" -", 8));
  std::erase(size, ' ');
  return std::string("centre ") + (c.at == part::End::left ? "left " : "right ") + size +
         '\n';
}

}  // namespace

std::string notation(const Outline& outline) {
  const Outline o = notated::with_running_ids(outline);
  std::string out = title_text("name", o.name) +
                    title_text("drawing", o.title.drawing_number) +
                    title_text("revision", o.title.revision) +
                    title_text("customer", o.title.customer) +
                    title_text("material", o.material) + title_text("general", o.general);
  auto at = corners(o);
  for (std::size_t k = 0; k <= o.outer.size(); ++k) {
    if (k > 0) out += element_text(o.outer[k - 1]);
    const auto corner = at.extract(corner_after(o, k));
    if (corner) out += corner.mapped().substr(1) + '\n';
  }
  for (const Element& e : o.inner)
    out += (e.from == part::End::left ? "bore left " : "bore ") + element_text(e);
  for (const Edge& e : o.edges)
    if (const auto corner = at.extract(e.at)) out += e.at + ':' + corner.mapped() + '\n';
  for (const FaceOf& f : o.faces)
    if (const auto text = roughness_text(f.demands); !text.empty())
      out += "face " + f.id + text + '\n';
  for (const auto& t : o.tolerances) out += tolerance_text(t);
  for (const Milled& m : o.milled) out += milled_text(m);
  for (const CentreHole& c : o.centre_holes) out += centre_text(c);
  return out;
}

}  // namespace turnwright::exchange
