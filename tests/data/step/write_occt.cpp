// Writes a part of parts/ as STEP with Open CASCADE: its half profile is turned about the
// axis with its centre holes, keyways and flats are cut.  Prints the volume in mm3 before these.
//
//   write_occt PART.json OUT.step [unit MM|INCH] [schema AP214|AP242]
//              [placed 0|1] [halves 0|1]
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using nlohmann::json;

namespace {

struct P {
  double z, r;
};
struct Seg {
  P to;
  bool arc = false;
  P middle{};
};
struct Band {
  double z0, z1, r0, r1, R = 0;  // R: of an arc, negative if concave
  std::string id;
};

struct Part {
  json j;
  double length = 0;
  std::vector<Band> outer, inner;  // inner from left to right, all the bore

  explicit Part(const std::string& file) : j(json::parse(std::ifstream(file))) {
    for (const auto& e : j["outer"]) {
      auto b = band(e, length);
      length = b.z1;
      outer.push_back(b);
    }
    double l = 0, r = length;
    std::vector<Band> left, right;
    for (const auto& e : j.value("inner", json::array())) {
      const double n = e["length_mm"];
      if (e["from"] == "left")
        left.push_back(band(e, l)), l += n;
      else
        right.insert(right.begin(), band(e, r - n)), r -= n;
    }
    const double tube = j["stock"].value("inner_mm", 0.0);
    inner = left;
    if (r - l > 1e-9 && tube > 0) inner.push_back({l, r, tube / 2, tube / 2, 0, "tube"});
    inner.insert(inner.end(), right.begin(), right.end());
  }

  static Band band(const json& e, double z) {
    Band b{z, z + e["length_mm"].get<double>(), 0, 0, 0, e["id"]};
    if (e.contains("designation")) {
      b.r0 = b.r1 = std::stod(e["designation"].get<std::string>().substr(1)) / 2;
    } else if (e.contains("left_mm")) {
      b.r0 = e["left_mm"].get<double>() / 2, b.r1 = e["right_mm"].get<double>() / 2;
    } else {
      b.r0 = b.r1 = e["diameter_mm"].get<double>() / 2;
    }
    if (e.contains("radius_mm"))
      b.R = e["radius_mm"].get<double>() * (e["bulge"] == "concave" ? -1 : 1);
    return b;
  }

  double edge(const std::string& at, const char* key, double otherwise = 0) const {
    for (const auto& e : j.value("edges", json::array()))
      if (e["at"] == at && e.contains(key)) return e[key];
    return otherwise;
  }
  // Of a chamfer, on the radius.
  double radial(const std::string& at) const {
    return edge(at, "chamfer_mm") * std::tan(edge(at, "angle_deg", 45) * M_PI / 180);
  }
  struct Undercut {
    double depth, radius, width, falls_deg;
  };
  // DIN 509's E0.8x0.3; DIN 76 of the pitches 1.5 and 3.5 mm.
  std::optional<Undercut> undercut(const std::string& at, double d) const {
    for (const auto& e : j.value("edges", json::array())) {
      if (e["at"] != at || !e.contains("undercut")) continue;
      const std::string form = e["undercut"];
      if (form == "E0.8x0.3") return Undercut{0.3, 0.8, 2.5, 15};
      const bool regular = form == "DIN 76-A";
      if (d == 24) return Undercut{2.3 / 2, 0.8, regular ? 5.2 : 3.8, 30};
      if (d == 30) return Undercut{5.0 / 2, 1.6, regular ? 12.0 : 9.0, 30};
      throw std::runtime_error(form);
    }
    return std::nullopt;
  }

  static P circle(P c, double R, double deg) {
    return {c.z + R * std::cos(deg * M_PI / 180), c.r + R * std::sin(deg * M_PI / 180)};
  }

  // What a band does at its right end (side 1) or its left (side -1), from the band
  // outwards, ending on the wall.
  std::vector<Seg> corner(P at, double neighbour, int side,
                          const std::string& name) const {
    const double c = edge(name, "chamfer_mm"), f = edge(name, "fillet_mm");
    if (neighbour < at.r && c > 0)
      return {{{at.z - side * c, at.r}}, {{at.z, at.r - radial(name)}}};
    const auto u = neighbour > at.r ? undercut(name, 2 * at.r) : std::nullopt;
    if (u) {
      const auto [t, rho, width, falls] = *u;
      const double run = t / std::tan(falls * M_PI / 180);
      const P centre{at.z - side * rho, at.r - t + rho};
      return {{{at.z - side * width, at.r}},
              {{at.z - side * (width - run), at.r - t}},
              {{at.z - side * rho, at.r - t}},
              {{at.z, at.r - t + rho}, true, circle(centre, rho, side > 0 ? -45 : -135)}};
    }
    if (neighbour > at.r && f > 0) {
      const P centre{at.z - side * f, at.r + f};
      return {{{at.z - side * f, at.r}},
              {{at.z, at.r + f}, true, circle(centre, f, side > 0 ? -45 : -135)}};
    }
    return {{at}};
  }

  // A centre hole of ISO 6411 from its mouth inwards; `in` leads into the part.
  std::vector<Seg> centre_hole(const char* at, double z, double in) const {
    std::string text;
    for (const auto& c : j.value("centre_holes", json::array()))
      if (c["at"] == at) text = c["designation"];
    if (text.empty()) return {};
    const char form = text[0];
    const double r = std::stod(text.substr(1)) / 2,
                 R = std::stod(text.substr(text.find('/') + 1)) / 2;
    const double slope = std::tan(M_PI / 6), cone = form == 'B' ? seat(2 * r) / 2 : R;
    std::vector<Seg> path{{{z, R}}};
    if (form == 'B') path.push_back({{z += in * (R - cone) * slope, cone}});
    z += in * (cone - r) / slope;
    Seg flank{{z, r}};
    if (form == 'R') {
      // Upright on the middle of the chord, out of the material.
      const double chord = (R - r) / std::sin(M_PI / 6), rho = 5 * r;
      const double up = rho - std::sqrt(rho * rho - chord * chord / 4);
      flank.arc = true;
      flank.middle = {z - in * (R - r) / slope / 2 - in * up / 2,
                      (R + r) / 2 - up * std::cos(M_PI / 6)};
    }
    path.push_back(flank);
    path.push_back({{z += in * 2.5 * r, r}});
    path.push_back({{z + in * r * slope, 0}});
    return path;
  }

  // D2 of ISO 6411.
  static double seat(double d) {
    for (const auto& [pilot, wide] : {std::pair{2.5, 5.3}, {4.0, 8.5}, {5.0, 10.6}})
      if (pilot == d) return wide;
    throw std::runtime_error("centre hole");
  }

  std::vector<Seg> profile() const {
    std::vector<Seg> path;
    const bool bore = !inner.empty();
    double start = bore ? inner.front().r0 : 0;
    const std::string mouth = bore ? "left|" + inner.front().id : "";
    if (bore) start += radial(mouth);
    const auto left = centre_hole("left", 0, 1), right = centre_hole("right", length, -1);
    if (!left.empty()) start = left.front().to.r;
    path.push_back({{0, start}});
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const auto& b = outer[i];
      const bool first = i == 0, last = i + 1 == outer.size();
      const auto before = first ? "left" : outer[i - 1].id + "|" + b.id;
      const auto behind = last ? "right" : b.id + "|" + outer[i + 1].id;
      auto l = corner({b.z0, b.r0}, first ? 0 : outer[i - 1].r1, -1, before);
      const auto r = corner({b.z1, b.r1}, last ? 0 : outer[i + 1].r0, 1, behind);
      // The left corner runs from the band outwards: turn it round.
      path.push_back({l.back().to});
      for (auto k = l.size(); k-- > 1;)
        path.push_back({l[k - 1].to, l[k].arc, l[k].middle});
      auto to = r.front();
      if (b.R != 0) to.arc = true, to.middle = middle(b);
      path.push_back(to);
      path.insert(path.end(), r.begin() + 1, r.end());
    }
    if (!bore) {
      if (right.empty())
        path.push_back({{length, 0}});
      else
        path.insert(path.end(), right.begin(), right.end());
      // The left one is gone through outwards.
      for (auto k = left.size(); k-- > 0;) {
        const bool arc = k + 1 < left.size() && left[k + 1].arc;
        path.push_back({left[k].to, arc, arc ? left[k + 1].middle : P{}});
      }
      return path;
    }
    const auto open = "right|" + inner.back().id;
    const double c = edge(open, "chamfer_mm"), rad = radial(open);
    path.push_back({{length, inner.back().r1 + rad}});
    for (std::size_t i = inner.size(); i-- > 0;) {
      const auto& b = inner[i];
      const bool last = i + 1 == inner.size();
      path.push_back({{b.z1 - (last ? c : 0), b.r1}});
      path.push_back({{b.z0 + (i == 0 ? edge(mouth, "chamfer_mm") : 0), b.r0}});
    }
    path.push_back({{0, start}});
    return path;
  }

  static P middle(const Band& b) {
    const double l = b.z1 - b.z0, dr = b.r1 - b.r0, c = std::hypot(l, dr),
                 R = std::abs(b.R);
    const double d = std::sqrt(std::max(0.0, R * R - c * c / 4)), s = R - d;
    const double way = b.R > 0 ? 1 : -1;  // convex: away from the axis
    return {(b.z0 + b.z1) / 2 - way * s * dr / c, (b.r0 + b.r1) / 2 + way * s * l / c};
  }
};

TopoDS_Shape revolved(const std::vector<Seg>& path, double from, double turn) {
  const auto point = [](P p) { return gp_Pnt(p.r, 0, p.z); };
  BRepBuilderAPI_MakeWire wire;
  P at = path.front().to;
  const auto apart = [](P a, P b) { return std::hypot(a.z - b.z, a.r - b.r) > 1e-9; };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto& s = path[i];
    if (!apart(at, s.to)) continue;
    if (s.arc)
      wire.Add(BRepBuilderAPI_MakeEdge(
          GC_MakeArcOfCircle(point(at), point(s.middle), point(s.to)).Value()));
    else
      wire.Add(BRepBuilderAPI_MakeEdge(point(at), point(s.to)));
    at = s.to;
  }
  if (apart(at, path.front().to))
    wire.Add(BRepBuilderAPI_MakeEdge(point(at), point(path.front().to)));
  const gp_Ax1 z(gp::Origin(), gp::DZ());
  gp_Trsf turned;
  turned.SetRotation(z, from);
  const TopoDS_Shape face =
      BRepBuilderAPI_Transform(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), turned)
          .Shape();
  return turn > 6 ? BRepPrimAPI_MakeRevol(face, z).Shape()
                  : BRepPrimAPI_MakeRevol(face, z, turn).Shape();
}

// A drill from outside, its point a cone of 118 deg or none.
TopoDS_Shape drill(const json& m, double R) {
  const double z = m["at_mm"], r = m["diameter_mm"].get<double>() / 2;
  const std::string through = m.value("through", "");
  const double bottom = through == "part"   ? -R - 10
                        : through == "wall" ? 0
                                            : R - m["depth_mm"].get<double>();
  const gp_Dir in(-1, 0, 0);
  const TopoDS_Shape tool =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(R + 10, 0, z), in), r, R + 10 - bottom);
  if (!through.empty() || m.value("flat", false)) return tool;
  const TopoDS_Shape point = BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(bottom, 0, z), in), r, 0,
                                                  r / std::tan(59 * M_PI / 180));
  return BRepAlgoAPI_Fuse(tool, point).Shape();
}

TopoDS_Shape milled(const json& m, double R) {
  const double z = m["z_mm"], l = m["length_mm"], t = m["depth_mm"];
  const double high = R + 10;
  TopoDS_Shape tool;
  if (m["kind"] == "flat") {
    tool =
        BRepPrimAPI_MakeBox(gp_Pnt(R - t, -high, z), gp_Pnt(high, high, z + l)).Shape();
  } else {
    const double w = m["width_mm"];
    const gp_Dir x(1, 0, 0);
    const auto end = [&](double at) {
      return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(R - t, 0, at), x), w / 2, 20).Shape();
    };
    tool = BRepPrimAPI_MakeBox(gp_Pnt(R - t, -w / 2, z + w / 2),
                               gp_Pnt(R - t + 20, w / 2, z + l - w / 2))
               .Shape();
    tool = BRepAlgoAPI_Fuse(tool, end(z + w / 2)).Shape();
    tool = BRepAlgoAPI_Fuse(tool, end(z + l - w / 2)).Shape();
  }
  return tool;
}

// Along z, the middle at x: the angle is counted from x.
TopoDS_Shape cutter(const json& m, double R) {
  const TopoDS_Shape tool = m["kind"] == "cross-hole" ? drill(m, R) : milled(m, R);
  gp_Trsf turned;
  turned.SetRotation(gp_Ax1(gp::Origin(), gp::DZ()),
                     m.value("angle_deg", 0.0) * M_PI / 180);
  return BRepBuilderAPI_Transform(tool, turned).Shape();
}

}  // namespace

int main(int n, char** arg) {
  const Part part(arg[1]);
  const std::string unit = n > 3 ? arg[3] : "MM", schema = n > 4 ? arg[4] : "AP214";
  const bool placed = n > 5 && *arg[5] == '1', halves = n > 6 && *arg[6] == '1';
  TopoDS_Shape shape = revolved(part.profile(), 0, halves ? M_PI : 2 * M_PI);
  if (halves)
    shape = BRepAlgoAPI_Fuse(shape, revolved(part.profile(), M_PI, M_PI)).Shape();
  GProp_GProps volume;
  BRepGProp::VolumeProperties(shape, volume, 1e-12);
  std::printf("volume %.12g\n", volume.Mass());
  for (const auto& m : part.j.value("milling", json::array()))
    for (const auto& b : part.outer)
      if (b.id == m["on"]) shape = BRepAlgoAPI_Cut(shape, cutter(m, b.r0)).Shape();
  if (placed) {
    gp_Trsf turn, move;
    turn.SetRotation(gp_Ax1(gp_Pnt(3, -4, 5), gp_Dir(1, 2, 3)), 37 * M_PI / 180);
    move.SetTranslation(gp_Vec(123.4, -56.7, 8.9));
    shape = BRepBuilderAPI_Transform(shape, move * turn).Shape();
  }
  STEPControl_Controller::
      Init();  // knows the settings; a writer takes them as it is made
  Interface_Static::SetCVal("write.step.schema",
                            schema == "AP242" ? "AP242DIS" : "AP214IS");
  Interface_Static::SetCVal("write.step.unit", unit.c_str());
  Interface_Static::SetCVal("write.step.product.name", "part");
  STEPControl_Writer writer;
  TopExp_Explorer solid(shape, TopAbs_SOLID);
  writer.Transfer(solid.Current(), STEPControl_AsIs);
  APIHeaderSection_MakeHeader header(writer.Model());
  const auto nothing = new TCollection_HAsciiString("");
  header.SetName(new TCollection_HAsciiString(part.j["name"].get<std::string>().c_str()));
  header.SetTimeStamp(nothing), header.SetOriginatingSystem(nothing);
  header.SetPreprocessorVersion(nothing), header.SetAuthorisation(nothing);
  header.SetAuthorValue(1, nothing), header.SetOrganizationValue(1, nothing);
  return writer.Write(arg[2]) == IFSelect_RetDone ? 0 : 1;
}
