#!/usr/bin/env python3
"""Stepped round cantilevers under a transverse end load in three-dimensional elasticity.

Meshes a quarter of each body with 20-node hexahedra (C3D20R), solves it with CalculiX
(ccx) and writes tests/data/stepped_cantilevers.json: the deflection at the load per
newton, averaged over the section.  tests/deflection/shoulder_test.cpp compares the beam
with these numbers, docs/deflection.md shows them.

    apt-get install --no-install-recommends calculix-ccx
    scripts/calculix_study.py tests/data/stepped_cantilevers.json

Model.  z along the axis, load along x, first section at z = 0.  The plane y = 0 is one of
symmetry (u_y = 0), the plane x = 0 one of antisymmetry (u_y = u_z = 0).  At z = 0 the
section keeps its plane and its place, as a beam's clamped section does: u_z = 0 and the
mean of u_x is zero.  The load is a uniform shear traction on the end face, so the
deflection it does work on is the mean of u_x there.  A cylinder is solved beside the
stepped bodies: it shows what the supports and the load alone differ from a beam's.
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

E_MPA, NU = 210000.0, 0.3

# name: sections from the wall to the load as (length, diameter) [mm]
CASES = {
    "cylinder": [(120, 30)],
    "d/D 0.85": [(60, 40), (85, 34)],
    "d/D 0.7": [(70, 40), (84, 28)],
    "d/D 0.6": [(50, 50), (90, 30)],
    "d/D 0.5": [(60, 48), (72, 24)],
    "d/D 0.4": [(40, 50), (50, 20)],
    "d/D 0.3": [(50, 50), (45, 15)],
    "d/D 0.5, long": [(90, 40), (120, 20)],
    "d/D 0.5, short": [(30, 40), (40, 20)],
    "two steps, 0.7 and 0.6": [(50, 60), (45, 42), (70, 25.2)],
    "two steps, 0.5 and 0.5": [(50, 60), (50, 30), (45, 15)],
}
DENSITIES = {"coarse": 3, "medium": 4, "fine": 5}  # divisions of a quarter's half
CONVERGENCE = {"d/D 0.3": ["coarse", "medium", "fine"],
               "d/D 0.5": ["coarse", "medium", "fine"],
               "two steps, 0.5 and 0.5": ["coarse", "medium"]}


def graded(length, left, right, largest):
    """Coordinates of layers on [0, length], sizes growing by 1.35 from both ends."""
    sizes, a, b, total = ([], []), left, right, 0.0
    while total < length:
        if a <= b:
            sizes[0].append(a)
            total += a
            a = min(1.35 * a, largest)
        else:
            sizes[1].append(b)
            total += b
            b = min(1.35 * b, largest)
    all_sizes = sizes[0] + sizes[1][::-1]
    z, out = 0.0, [0.0]
    for h in all_sizes:
        z += h * length / total
        out.append(z)
    out[-1] = length
    return out


def section_blocks(radii, n):
    """Maps (u, v) in [0, 1]^2 -> (x, y) of the blocks of a quarter disc, each with its
    divisions and the index of the radius it belongs to: a square core, two blocks around
    it up to the smallest radius, two rings per further radius."""
    r0 = radii[0]
    c, k = 0.5 * r0, 0.42 * r0  # core: (0,0) (c,0) (k,k) (0,c)

    def core(u, v):
        return (u * (1 - v) * c + u * v * k, v * (1 - u) * c + u * v * k)

    def rim(half, t):  # core's edge and its angle, t along the quarter's half
        theta = math.pi / 4 * (t + half)
        point = core(1.0, t) if half == 0 else core(1.0 - t, 1.0)
        return point, theta

    def around(half):
        def at(u, v):
            (x, y), theta = rim(half, v)
            return ((1 - u) * x + u * r0 * math.cos(theta),
                    (1 - u) * y + u * r0 * math.sin(theta))
        return at

    def ring(half, inner, outer):
        def at(u, v):
            theta, r = math.pi / 4 * (v + half), inner + (outer - inner) * u
            return (r * math.cos(theta), r * math.sin(theta))
        return at

    even = lambda m: [i / m for i in range(m + 1)]
    blocks = [(core, even(n), even(n), 0)]
    fine = r0 / (6 * n)  # radial size at the corner of the step
    for half in (0, 1):
        u = [x / (0.5 * r0) for x in graded(0.5 * r0, 3 * fine, fine, r0 / n)]
        blocks.append((around(half), u, even(n), 0))
        for i in range(1, len(radii)):
            wide = radii[i] - radii[i - 1]
            start = radii[i - 1] / (6 * n)
            end = radii[i] / (6 * n) if i + 1 < len(radii) else radii[i] / n
            u = [x / wide for x in graded(wide, start, end, radii[i] / n)]
            blocks.append((ring(half, radii[i - 1], radii[i]), u, even(n), i))
    return blocks


class Plane:
    """Nodes and 8-node quadrilaterals of the quarter section."""

    def __init__(self, radii, n):
        self.nodes, self.index, self.quads = [], {}, []
        for at, u, v, belongs in section_blocks(radii, n):
            for i in range(len(u) - 1):
                for j in range(len(v) - 1):
                    u0, u1, v0, v1 = u[i], u[i + 1], v[j], v[j + 1]
                    um, vm = (u0 + u1) / 2, (v0 + v1) / 2
                    uv = [(u0, v0), (u1, v0), (u1, v1), (u0, v1),
                          (um, v0), (u1, vm), (um, v1), (u0, vm)]
                    self.quads.append(([self.node(*at(*p)) for p in uv], belongs))
        self.corners = {k for quad, _ in self.quads for k in quad[:4]}

    def node(self, x, y):
        # blocks compute their common nodes each on its own: equal but for rounding
        i, j = round(x * 1e6), round(y * 1e6)
        for key in ((i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)):
            if key in self.index:
                return self.index[key]
        self.index[i, j] = len(self.nodes)
        self.nodes.append((x, y))
        return self.index[i, j]

    def weights(self, belongs_up_to):
        """Integral of every shape function over the section: {node: weight}."""
        g, out = math.sqrt(0.6), {}
        gauss = [(-g, 5 / 9), (0.0, 8 / 9), (g, 5 / 9)]
        for quad, belongs in self.quads:
            if belongs > belongs_up_to:
                continue
            for s, ws in gauss:
                for t, wt in gauss:
                    N, dNs, dNt = serendipity(s, t)
                    xs = sum(d * self.nodes[k][0] for d, k in zip(dNs, quad))
                    ys = sum(d * self.nodes[k][1] for d, k in zip(dNs, quad))
                    xt = sum(d * self.nodes[k][0] for d, k in zip(dNt, quad))
                    yt = sum(d * self.nodes[k][1] for d, k in zip(dNt, quad))
                    area = (xs * yt - xt * ys) * ws * wt
                    assert area > 0
                    for value, k in zip(N, quad):
                        out[k] = out.get(k, 0.0) + value * area
        return out


def serendipity(s, t):
    """Shape functions of the 8-node quadrilateral and their derivatives."""
    corner = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    N, ds, dt = [], [], []
    for a, b in corner:
        N.append((1 + a * s) * (1 + b * t) * (a * s + b * t - 1) / 4)
        ds.append(a * (1 + b * t) * (2 * a * s + b * t) / 4)
        dt.append(b * (1 + a * s) * (a * s + 2 * b * t) / 4)
    for a, b in [(0, -1), (1, 0), (0, 1), (-1, 0)]:
        if a == 0:
            N.append((1 - s * s) * (1 + b * t) / 2)
            ds.append(-s * (1 + b * t))
            dt.append(b * (1 - s * s) / 2)
        else:
            N.append((1 + a * s) * (1 - t * t) / 2)
            ds.append(a * (1 - t * t) / 2)
            dt.append(-t * (1 + a * s))
    return N, ds, dt


def layers(sections, n):
    """z of the layers and the section each belongs to."""
    z, of, start = [0.0], [], 0.0
    for i, (length, d) in enumerate(sections):
        small = min([d] + [s[1] for s in sections[i:i + 2]]) / (12 * n)
        left = d / (12 * n) if i > 0 else d / (2 * n)
        right = small if i + 1 < len(sections) else d / (2 * n)
        steps = graded(length, left, right, d / n)
        z += [start + x for x in steps[1:]]
        of += [i] * (len(steps) - 1)
        start += length
    return z, of


def solve(sections, n):
    radii = [d / 2 for _, d in reversed(sections)]  # smallest, at the load, first
    plane = Plane(radii, n)
    z, of = layers(sections, n)
    last = len(sections) - 1
    nodes, number, elements = [], {}, []

    def node(k, level):  # level counts half layers
        if (k, level) not in number:
            number[k, level] = len(nodes) + 1
            x, y = plane.nodes[k]
            low = z[level // 2]
            high = z[(level + 1) // 2]
            nodes.append((x, y, (low + high) / 2))
        return number[k, level]

    for layer, section in enumerate(of):
        for quad, belongs in plane.quads:
            if belongs > last - section:
                continue
            low, high = 2 * layer, 2 * layer + 2
            elements.append([node(k, low) for k in quad[:4]] +
                            [node(k, high) for k in quad[:4]] +
                            [node(k, low) for k in quad[4:]] +
                            [node(k, high) for k in quad[4:]] +
                            [node(k, low + 1) for k in quad[:4]])

    end_weights, wall_weights = plane.weights(0), plane.weights(last)
    top = 2 * len(of)
    area = sum(end_weights.values())
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i},{x:.12g},{y:.12g},{w:.12g}" for i, (x, y, w) in enumerate(nodes, 1)]
    lines.append("*ELEMENT, TYPE=C3D20R, ELSET=BODY")
    for i, e in enumerate(elements, 1):
        lines.append(",".join(map(str, [i] + e[:15])) + ",")
        lines.append(",".join(map(str, e[15:])))
    lines += ["*NSET, NSET=END"] + [f"{node(k, top)}," for k in end_weights]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{E_MPA},{NU}",
              "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL", "*BOUNDARY"]
    tiny = 1e-9
    for i, (x, y, w) in enumerate(nodes, 1):
        if y < tiny or x < tiny:
            lines.append(f"{i},2,2")
        if x < tiny or w < tiny:
            lines.append(f"{i},3,3")
    # CalculiX eliminates the first node of an equation: the one with the largest weight
    wall = sorted(((node(k, 0), w) for k, w in wall_weights.items()),
                  key=lambda term: -term[1])
    lines += ["*EQUATION", str(len(wall))]  # the mean of u_x is zero
    lines += [f"{i},1,{w:.15g}" for i, w in wall]
    lines += ["*STEP", "*STATIC", "*CLOAD"]
    # a quarter of one newton on a quarter of the face
    lines += [f"{node(k, top)},1,{0.25 * w / area:.15g}" for k, w in end_weights.items()]
    lines += ["*NODE PRINT, NSET=END", "U", "*END STEP", ""]

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "body.inp").write_text("\n".join(lines))
        subprocess.run(["ccx", "body"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        shown = {}
        for line in (Path(folder) / "body.dat").read_text().splitlines():
            parts = line.split()
            if len(parts) == 4 and parts[0].isdigit():
                shown[int(parts[0])] = float(parts[1])
    mean = sum(w * shown[node(k, top)] for k, w in end_weights.items()) / area
    assert mean > 0, "a force that does negative work: the solver failed"
    return {"nodes": len(nodes), "elements": len(elements), "f_mm_N": float(f"{mean:.7g}")}


def main(path):
    cases = []
    for name, sections in CASES.items():
        meshes = []
        for density in CONVERGENCE.get(name, ["medium"]):
            meshes.append({"mesh": density} | solve(sections, DENSITIES[density]))
            print(name, meshes[-1], flush=True)
        cases.append({"name": name, "meshes": meshes, "segments": [
            {"length_mm": h, "diameter_mm": d} for h, d in sections]})
    version = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.strip()
    Path(path).write_text(json.dumps({
        "made_by": "scripts/calculix_study.py", "solver": f"CalculiX {version.split()[-1]}",
        "E_MPa": E_MPA, "nu": NU,
        "f_mm_N": "deflection at the load per newton, mean over the section",
        "cases": cases}, indent=1) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
