#include <fmt/format.h>

#include <array>
#include <map>
#include <numbers>

#include "base/say.hpp"
#include "dxf_strokes.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr std::size_t kMostStrokes = 5000, kDeepestBlock = 16;
constexpr std::size_t kMostEntities = 2'000'000;   // with those of blocks drawn out
constexpr std::size_t kMostRepeated = 50'000'000;  // bytes of blocks drawn out

bool is_curve(std::string_view type) {
  return type == "LINE" || type == "ARC" || type == "LWPOLYLINE" || type == "POLYLINE";
}

// Only these have coordinates of their own; lines stand in those of the drawing.
bool has_own_coordinates(const Entity& e) {
  constexpr long kSpatial = 8;
  return e.type != "LINE" && e.type != "DIMENSION" && e.type != "SPLINE" &&
         !(e.type == "POLYLINE" && (e.integer_or(70, 0) & kSpatial) != 0);
}

// A block that is being drawn out.
struct Frame {
  const std::vector<Entity>* entities = nullptr;
  const Block* block = nullptr;  ///< none: the drawing itself
  std::size_t next = 0;
  Affine to_mm;
  std::string layer, linetype;  ///< of the INSERT, for what is drawn BYBLOCK
};

class Drawing {
 public:
  Drawing(const File& file, std::optional<double> unit) : file_(file) {
    const double mm = unit ? *unit : unit_mm(file, out_.assumed);
    if (!(mm > 0 && mm < 1e6))
      refuse("unit_mm", fmt::format("{}", mm), tr("a length > 0"));
    out_.unit_mm = mm;
    frames_.push_back({&file.entities, nullptr, 0, {mm, 0, 0, mm, 0, 0}, "0", ""});
  }

  Drawn draw() {
    std::size_t count = 0;
    while (!frames_.empty()) {
      Frame& f = frames_.back();
      if (f.next == f.entities->size()) {
        frames_.pop_back();
        continue;
      }
      if (++count > kMostEntities)
        refuse("", say("more than {} entities", kMostEntities),
               tr("the drawing of one part"));
      leave_if_asked();
      const Entity& e = (*f.entities)[f.next++];
      if (f.block) repeat(e.body.size());
      add(e);
    }
    for (const auto& [text, n] : left_out_)
      out_.ignored.push_back({"", say("{} x {}: not read.", n, text)});
    return std::move(out_);
  }

 private:
  const Frame& frame() const { return frames_.back(); }

  // Counts bytes that a short file can have read, or kept, again and again.
  void repeat(std::size_t bytes) {
    repeated_ += bytes;
    if (repeated_ > kMostRepeated)
      refuse("", say("more than {} MB with the blocks drawn out", kMostRepeated / 1e6),
             tr("the drawing of one part"));
  }

  void add(const Entity& e) {
    std::string_view layer_name = "0", linetype_name = "BYLAYER";
    Groups groups = e.groups();
    for (auto g = groups.next(); g && g->code != 0; g = groups.next()) {
      if (g->code == 67 && integer(*g) == 1)
        return leave(tr("entity of the paper space"));
      if (g->code == 60 && integer(*g) == 1) return leave(tr("invisible entity"));
      if (g->code == 8) layer_name = g->value;
      if (g->code == 6) linetype_name = g->value;
    }
    std::string layer = capital(layer_name), linetype = capital(linetype_name);
    if (layer == "0") {
      layer = frame().layer;
      repeat(layer.size());
    }
    const auto known = file_.layers.find(layer);
    if (known != file_.layers.end() && !known->second.visible)
      return leave(say("entity of the hidden layer {}", layer));
    if (linetype == "BYBLOCK") {
      linetype = frame().linetype;
      repeat(linetype.size());
    }
    if (linetype == "BYLAYER" || linetype.empty()) {
      linetype = known == file_.layers.end() ? "" : capital(known->second.linetype);
      repeat(linetype.size());
    }
    const Role role = role_of(layer, linetype);
    if (is_curve(e.type))
      add_curve(e, role);
    else if (e.type == "INSERT")
      add_insert(e, layer, linetype);
    else if (e.type == "DIMENSION")
      add_dimension(e);
    else if (e.type == "TEXT" || e.type == "MTEXT" || e.type == "TOLERANCE")
      add_note(e);
    else
      leave_or_refuse(e, role);
  }

  void leave(const std::string& what) { ++left_out_[what]; }

  void leave_or_refuse(const Entity& e, Role role) {
    const bool curved = e.type == "SPLINE" || e.type == "ELLIPSE";
    if (curved && (role == Role::contour || role == Role::hidden))
      refuse(e.name(), say("{} in the contour", e.type),
             tr("lines and arcs of circles; other curves on a layer of their own"));
    leave(std::string(e.type));
  }

  // With the mirrored coordinates of what is seen from behind.
  Affine placed(const Entity& e) const {
    if (!has_own_coordinates(e)) return frame().to_mm;
    constexpr double kTilt = 1e-6;
    const double x = e.number_or(210, 0), y = e.number_or(220, 0),
                 z = e.number_or(230, 1);
    if (std::abs(x) > kTilt || std::abs(y) > kTilt)
      refuse(e.name(), tr("an extrusion out of the drawing's plane"),
             tr("a plane drawing"));
    return z < 0 ? frame().to_mm.after({-1, 0, 0, 1, 0, 0}) : frame().to_mm;
  }

  void add_curve(const Entity& e, Role role) {
    if (role == Role::other) return leave(say("{} of a layer for notes", e.type));
    Stroke form;
    form.role = role;
    form.source = static_cast<std::uint32_t>(out_.sources.size());
    out_.sources.push_back(&e);
    add_strokes(e, placed(e), form, out_.strokes);
    if (out_.strokes.size() > kMostStrokes)
      refuse(e.name(), say("more than {} lines and arcs", kMostStrokes),
             tr("the contour of one part; other views on layers that are off"));
  }

  void add_insert(const Entity& e, const std::string& layer,
                  const std::string& linetype) {
    const auto block = file_.blocks.find(capital(e.text_or(2, "")));
    if (block == file_.blocks.end())
      refuse(e.name(), say("no block {}", e.text_or(2, "")), tr("a block of the file"));
    for (const Frame& f : frames_)
      if (f.block == &block->second)
        refuse(e.name(), say("block {} within itself", block->first),
               tr("blocks that do not insert themselves"));
    if (frames_.size() > kDeepestBlock)
      refuse(e.name(), say("blocks nested more than {} deep", kDeepestBlock),
             tr("fewer"));
    if (e.integer_or(70, 1) > 1 || e.integer_or(71, 1) > 1)
      refuse(e.name(), tr("an array of blocks"), tr("single ones"));
    const double angle = units::rad_from_deg(e.number_or(50, 0));
    const double c = std::cos(angle), s = std::sin(angle);
    const double sx = e.number_or(41, 1), sy = e.number_or(42, 1);
    if (!(sx != 0 && sy != 0)) refuse(e.name(), tr("a scale of 0"), tr("another"));
    Affine place{c * sx, s * sx, -s * sy, c * sy, e.number_or(10, 0), e.number_or(20, 0)};
    place = place.after({1, 0, 0, 1, -block->second.x, -block->second.y});
    const Affine to_mm = placed(e).after(place);
    frames_.push_back(
        {&block->second.entities, &block->second, 0, to_mm, layer, linetype});
  }

  void add_dimension(const Entity& e) {
    if (frame().block) repeat(sizeof(Dimension));
    const Affine& to_mm = frame().to_mm;
    constexpr long kKind = 7;
    Dimension d;
    const auto point = [&](int code) {
      return to_mm({e.number_or(code, 0), e.number_or(code + 10, 0)});
    };
    d.name = e.name();
    d.text = std::string(e.text_or(1, ""));
    d.first = point(13);
    d.second = point(14);
    switch (e.integer_or(70, 0) & kKind) {
      case 0:
        d.kind = Dimension::Kind::linear;
        d.angle_rad =
            units::rad_from_deg(e.number_or(50, 0)) + std::atan2(to_mm.b, to_mm.a);
        break;
      case 1:
        d.kind = Dimension::Kind::aligned;
        break;
      default:
        break;
    }
    d.limits = limits_of_style(e, std::hypot(to_mm.a, to_mm.b));
    out_.dimensions.push_back(std::move(d));
  }

  // DIMTOL, DIMTP, DIMTM (71, 47, 48) where the dimension has its own.
  static std::optional<part::Limits> limits_of_style(const Entity& e, double mm) {
    long variable = 0;
    bool style = false, on = false;
    part::Limits limits;
    Groups groups = e.groups();
    while (const auto g = groups.next()) {
      if (g->code == 1000) style = g->value == "DSTYLE";
      if (!style) continue;
      if (g->code == 1070 && variable == 71)
        on = integer(*g) != 0, variable = 0;
      else if (g->code == 1070 && variable == 0)
        variable = integer(*g);
      else if (g->code == 1040 && variable == 47)
        limits.upper_mm = number(*g) * mm, variable = 0;
      else if (g->code == 1040 && variable == 48)
        limits.lower_mm = -number(*g) * mm, variable = 0;
      else if (g->code > 1002)
        variable = 0;
    }
    if (!on || !(limits.lower_mm < limits.upper_mm)) return std::nullopt;
    return limits;
  }

  // A text of more than 250 bytes stands in pieces before its last one.
  void add_note(const Entity& e) {
    if (frame().block) repeat(sizeof(Note));
    std::string text;
    Groups groups = e.groups();
    while (const auto g = groups.next()) {
      if (g->code == 0) break;
      if (g->code == 3 && e.type == "MTEXT") text += g->value;
      if (g->code == 1) text += g->value;
    }
    const Affine to_mm = placed(e);
    out_.notes.push_back(
        {to_mm({e.number_or(10, 0), e.number_or(20, 0)}), std::move(text), e.name()});
  }

  const File& file_;
  Drawn out_;
  std::vector<Frame> frames_;
  std::size_t repeated_ = 0;
  std::map<std::string, std::size_t> left_out_;
};

}  // namespace

Drawn draw(const File& file, std::optional<double> unit_mm) {
  return Drawing(file, unit_mm).draw();
}

}  // namespace turnwright::exchange::dxf
