#!/usr/bin/env python3
"""Tables of what the NIST test cases demand, from QIF files: an independent way to the same
drawings.

    truth_from_qif.py sizes FILE.qif [0.01 ..]  diameters, widths, angles with a tolerance
    truth_from_qif.py tolerances FILE.qif       geometric tolerances

Sizes whose upper deviation is one of the numbers at the end are left out: a CAD system gives
all sizes of a model a default one.

Values in mm, angles in degrees.  A value without a unit of its own has the primary unit of
its file.
"""
import re
import sys
import xml.etree.ElementTree as ET

NAMES = {
    "Position": "position", "SurfaceProfile": "surface profile", "Flatness": "flatness",
    "LineProfile": "line profile", "Perpendicularity": "perpendicularity",
    "Angularity": "angularity", "Parallelism": "parallelism", "Circularity": "roundness",
    "Straightness": "straightness", "Concentricity": "concentricity",
    "CircularRunout": "circular run-out", "TotalRunout": "total run-out",
}
SIZES = {"Diameter": "diameter", "Width": "width", "Length": "width", "Angle": "angle",
         "DistanceBetween": "width"}
CONDITIONS = {"MAXIMUM": "maximum material requirement",
              "LEAST": "least material requirement"}


def read(path):
    text = open(path, encoding="utf-8", errors="replace").read()
    return ET.fromstring(re.sub(r'\sxmlns(:\w+)?="[^"]*"|xsi:\w+=\s*"[^"]*"', "", text))


def number(x):
    return f"{x:.6g}"


class Qif:
    def __init__(self, path, left_out):
        self.left_out = left_out
        self.root = read(path)
        unit = self.root.find(".//PrimaryUnits/LinearUnit/UnitName").text
        self.mm = {"mm": 1.0, "inch": 25.4}
        self.primary = unit
        self.datums = {d.get("id"): d.find("DatumLabel").text
                       for d in self.root.iter("DatumDefinition")}
        self.frames = {f.get("id"): self.frame(f)
                       for f in self.root.iter("DatumReferenceFrame")}
        self.nominals = {}
        for n in self.root.find(".//CharacteristicNominals"):
            definition = n.find("CharacteristicDefinitionId").text
            self.nominals.setdefault(definition, n)

    def value(self, element):
        return float(element.text) * self.mm[element.get("linearUnit", self.primary)]

    def frame(self, frame):
        letters = []
        for datum in frame.iter("Datum"):
            found = []
            condition = ""
            for simple in datum.iter("SimpleDatum"):
                found.append(self.datums[simple.find("DatumDefinitionId").text])
                condition = CONDITIONS.get(simple.find("MaterialModifier").text, "")
            letters.append("-".join(found) + (f"({condition})" if condition else ""))
        return " ".join(letters)

    def modifiers(self, t):
        all = []
        condition = t.find("MaterialCondition")
        if condition is not None and condition.text in CONDITIONS:
            all.append(CONDITIONS[condition.text])
        if t.find(".//ProjectedToleranceZoneValue") is not None:
            all.append("projected")
        if t.find("ToleranceZonePerUnitArea") is not None:
            all.append("per unit")
        if t.find("Extent/ExtentEnum") is not None:
            if t.find("Extent/ExtentEnum").text == "ALL_AROUND":
                all.append("all around")
        return ", ".join(all)

    def tolerance(self, kind, t, lower):
        value = t.find("ToleranceValue")
        if value is None:
            value = t.find(".//ToleranceValuePerUnit")
        frame = t.find("DatumReferenceFrameId")
        diametral = t.find("ZoneShape/DiametricalZone") is not None
        more = "lower segment" if lower else self.modifiers(t)
        yield [kind, number(self.value(value)), "diameter" if diametral else "",
               self.frames[frame.text] if frame is not None else "", more]
        for tag in ("SecondCompositeSegmentProfileDefinition",
                    "SecondCompositeSegmentPositionDefinition"):
            if t.find(tag) is not None:
                yield from self.tolerance(kind, t.find(tag), True)

    def definitions(self, names):
        for d in self.root.find(".//CharacteristicDefinitions"):
            kind = d.tag.replace("CharacteristicDefinition", "")
            if kind in names:
                yield names[kind], d

    def size(self, kind, d):
        limits = d.find("Tolerance")
        nominal = self.nominals.get(d.get("id"))
        target = nominal.find("TargetValue") if nominal is not None else None
        if limits is None or target is None:
            return
        scale = (lambda e: float(e.text)) if kind == "angle" else self.value
        nominal = scale(target)
        lower, upper = scale(limits.find("MinValue")), scale(limits.find("MaxValue"))
        if limits.find("DefinedAsLimit").text == "true":
            lower, upper = round(lower - nominal, 9), round(upper - nominal, 9)
        if round(upper / self.mm[self.primary], 9) not in self.left_out:
            yield [kind, number(nominal), number(lower + 0.0), number(upper + 0.0)]


def main():
    what, path = sys.argv[1], sys.argv[2]
    qif = Qif(path, [float(x) for x in sys.argv[3:]])
    if what == "sizes":
        rows = [r for k, d in qif.definitions(SIZES) for r in qif.size(k, d)]
        print("kind,nominal,lower,upper")
    else:
        rows = [r for k, d in qif.definitions(NAMES) for r in qif.tolerance(k, d, False)]
        print("kind,value_mm,zone,datums,modifiers")
    for row in sorted(rows):
        print(",".join(f'"{x}"' if "," in x else x for x in row))


main()
