#!/usr/bin/env python3
"""Writes tests/data/dxf/: the reference parts and some awkward drawings, by ezdxf.

Usage: write_dxf.py FOLDER    (Debian: python3-ezdxf; run in the repository's root)

The geometry is drawn here from parts/*.json by the rules of docs/planning.md alone, so that the
reader is held against another program.  Sections of the files that hold no geometry
(CLASSES, OBJECTS, unused tables) are cut to keep them small.
"""
import io
import json
import math
import pathlib
import sys

import ezdxf

FEATURES = pathlib.Path("tests/data/step/features")
CENTRE_SEAT = {2.5: 5.3, 4: 8.5, 5: 10.6}  # D2 of ISO 6411
UNDERCUT_WIDTH = {"E0.8x0.3": 2.5, "E0.4x0.2": 2, "E1.2x0.2": 2.5}  # f of DIN 509, form E

# DIN 76 of M24x1.5 and M30: (d - dg)/2, r, g2 of the forms A and B
THREAD_UNDERCUT = {24: (1.15, 0.8, 5.2, 3.8), 30: (2.5, 1.6, 12, 9)}


class Chain:
    """Vertices with bulges, (z, r, bulge to the next)."""

    def __init__(self, z, r):
        self.points = [[z, r, 0.0]]

    def to(self, z, r, bulge=0.0):
        if math.hypot(z - self.points[-1][0], r - self.points[-1][1]) < 1e-12:
            return
        self.points[-1][2] = bulge
        self.points.append([z, r, 0.0])


def rise(z, low, high, up, features):
    """From the lower element to the standing one at z; up: it stands on the right."""
    s = 1 if up else -1
    c = next((f for f in features if "chamfer_mm" in f), None)
    foot = next((f for f in features if "chamfer_mm" not in f), None)
    out, bottom = [], low
    if foot and "fillet_mm" in foot:
        R = foot["fillet_mm"]
        # A quarter of a turn; its bulge is positive where it turns left.
        out += [(z - s * R, low, s * math.tan(math.pi / 8)), (z, low + R, 0)]
        bottom = low + R
    elif foot:
        if foot["undercut"].startswith("DIN 76"):
            t, r, *widths = THREAD_UNDERCUT[2 * low]
            f, falls = widths[foot["undercut"] == "DIN 76-B"], 30
        else:
            r, t = map(float, foot["undercut"][1:].split("x"))
            f, falls = UNDERCUT_WIDTH[foot["undercut"]], 15
        run = t / math.tan(math.radians(falls))
        out += [(z - s * f, low, 0), (z - s * (f - run), low - t, 0),
                (z - s * r, low - t, s * math.tan(math.pi / 8)), (z, low - t + r, 0)]
        bottom = low - t + r
    if not out:
        out.append((z, low, 0))
    if c:
        a = c["chamfer_mm"]
        down = a * math.tan(math.radians(c.get("angle_deg", 45)))
        out += [(z, high - down, 0), (z + s * a, high, 0)]
    else:
        out.append((z, high, 0))
    assert bottom <= high
    return out


def corner(chain, z, r0, r1, features):
    up = r1 > r0
    points = rise(z, min(r0, r1), max(r0, r1), up, features)
    if not up:  # the other way round, bulges belong to the link before
        bulges = [0.0] + [-b for _, _, b in points[:-1]]
        points = [(p[0], p[1], b) for p, b in zip(points, bulges)][::-1]
        points = [(z_, r_, b) for z_, r_, b in points]
    for k, (z_, r_, _) in enumerate(points):
        bulge = points[k - 1][2] if k > 0 else 0.0
        chain.to(z_, r_, bulge)


def ends(e):
    d = e.get("diameter_mm")
    if "designation" in e:
        d = float(e["designation"][1:].split("x")[0])
    return (e.get("left_mm", d) / 2, e.get("right_mm", d) / 2)


def arc_bulge(e, r0, r1):
    half = math.hypot(e["length_mm"], r1 - r0) / 2
    b = math.tan(math.asin(min(1.0, half / e["radius_mm"])) / 2)
    return b if e.get("bulge") == "concave" else -b


def outside(part):
    at = lambda name: [e for e in part.get("edges", []) if e["at"] == name]
    elements = part["outer"]
    z, before = 0.0, None
    chain = Chain(0.0, 0.0)
    for i, e in enumerate(elements):
        name = "left" if i == 0 else elements[i - 1]["id"] + "|" + e["id"]
        r0, r1 = ends(e)
        corner(chain, z, before if i else 0.0, r0, at(name))
        z += e["length_mm"]
        if e["kind"] == "arc":
            # It begins where the corner before has ended.
            chain.to(z, r1, arc_bulge(e, r0, r1))
        before = r1
    corner(chain, z, before, 0.0, at("right"))
    chain.to(z, 0.0)
    return chain.points, z


def bore(part, length):
    """From the axis or the left face to the right one; None for a solid part."""
    inner = part.get("inner", [])
    if not inner:
        return None
    assert all(e["from"] == "right" for e in inner)
    at = lambda name: [e for e in part.get("edges", []) if e["at"] == name]
    depth = sum(e["length_mm"] for e in inner)
    through = abs(depth - length) < 1e-9
    z = length - depth
    first = ends(inner[-1])[0]
    mouth = at("left|" + inner[-1]["id"])
    if through and mouth:
        a = mouth[0]["chamfer_mm"]
        down = a * math.tan(math.radians(mouth[0].get("angle_deg", 45)))
        chain = Chain(z, first + down)
        chain.to(z + a, first)
    elif through:
        chain = Chain(z, first)
    else:
        chain = Chain(z, 0.0)
        chain.to(z, first)
    for e in reversed(inner):
        r0, r1 = ends(e)
        chain.to(z, r0)
        z += e["length_mm"]
        mouth = at("right|" + e["id"])
        if mouth:
            a = mouth[0]["chamfer_mm"]
            down = a * math.tan(math.radians(mouth[0].get("angle_deg", 45)))
            chain.to(z - a, r1)
            chain.to(z, r1 + down)
        else:
            chain.to(z, r1)
    return chain.points, through


def centre_hole(part, end, length):
    """From the mouth to the axis; nothing where there is none."""
    found = [c["designation"] for c in part.get("centre_holes", []) if c["at"] == end]
    if not found:
        return []
    form, (r, R) = found[0][0], (float(d) / 2 for d in found[0][1:].split("/"))
    slope = math.tan(math.radians(30))
    z, inwards = (0.0, 1) if end == "left" else (length, -1)
    chain = Chain(z, R)
    cone = R
    if form == "B":
        cone = CENTRE_SEAT[2 * r] / 2
        z += inwards * (R - cone) * slope
        chain.to(z, cone)
    z += inwards * (cone - r) / slope
    if form == "R":  # of the radius 2.5 d, out of the material
        half = (R - r) / math.sin(math.radians(30)) / 2
        chain.to(z, r, inwards * math.tan(math.asin(half / (5 * r)) / 2))
    else:
        chain.to(z, r)
    z += inwards * 2.5 * r
    chain.to(z, r)
    chain.to(z + inwards * r * slope, 0.0)
    return chain.points


def backwards(points):
    """The same chain from its other end: bulges belong to the link before, turned."""
    bulges = [-b for _, _, b in points[:-1]][::-1] + [0.0]
    return [[z, r, b] for (z, r, _), b in zip(points[::-1], bulges)]


class Sheet:
    """Draws in (z, r), turned, moved and scaled."""

    def __init__(self, version="R2000", inch=False, turn_deg=0, move=(0, 0), units=True):
        self.doc = ezdxf.new(version, setup=["linetypes"])
        self.space = self.doc.modelspace()
        if units:
            self.doc.header["$INSUNITS"] = 1 if inch else 4
        for name, linetype in (("PART", "CONTINUOUS"), ("MITTE", "CENTER"),
                               ("VERDECKT", "HIDDEN"), ("DIM", "CONTINUOUS")):
            if name not in self.doc.layers:
                self.doc.layers.add(name, linetype=linetype)
        self.k = 1 / 25.4 if inch else 1.0
        self.c, self.s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
        if turn_deg % 90 == 0:
            self.c, self.s = round(self.c), round(self.s)
        self.move, self.turn_deg = move, turn_deg

    def at(self, z, r):
        x, y = z + self.move[0], r + self.move[1]
        return (self.k * (self.c * x - self.s * y), self.k * (self.s * x + self.c * y))

    def line(self, a, b, layer="PART", **more):
        self.space.add_line(self.at(*a), self.at(*b), dxfattribs={"layer": layer, **more})

    def poly(self, points, sign=1, layer="PART", close=False):
        vertices = [(*self.at(z, sign * r), sign * b) for z, r, b in points]
        self.space.add_lwpolyline(vertices, format="xyb", close=close,
                                  dxfattribs={"layer": layer})

    def strokes(self, points, sign=1, layer="PART"):
        """The same as lines and arcs, each on its own."""
        for (z0, r0, b), (z1, r1, _) in zip(points, points[1:]):
            if b == 0:
                self.line((z0, sign * r0), (z1, sign * r1), layer)
                continue
            b *= sign
            p, q = self.at(z0, sign * r0), self.at(z1, sign * r1)
            if b < 0:
                p, q, b = q, p, -b
            dx, dy = q[0] - p[0], q[1] - p[1]
            off = (1 - b * b) / (4 * b)
            c = ((p[0] + q[0]) / 2 - off * dy, (p[1] + q[1]) / 2 + off * dx)
            angle = lambda t: math.degrees(math.atan2(t[1] - c[1], t[0] - c[0]))
            self.space.add_arc(c, math.hypot(p[0] - c[0], p[1] - c[1]), angle(p), angle(q),
                               dxfattribs={"layer": layer})

    def save(self, path):
        text = io.StringIO()
        self.doc.write(text)
        path.write_text(cut(text.getvalue()), encoding="utf-8")


def cut(text):
    """Header variables but units, and sections and tables without geometry, are left out."""
    lines = text.splitlines()
    groups = list(zip(lines[::2], lines[1::2]))
    out, i = [], 0
    while i < len(groups):
        if groups[i] == ("  0", "SECTION"):
            end = groups.index(("  0", "ENDSEC"), i)
            name = groups[i + 1][1]
            body = groups[i + 2:end]
            if name == "HEADER":
                keep = ("$ACADVER", "$INSUNITS", "$MEASUREMENT")
                starts = [k for k, g in enumerate(body) if g[0].strip() == "9"] + [len(body)]
                body = [g for a, b in zip(starts, starts[1:]) if body[a][1] in keep
                        for g in body[a:b]]
            elif name == "TABLES":
                kept, k = [], 0
                while k < len(body):
                    e = body.index(("  0", "ENDTAB"), k) + 1
                    if body[k + 1][1] == "LAYER":
                        kept += body[k:e]
                    k = e
                body = kept
            elif name not in ("BLOCKS", "ENTITIES"):
                i = end + 1
                continue
            out += groups[i:i + 2] + body + [groups[end]]
            i = end + 1
        else:
            out.append(groups[i])
            i += 1
    return "".join(f"{code.strip()}\n{value}\n" for code, value in out)


def half_profile(part, sheet, close):
    points, length = outside(part)
    hole = bore(part, length)
    if not hole:
        left, right = (centre_hole(part, end, length) for end in ("left", "right"))
        sheet.poly(backwards(left) + points[bool(left):len(points) - bool(right)] + right,
                   close=close)
        return
    inner, through = hole
    if through:
        # A ring: the faces end at the mouths of the bore.
        sheet.line((-3, 0), (length + 3, 0), "MITTE")
        sheet.poly([inner[0]] + points[1:-1] + inner[::-1])
        return
    closed = points[:-1] + [[z, r, 0.0] for z, r, _ in inner[::-1]]
    sheet.poly(closed, close=close)


def full_profile(part, sheet, section):
    points, length = outside(part)
    hole = bore(part, length)
    biggest = max(r for _, r, _ in points)
    sheet.line((-5, 0), (length + 5, 0), "MITTE")
    for sign in (1, -1):
        body = points if not (hole and section) else points[1:-1]
        if hole and section:
            mouth = hole[0][-1][1]
            left = hole[0][0][1] if hole[1] else 0.0
            body = [[0.0, left, 0.0]] + points[1:-1] + [[length, mouth, 0.0]]
        sheet.strokes(body, sign)
        if hole:
            inner = hole[0]
            sheet.strokes(inner, sign, "PART" if section else "VERDECKT")
        for end in ("left", "right"):
            if centre := centre_hole(part, end, length):
                sheet.strokes(centre, sign, "VERDECKT")
    if not section:  # shoulder lines and edges of chamfers, across the whole part
        for z, r, _ in points[1:-1]:
            if 0 < z < length:
                sheet.line((z, r), (z, -r))
    elif hole:  # what is seen through the bore
        for z, r, _ in hole[0]:
            if r > 0:
                sheet.line((z, r), (z, -r))
    sheet.space.add_circle(sheet.at(length + 40 + biggest, 0), sheet.k * biggest,
                           dxfattribs={"layer": "PART"})  # the view from the end


def reference_parts(folder):
    versions = ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")
    for i, path in enumerate(sorted(pathlib.Path("parts").glob("*.json"))):
        part = json.loads(path.read_text())
        version = versions[i % len(versions)]
        if version == "R12":
            version = "R2000"  # no LWPOLYLINE; see r12 below
        sheet = Sheet(version, inch=i % 3 == 1, turn_deg=90 if i % 4 == 3 else 0)
        half_profile(part, sheet, close=i % 2 == 0)
        sheet.save(folder / f"{path.stem}-half.dxf")
        sheet = Sheet("R12" if i % 3 < 2 else version, inch=i % 3 == 2,
                      turn_deg=(0, 30, 90, -72.5)[i % 4], move=(120 * (i % 2), -45))
        full_profile(part, sheet, section=i % 2 == 0)
        sheet.save(folder / f"{path.stem}-full.dxf")


def across(sheet, z, r, text, z2=None, override=None):
    sheet.space.add_linear_dim(
        base=sheet.at(z - 60, 0), p1=sheet.at(z, r), p2=sheet.at(z if z2 is None else z2, -r),
        angle=90 + sheet.turn_deg, text=text, override=override or {},
        dxfattribs={"layer": "DIM"}).render()


def parts_with_features(folder):
    for path in sorted(FEATURES.glob("*.json")):
        part = json.loads(path.read_text())
        for view, draw in (("half", lambda s: half_profile(part, s, close=False)),
                           ("full", lambda s: full_profile(part, s, section=False))):
            sheet = Sheet("R2010", turn_deg=90 if view == "full" else 0)
            draw(sheet)
            z = 0
            for e in part["outer"]:
                if e["kind"] == "thread":
                    across(sheet, z + 3, ends(e)[0], e["designation"])
                z += e["length_mm"]
            sheet.save(folder / f"{path.stem}-{view}.dxf")


SHAFT = {"outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 30},
                   {"id": "d2", "kind": "cylinder", "length_mm": 40, "diameter_mm": 50},
                   {"id": "d3", "kind": "cylinder", "length_mm": 25, "diameter_mm": 24}],
         "edges": [{"at": "left", "chamfer_mm": 1}, {"at": "d1|d2", "fillet_mm": 0.8},
                   {"at": "right", "chamfer_mm": 1.5}]}
BUSH = {"outer": [{"id": "d1", "kind": "cylinder", "length_mm": 20, "diameter_mm": 60},
                  {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 45}],
        "inner": [{"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 35,
                   "diameter_mm": 30},
                  {"id": "b2", "kind": "cylinder", "from": "right", "length_mm": 15,
                   "diameter_mm": 20}]}


def dimensions(folder, inch):
    """A shaft with dimensions as people write them."""
    sheet = Sheet("R2010", inch=inch, move=(10, 20))
    full_profile(SHAFT, sheet, section=False)

    def along(z0, r0, z1, r1, text, override=None):
        sheet.space.add_linear_dim(
            base=sheet.at(0, 60), p1=sheet.at(z0, r0), p2=sheet.at(z1, r1), text=text,
            override=override or {}, dxfattribs={"layer": "DIM"}).render()

    k = sheet.k
    across(sheet, 1, 15, "%%c<> k6")
    across(sheet, 70, 25, f"\\U+2205{50 * k:.10g}\\S+{0.02 * k:.10g}^-{0.01 * k:.10g};")
    across(sheet, 75, 12, "M24x1.5 6g Ra 1.6")
    along(0, 14, 30, 25, "<>", {"dimtol": 1, "dimtp": 0.1 * k, "dimtm": 0.05 * k})
    along(70, 25, 95, 10.5, f"<> %%p{0.2 * k:.10g}")
    along(0, 14, 95, 10.5, "<>")  # asks for nothing
    along(10, 15, 50, 25, "<> +0.1/0")  # from no face
    across(sheet, 85, 12, "%%c26 h7")  # not what is drawn
    sheet.space.add_text("Ra 3,2", dxfattribs={"insert": sheet.at(100, 40), "layer": "DIM"})
    sheet.space.add_mtext("{\\fArial|b0;General tolerances} ISO 2768-mK",
                          dxfattribs={"insert": sheet.at(100, 60), "layer": "DIM"})
    sheet.save(folder / ("dimensions-inch.dxf" if inch else "dimensions.dxf"))


def blocks(folder):
    """Half of the part in a block of a block, drawn twice: once mirrored."""
    sheet = Sheet("R2007", turn_deg=15)
    inner = sheet.doc.blocks.new("HALF", base_point=(3, 0))
    points, length = outside(SHAFT)
    inner.add_lwpolyline([(z + 3, r, b) for z, r, b in points], format="xyb",
                         dxfattribs={"layer": "0"})
    outer = sheet.doc.blocks.new("BOTH", base_point=(0, 0))
    outer.add_blockref("HALF", (0, 0), dxfattribs={"layer": "0"})
    outer.add_blockref("HALF", (0, 0), dxfattribs={"layer": "0", "yscale": -1})
    sheet.line((-4, 0), (length + 4, 0), "MITTE")
    sheet.space.add_blockref("BOTH", (0, 0), dxfattribs={
        "layer": "PART", "xscale": 1, "yscale": 1, "rotation": 15})
    sheet.save(folder / "blocks.dxf")


def half_section(folder):
    """The bush in section below the axis, seen from outside above it."""
    sheet = Sheet("R2013", move=(5, 100))
    points, length = outside(BUSH)
    inner, _ = bore(BUSH, length)
    sheet.line((-4, 0), (length + 4, 0), "MITTE")
    sheet.strokes(points, 1)
    sheet.line((20, 30), (20, 0))
    sheet.strokes([inner[0]] + points[1:-1] + inner[::-1], -1)
    sheet.line((15, -15), (15, 0))  # the step of the bore, seen beyond the section
    hatch = sheet.space.add_hatch(dxfattribs={"layer": "PART"})
    hatch.paths.add_polyline_path([sheet.at(0, -10), sheet.at(0, -30), sheet.at(20, -30)])
    sheet.save(folder / "half-section.dxf")


def old_polyline(folder):
    """AutoCAD R12: POLYLINE with vertices, no header, one half, drawn along y."""
    sheet = Sheet("R12", turn_deg=90)
    points, length = outside(SHAFT)
    sheet.space.add_polyline2d([(*sheet.at(z, r), b) for z, r, b in points], format="xyb",
                               dxfattribs={"layer": "PART"})
    sheet.save(folder / "old-polyline.dxf")


def seen_from_behind(folder):
    """Mirrored in CAD: extrusion (0, 0, -1), x counted the other way."""
    sheet = Sheet("R2018")
    points, length = outside(SHAFT)
    sheet.space.add_lwpolyline([(-z, r, -b) for z, r, b in points], format="xyb",
                               dxfattribs={"layer": "PART", "extrusion": (0, 0, -1)})
    sheet.save(folder / "seen-from-behind.dxf")


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    reference_parts(folder)
    parts_with_features(folder)
    dimensions(folder, inch=False)
    dimensions(folder, inch=True)
    blocks(folder)
    half_section(folder)
    old_polyline(folder)
    seen_from_behind(folder)


if __name__ == "__main__":
    main()
