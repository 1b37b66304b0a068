#!/usr/bin/env python3
"""Cuts a STEP AP242 file down to its PMI: cut_down.py FULL.stp > SMALL.stp

Kept, character by character but for line breaks, is every record of the families in KEPT
and every record that one of these needs.  The lists of what EMPTIED records are made of (the
bounds of a face, the items of a representation, the curves of an annotation) are written
as (), so that the shape itself stays behind.
"""
import re
import sys

KEPT = re.compile(
    r"TOLERANCE|DIMENSION|ANGULAR_|DATUM|SHAPE_ASPECT|ITEM_SPECIFIC_USAGE"
    r"|ITEM_IDENTIFIED|LIMITS_AND_FITS|ZONE|PRODUCT|PROPERTY|ITEM_ASSOCIATION"
    r"|DRAUGHTING_CALLOUT|MEASURE_QUALIFICATION|SURFACE_TEXTURE|MATERIAL_DESIGNATION"
)
EMPTIED = re.compile(
    r"ADVANCED_FACE|DRAUGHTING_CALLOUT|DRAUGHTING_MODEL|COMPOSITE_CURVE|GEOMETRIC_(CURVE_)?SET"
    r"|(SHAPE|WIREFRAME|GEOMETRY|PRESENTATION|DRAUGHTING)_REPRESENTATION|SHELL|SOLID"
)
LIST_OF_REFERENCES = re.compile(r"\((#\d+,)*#\d+\)")
STRING = re.compile(r"'(?:[^']|'')*'")


def records(text):
    """Statements without line breaks; a semicolon in a string ends none."""
    masked = STRING.sub(lambda m: "_" * len(m.group()), text)
    start = 0
    for end in re.finditer(";", masked):
        yield re.sub(r"[\r\n]+", "", text[start : end.start()]).strip()
        start = end.end()


def main():
    text = open(sys.argv[1], encoding="latin-1", newline="").read()
    head, body = text.split("DATA;", 1)
    body = body[: body.rindex("ENDSEC;")]
    instances = {}
    for record in records(body):
        name, value = record.split("=", 1)
        instances[int(name.strip()[1:])] = value.strip()

    def keywords(value):
        bare = STRING.sub("''", value)
        return " ".join(re.findall(r"[A-Z_0-9]+(?=\s*\()", bare))

    def cut(value):
        words = keywords(value)
        if not EMPTIED.search(words) or "DIMENSION_REPRESENTATION" in words:
            return value
        return LIST_OF_REFERENCES.sub("()", value, count=1)

    waiting = [n for n, v in instances.items() if KEPT.search(keywords(v))]
    kept = {}
    while waiting:
        n = waiting.pop()
        if n in kept or n not in instances:
            continue
        kept[n] = cut(instances[n])
        bare = STRING.sub("''", kept[n])
        waiting += [int(r) for r in re.findall(r"#(\d+)", bare)]
    out = head.replace("\r", "").rstrip() + "\nDATA;\n"
    out += "".join(f"#{n}={kept[n]};\n" for n in sorted(kept))
    sys.stdout.buffer.write((out + "ENDSEC;\nEND-ISO-10303-21;\n").encode("latin-1"))


main()
