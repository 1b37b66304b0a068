#!/usr/bin/env python3
"""Writes the small cases of this folder by FreeCAD's Part module.

    tests/data/step/write_cases.py                wants freecad-python3

README.md says what each is for.
"""
import math
import pathlib
import re
import sys

sys.path.append("/usr/lib/freecad-python3/lib")
import FreeCAD  # noqa: E402,F401
import Part  # noqa: E402
from FreeCAD import Vector  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent / "cases"
X, Y, Z = Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)
O = Vector(0, 0, 0)


def shaft(axis, bands, at=O):
    """Bands of (length, diameter) one behind the other."""
    solids, z = [], 0
    for length, d in bands:
        solids.append(Part.makeCylinder(d / 2, length, at + axis * z, axis))
        z += length
    return solids[0].multiFuse(solids[1:]).removeSplitter() if solids[1:] else solids[0]


def cylinder(d, length, at, axis):
    return Part.makeCylinder(d / 2, length, Vector(*at), axis)


def box(size, at):
    return Part.makeBox(*size, Vector(*at))


def prism(points, axis):
    wire = Part.makePolygon([Vector(*p) for p in points + points[:1]])
    return Part.Face(wire).extrude(axis)


def rolled(shape, deg):
    shape.rotate(O, Z, deg)
    return shape


def cases():
    three = [(17, 32), (23, 22), (19, 12)]
    yield "turned-x", shaft(X, [(20, 30), (30, 20), (15, 12)])
    yield "turned-y", shaft(Y, [(12, 24), (18, 14)])
    yield "turned-z", shaft(Z, [(18, 28), (22, 18)])
    moved = Vector(91, -37, 48)
    yield "translated-blind-bore", shaft(Z, [(30, 30), (30, 16)], moved).cut(
        Part.makeCylinder(4, 25, moved, Z))
    yield "repeated-lengths", shaft(X, [(10, 20), (10, 14), (10, 8)])
    yield "compound", Part.makeCompound([
        shaft(Z, [(20, 30), (25, 20)], Vector(-40, 0, 0)),
        shaft(Z, [(15, 26), (30, 16)], Vector(40, 0, 7))])
    yield "through-bore", shaft(Z, [(24, 30), (26, 18)]).cut(
        cylinder(8, 60, (0, 0, -5), Z))
    yield "groove", shaft(Y, [(28, 20), (4, 16), (28, 20)], Vector(0, -30, 0))
    yield "topology-a", shaft(Z, three)
    yield "topology-b", rolled(shaft(Z, list(three)), 37)

    body = shaft(X, [(40, 30), (60, 40)])
    yield "cross-hole", body.cut(cylinder(6, 60, (20, 0, -30), Z))
    yield "cross-hole-beside-the-axis", body.cut(cylinder(6, 60, (20, 2, -30), Z))
    sink = Part.makeCone(3, 8, 5, Vector(20, 0, 11), Z)
    yield "cross-hole-countersunk", body.cut(cylinder(6, 60, (20, 0, 0), Z).fuse(sink))
    yield "cross-hole-flat", body.cut(cylinder(6, 60, (20, 0, 4), Z))
    yield "slot", body.cut(box((30, 8, 20), (80, -4, 15)).fuse(
        cylinder(8, 20, (80, 0, 15), Z)))
    key = box((22, 8, 20), (64, -4, 15)).fuse(
        [cylinder(8, 20, (64, 0, 15), Z), cylinder(8, 20, (86, 0, 15), Z)])
    yield "round-keyway", body.cut(key).removeSplitter()
    yield "round-keyway-off-seam", body.cut(rolled_x(key.copy(), 90)).removeSplitter()
    open_left = box((30, 8, 20), (-5, -4, 10)).fuse(cylinder(8, 20, (25, 0, 10), Z))
    yield "open-slot-off-seam", body.cut(rolled_x(open_left, 90)).removeSplitter()
    yield "square-keyway", body.cut(box((30, 8, 20), (60, -4, 15)))
    yield "d-shaft", body.cut(box((40, 60, 20), (0, -30, 11)))
    yield "double-d", body.cut(box((40, 60, 20), (0, -30, 11))).cut(
        box((40, 60, 20), (0, -30, -31)))
    yield "oblique-flat", body.cut(rolled_x(box((25, 60, 20), (70, -30, 17)), 33))
    yield "bore-keyway", shaft(X, [(40, 60)]).cut(cylinder(30, 40, (0, 0, 0), X)).cut(
        box((40, 8, 10), (0, -4, 8.3)))
    yield "bolt-circle", with_holes(shaft(X, [(12, 90), (30, 40)]))
    yield "ball-end", shaft(X, [(30, 20)]).fuse(Part.makeSphere(10, Vector(30, 0, 0)))
    yield "half-round-groove", shaft(X, [(60, 40)]).cut(
        Part.makeTorus(20, 4, Vector(30, 0, 0), X))
    yield "cone-tip", shaft(X, [(30, 20)]).fuse(Part.makeCone(10, 0, 12, Vector(30, 0, 0), X))
    yield "hollow", shaft(X, [(60, 40)]).cut(cylinder(20, 20, (20, 0, 0), X))

    yield "block", box((40, 30, 20), (0, 0, 0))
    yield "housing", box((120, 90, 60), (-60, -45, 0)).cut(
        cylinder(50, 60, (0, 0, 0), Z)).cut(cylinder(70, 10, (0, 0, 50), Z))
    block = box((40, 40, 60), (-20, -20, 0))
    yield "blended-block", block.makeFillet(20 / 3, [
        e for e in block.Edges if abs(e.tangentAt(e.FirstParameter).z) > 0.9])
    corners = box((40, 40, 60), (-20, -20, 0)).common(cylinder(54, 60, (0, 0, 0), Z))
    yield "square-bar", corners
    hexagon = [(20 * math.cos(math.pi / 3 * i), 20 * math.sin(math.pi / 3 * i), 0)
               for i in range(6)]
    yield "hexagon-head", prism(hexagon, Z * 12).fuse(cylinder(20, 40, (0, 0, 12), Z))


def rolled_x(shape, deg):
    shape.rotate(O, X, deg)
    return shape


def with_holes(flange):
    for i in range(4):
        a = math.pi / 2 * i
        flange = flange.cut(cylinder(9, 12, (0, 32 * math.cos(a), 32 * math.sin(a)), X))
    return flange


def main():
    FOLDER.mkdir(exist_ok=True)
    for name, shape in cases():
        file = FOLDER / f"{name}.step"
        shape.exportStep(str(file))
        text = re.sub(r"Open CASCADE STEP translator [\d. ]+", name, file.read_text())
        file.write_text(re.sub(r"FILE_NAME\(.*?\);",
                               f"FILE_NAME('{name}','',(''),(''),'','','');", text,
                               count=1, flags=re.S))


main()
