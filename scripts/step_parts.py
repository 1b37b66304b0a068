#!/usr/bin/env python3
"""Writes the parts of parts/ as STEP files by FreeCAD's Part module.

    scripts/step_parts.py FOLDER [PART ..]        wants freecad-python3

Every band is a cylinder or a cone; chamfers are cones, fillets FreeCAD's own, arcs and
undercuts are turned from a wire, keyways and flats are cut.  It is the second of two
independent writers; the first is tests/data/step/write_occt.cpp.  Prints name and volume
[mm3] of each turned part, before it is milled.
"""
import json
import math
import pathlib
import re
import sys

sys.path.append("/usr/lib/freecad-python3/lib")
import FreeCAD  # noqa: E402
import Part  # noqa: E402
from FreeCAD import Vector  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
X = Vector(1, 0, 0)
WIDTH = 2.5  # of the undercut E0.8x0.3


def band(z, length, r0, r1):
    """A cylinder or cone along x."""
    at = Vector(z, 0, 0)
    if abs(r0 - r1) < 1e-12:
        return Part.makeCylinder(r0, length, at, X)
    return Part.makeCone(r0, r1, length, at, X)


def turned(points):
    """A ring from a closed list of (x, r) or (x, r, x of an arc's middle, r of it)."""
    edges, before = [], points[-1]
    for p in points:
        a, b = Vector(before[0], before[1], 0), Vector(p[0], p[1], 0)
        if len(p) > 2:
            edges.append(Part.Arc(a, Vector(p[2], p[3], 0), b).toShape())
        elif (a - b).Length > 1e-9:
            edges.append(Part.makeLine(a, b))
        before = p
    return Part.Face(Part.Wire(edges)).revolve(Vector(0, 0, 0), X, 360)


def sizes(element):
    if "designation" in element:
        d = float(re.match(r"M([\d.]+)", element["designation"]).group(1))
        return d / 2, d / 2
    if "left_mm" in element:
        return element["left_mm"] / 2, element["right_mm"] / 2
    return element["diameter_mm"] / 2, element["diameter_mm"] / 2


def arc_band(z, length, r0, r1, element):
    radius, chord = element["radius_mm"], math.hypot(length, r1 - r0)
    s = radius - math.sqrt(max(0, radius**2 - chord**2 / 4))
    way = s if element["bulge"] == "convex" else -s
    middle = (z + length / 2 - way * (r1 - r0) / chord, (r0 + r1) / 2 + way * length / chord)
    return turned([(z, 0), (z, r0), (z + length, r1, *middle), (z + length, 0)])


def edge_of(part, at, key):
    return next((e for e in part.get("edges", []) if e["at"] == at and key in e), None)


def circles(shape, x, r):
    """Circular edges about x of this radius at this place."""
    return [e for e in shape.Edges if isinstance(e.Curve, Part.Circle)
            and abs(e.Curve.Radius - r) < 1e-6 and abs(e.Curve.Center.x - x) < 1e-6]


def outside(part):
    """The fused bands, each with chamfers as cones at its standing ends."""
    bands, z = [], 0
    for element in part["outer"]:
        r0, r1 = sizes(element)
        bands.append((z, element["length_mm"], r0, r1, element))
        z += element["length_mm"]
    solids, fillets = [], []
    for i, (z, length, r0, r1, element) in enumerate(bands):
        if "radius_mm" in element:
            solids.append(arc_band(z, length, r0, r1, element))
            continue
        start, end = z, z + length
        before = bands[i - 1] if i else None
        behind = bands[i + 1] if i + 1 < len(bands) else None
        for side, other, r in ((-1, before, r0), (1, behind, r1)):
            pair = (other, bands[i]) if side < 0 else (bands[i], other)
            at = ("left" if side < 0 else "right") if other is None else \
                f'{pair[0][4]["id"]}|{pair[1][4]["id"]}'
            reach = 0 if other is None else (other[3] if side < 0 else other[2])
            chamfer, place = edge_of(part, at, "chamfer_mm"), z if side < 0 else z + length
            if chamfer and reach < r:
                c = chamfer["chamfer_mm"]
                low = r - c * math.tan(math.radians(chamfer.get("angle_deg", 45)))
                if side < 0:
                    start += c
                    solids.append(band(place, c, low, r))
                else:
                    end -= c
                    solids.append(band(place - c, c, r, low))
            if reach > r and edge_of(part, at, "fillet_mm"):
                fillets.append((place, r, edge_of(part, at, "fillet_mm")["fillet_mm"]))
            if reach > r and edge_of(part, at, "undercut"):
                start, end = (start + WIDTH, end) if side < 0 else (start, end - WIDTH)
                solids.append(undercut(place, r, side))
        solids.append(band(start, end - start, r0, r1))
    shape = solids[0].multiFuse(solids[1:]).removeSplitter() if solids[1:] else solids[0]
    for x, r, radius in fillets:
        shape = shape.makeFillet(radius, circles(shape, x, r))
    return shape, z + length


def undercut(x, r, side, radius=0.8, depth=0.3):
    """The end of a cylinder with form E 0.8 x 0.3 of DIN 509 before the shoulder at x."""
    run, turn = depth / math.tan(math.pi / 12), radius * math.sqrt(0.5)
    top = r - depth + radius
    return turned([
        (x - side * WIDTH, 0), (x - side * WIDTH, r), (x - side * (WIDTH - run), r - depth),
        (x - side * radius, r - depth),
        (x, top, x - side * (radius - turn), top - turn), (x, 0)])


def bore(part, length):
    """What is taken out: the bores of both ends and the hollow of a tube."""
    tools, left, right = [], 0, length
    inner = part.get("inner", [])
    for element in inner:
        r0, r1 = sizes(element)
        n = element["length_mm"]
        z = left if element["from"] == "left" else right - n
        tools.append(band(z, n, r0, r1))
        left, right = (left + n, right) if element["from"] == "left" else (left, right - n)
    tube = part["stock"].get("inner_mm", 0)
    if right - left > 1e-9 and tube:
        tools.append(band(left, right - left, tube / 2, tube / 2))
    for at, element in (("left", inner[-1:]), ("right", inner[:1])):
        edge = element and edge_of(part, f'{at}|{element[0]["id"]}', "chamfer_mm")
        if edge:
            c, r = edge["chamfer_mm"], sizes(element[0])[0]
            wide = r + c * math.tan(math.radians(edge.get("angle_deg", 45)))
            tools.append(band(0, c, wide, r) if at == "left" else band(length - c, c, r, wide))
    return tools


def mill(part, shape):
    for place in part.get("milling", []):
        r = next(sizes(e)[0] for e in part["outer"] if e["id"] == place["on"])
        z, length, floor = place["z_mm"], place["length_mm"], r - place["depth_mm"]
        if place["kind"] == "flat":
            tool = Part.makeBox(length, 4 * r, r, Vector(z, -2 * r, floor))
        else:
            w = place["width_mm"]
            a, b = z + w / 2, z + length - w / 2
            ring = [Part.makeLine(Vector(a, -w / 2, floor), Vector(b, -w / 2, floor)),
                    Part.Arc(Vector(b, -w / 2, floor), Vector(b + w / 2, 0, floor),
                             Vector(b, w / 2, floor)).toShape(),
                    Part.makeLine(Vector(b, w / 2, floor), Vector(a, w / 2, floor)),
                    Part.Arc(Vector(a, w / 2, floor), Vector(a - w / 2, 0, floor),
                             Vector(a, -w / 2, floor)).toShape()]
            tool = Part.Face(Part.Wire(ring)).extrude(Vector(0, 0, r))
        tool.rotate(Vector(0, 0, 0), X, place.get("angle_deg", 0))
        shape = shape.cut(tool)
    return shape


def without_origin(file):
    """No time, no machine: two runs write the same bytes."""
    text = file.read_text()
    text = re.sub(r"Open CASCADE STEP translator [\d. ]+", file.stem, text)
    text = re.sub(r"FILE_NAME\(.*?\);", f"FILE_NAME('{file.name}','',(''),(''),'','','');",
                  text, count=1, flags=re.S)
    file.write_text(text)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or sorted(p.stem for p in (ROOT / "parts").glob("*.json")):
        part = json.loads((ROOT / "parts" / f"{name}.json").read_text())
        shape, length = outside(part)
        tools = bore(part, length) if "inner" in part else []
        if tools:
            shape = shape.cut(tools[0].multiFuse(tools[1:]) if tools[1:] else tools[0])
        print(name, f"{shape.Volume:.12g}", flush=True)
        file = folder / f"{name}.step"
        mill(part, shape).exportStep(str(file))
        without_origin(file)


main()
