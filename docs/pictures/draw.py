#!/usr/bin/env python3
"""Draws a plan: the part, which setup cuts what, and how much of each tolerance is used.

Usage: turnwright plan PART.json --json | docs/pictures/draw.py PART.json > PICTURE.svg
"""
import json
import sys

WIDTH, MARGIN = 900, 40
COLOURS = ["#3b6ea5", "#c06a2b"]
GREY, INK = "#d9dde2", "#2b3036"


def text(x, y, s, size=13, anchor="start", weight="normal"):
    s = s.replace("&", "&amp;").replace("<", "&lt;")
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" '
            f'font-weight="{weight}" fill="{INK}">{s}</text>')


def shaft(part, setup_of, y):
    """The outline to scale, centre line at y."""
    elements = part["outer"]
    scale = (WIDTH - 2 * MARGIN) / sum(e["length_mm"] for e in elements)
    out, x = [], MARGIN
    for e in elements:
        left = e.get("diameter_mm", e.get("left_mm"))
        right = e.get("diameter_mm", e.get("right_mm"))
        w, a, b = e["length_mm"] * scale, left / 2 * scale, right / 2 * scale
        colour = COLOURS[setup_of.get(e["id"], 0) % 2]
        out.append(f'<path d="M{x:.1f},{y - a:.1f} L{x + w:.1f},{y - b:.1f} '
                   f'L{x + w:.1f},{y + b:.1f} L{x:.1f},{y + a:.1f} Z" fill="{colour}" '
                   f'fill-opacity="0.25" stroke="{colour}" stroke-width="2"/>')
        label = e["id"] + (" " + e["fit"] if "fit" in e else "")
        out.append(text(x + w / 2, y + 5, label, anchor="middle", weight="bold"))
        x += w
    out.append(f'<line x1="{MARGIN - 20}" y1="{y}" x2="{WIDTH - MARGIN + 20}" y2="{y}" '
               f'stroke="{INK}" stroke-dasharray="16 4 3 4" stroke-width="0.8"/>')
    return out


def bar(t, y):
    """One tolerance: what is allowed in grey, what is predicted in colour."""
    left, right = 330, WIDTH - MARGIN - 150
    pair = lambda v: v if isinstance(v, list) else [0, v]
    low, high = pair(t["allowed_mm"])
    a, b = (min(max(v, low), high) for v in pair(t["predicted_mm"]))
    at = lambda v: left + (right - left) * (v - low) / (high - low)
    colour = "#4b9a5b" if t["verdict"] == "met" else "#d09a2c"
    name = t["id"] if t["id"].endswith(t["kind"]) else f'{t["id"]}  {t["kind"]}'
    numbers = f"{1000 * low:.1f} .. {1000 * high:.1f} um" if low else f"{1000 * high:.1f} um"
    return [text(MARGIN, y + 12, f'{name}  ({t["of"]})'.replace("-", " ")),
            f'<rect x="{left}" y="{y}" width="{right - left}" height="15" fill="{GREY}" rx="3"/>',
            f'<rect x="{at(a):.1f}" y="{y}" width="{max(at(b) - at(a), 2):.1f}" height="15" '
            f'fill="{colour}" rx="3"/>', text(right + 10, y + 12, numbers)]


def main():
    part = json.load(open(sys.argv[1]))
    plan = json.load(sys.stdin)
    setup_of = {s: k for k, setup in enumerate(plan["setups"])
                for o in setup["operations"] for s in o["on"]}
    body = [text(MARGIN, 30, f'{part["name"]}: {plan["cost_per_part"]:.4f} per part, '
                 f'{plan["time_per_part_min"]:.2f} min', 17, weight="bold")]
    for k, setup in enumerate(plan["setups"]):
        body.append(f'<rect x="{MARGIN + 330 * k}" y="42" width="12" height="12" fill="{COLOURS[k % 2]}"/>')
        body.append(text(MARGIN + 18 + 330 * k, 53, f'setup {k + 1}: {setup["hold"]} end held, '
                         f'{setup["clamping"]}, {len(setup["operations"])} operations'))
    body += shaft(part, setup_of, 185)
    y = 320
    body.append(text(MARGIN, y, "tolerances: predicted (colour) within allowed (grey)", weight="bold"))
    for t in plan["tolerances"]:
        y += 24
        body += bar(t, y - 12)
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y + 30}" '
          f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>')
    print("\n".join(body))
    print("</svg>")


main()
