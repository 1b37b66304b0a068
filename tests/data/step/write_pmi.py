#!/usr/bin/env python3
"""Writes reference parts as AP242 with all their demands as product data.

    tests/data/step/write_pmi.py            writes pmi/NAME.stp of each part of PARTS

The shapes are FreeCAD's, of reference/freecad/; fits, limits, lengths, geometric tolerances
with their datums, roughness, threads, material and general tolerances of parts/NAME.json
are added as instances of ISO 10303-242.  Faces are found by their radius and place.
"""
import json
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent.parent
PARTS = ["gearbox-input-shaft", "motor-shaft", "threaded-spindle"]

ENTITY = {
    "straightness": "STRAIGHTNESS", "circularity": "ROUNDNESS", "flatness": "FLATNESS",
    "cylindricity": "CYLINDRICITY", "profile": "SURFACE_PROFILE",
    "profile-without-datum": "SURFACE_PROFILE", "parallelism": "PARALLELISM",
    "perpendicularity": "PERPENDICULARITY", "angularity": "ANGULARITY",
    "position": "POSITION", "coaxiality": "COAXIALITY",
    "circular-radial-runout": "CIRCULAR_RUNOUT", "circular-axial-runout": "CIRCULAR_RUNOUT",
    "total-radial-runout": "TOTAL_RUNOUT", "total-axial-runout": "TOTAL_RUNOUT"}


class Shape:
    """The instances of a file, and the faces of its turned solid."""

    def __init__(self, text):
        self.instances = {int(i): body.replace("\n", "") for i, body in re.findall(
            r"^#(\d+) = (.*?);$", text, flags=re.M | re.S)}
        self.faces = [self.face(i) for i, body in self.instances.items()
                      if body.startswith("ADVANCED_FACE")]

    def references(self, i):
        return [int(r) for r in re.findall(r"#(\d+)", self.instances[i])]

    def one(self, entity):
        return next(i for i, b in self.instances.items() if b.startswith(entity + "("))

    def face(self, i):
        *bounds, surface = self.references(i)
        kind, radius = re.match(r"(\w+)\('',#\d+(?:,([\d.E+-]+))?",
                                self.instances[surface]).groups()
        places = []
        for bound in bounds:
            for oriented in self.references(self.references(bound)[0]):
                edge = self.references(oriented)[0]
                for vertex in self.references(edge)[:2]:
                    point = self.instances[self.references(vertex)[0]]
                    places.append(float(re.search(r"'',\(([^,]+),", point).group(1)))
        return {"id": i, "kind": kind, "radius": float(radius or 0),
                "from": min(places), "to": max(places)}

    def cylinders(self, d, z0, z1):
        return [f["id"] for f in self.faces if f["kind"] == "CYLINDRICAL_SURFACE"
                and abs(f["radius"] - d / 2) < 1e-6 and f["from"] > z0 - 1e-6
                and f["to"] < z1 + 1e-6]

    def planes(self, z):
        return [f["id"] for f in self.faces if f["kind"] == "PLANE"
                and abs(f["from"] - z) < 1e-6 and abs(f["to"] - z) < 1e-6]


class Pmi:
    """Instances added to a shape."""

    def __init__(self, part, shape):
        self.shape, self.next, self.lines = shape, max(shape.instances) + 1, []
        self.definition = shape.one("PRODUCT_DEFINITION_SHAPE")
        self.representation = shape.one("ADVANCED_BREP_SHAPE_REPRESENTATION")
        self.context = next(i for i, b in shape.instances.items()
                            if "GEOMETRIC_REPRESENTATION_CONTEXT(3)" in b)
        self.mm = next(i for i, b in shape.instances.items() if "LENGTH_UNIT" in b)
        self.um = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MICRO.,.METRE.))")
        self.places, self.features, self.datums = self.places_of(part), {}, {}

    def add(self, body):
        self.lines.append(f"#{self.next} = {body};")
        self.next += 1
        return self.next - 1

    def places_of(self, part):
        places, z = {"left": self.shape.planes(0)}, 0
        for i, e in enumerate(part["outer"]):
            if i:
                places[f'{part["outer"][i - 1]["id"]}|{e["id"]}'] = self.shape.planes(z)
            d = e.get("diameter_mm") or re.match(r"M([\d.]+)|$",
                                                 e.get("designation", "")).group(1)
            if d:
                places[e["id"]] = self.shape.cylinders(float(d), z, z + e["length_mm"])
            z += e["length_mm"]
        places["right"] = self.shape.planes(z)
        return places

    def feature(self, place):
        if place not in self.features:
            aspect = self.add(f"SHAPE_ASPECT('{place}','',#{self.definition},.T.)")
            self.tie(aspect, place)
            self.features[place] = aspect
        return self.features[place]

    def tie(self, aspect, place):
        assert self.places[place], place
        for face in self.places[place]:
            self.add(f"GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#{aspect},"
                     f"#{self.representation},#{face})")

    def datum(self, place):
        if place not in self.datums:
            letter = "ABCDEFGHJK"[len(self.datums)]
            datum = self.add(f"DATUM('','',#{self.definition},.F.,'{letter}')")
            of = self.add(f"DATUM_FEATURE('{letter}','',#{self.definition},.T.)")
            self.add(f"SHAPE_ASPECT_RELATIONSHIP('','',#{of},#{datum})")
            self.tie(of, place)
            self.datums[place] = datum
        return self.datums[place]

    def system(self, datum):
        if isinstance(datum, list):
            elements = ",".join("#%d" % self.add(
                f"DATUM_REFERENCE_ELEMENT('','',#{self.definition},.F.,#{self.datum(d)},$)")
                for d in datum)
            of = f"COMMON_DATUM_LIST(({elements}))"
        else:
            of = f"#{self.datum(datum)}"
        one = self.add(f"DATUM_REFERENCE_COMPARTMENT('','',#{self.definition},.F.,{of},$)")
        return self.add(f"DATUM_SYSTEM('','',#{self.definition},.F.,(#{one}))")

    def length(self, x):
        return self.add(f"LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({number(x)}),#{self.mm})")

    def size(self, dimension, nominal, note=None):
        items = [self.add(f"MEASURE_REPRESENTATION_ITEM('nominal value',"
                          f"POSITIVE_LENGTH_MEASURE({number(nominal)}),#{self.mm})")]
        if note:
            items.append(self.add(
                f"DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note','{note}')"))
        shown = self.add("SHAPE_DIMENSION_REPRESENTATION('',(%s),#%d)" % (
            ",".join(f"#{i}" for i in items), self.context))
        self.add(f"DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#{dimension},#{shown})")

    def limits(self, dimension, lower, upper):
        bounds = self.add(f"TOLERANCE_VALUE(#{self.length(lower)},#{self.length(upper)})")
        self.add(f"PLUS_MINUS_TOLERANCE(#{bounds},#{dimension})")

    def element(self, e):
        thread = e.get("designation")
        if not thread and "fit" not in e and "limits_mm" not in e:
            return
        dimension = self.add(f"DIMENSIONAL_SIZE(#{self.feature(e['id'])},'diameter')")
        if thread:
            d = float(re.match(r"M([\d.]+)", thread).group(1))
            self.size(dimension, d, thread + ("-" + e["fit"] if "fit" in e else ""))
            return
        self.size(dimension, e["diameter_mm"])
        if "fit" in e:
            letters, grade = re.match(r"([a-zA-Z]+)(\d+)", e["fit"]).groups()
            fit = self.add(f"LIMITS_AND_FITS('{letters}','shaft','{grade}','ISO 286')")
            self.add(f"PLUS_MINUS_TOLERANCE(#{fit},#{dimension})")
        else:
            self.limits(dimension, *e["limits_mm"])

    def roughness(self, place, ra):
        of = self.add(f"PROPERTY_DEFINITION('surface_condition','',#{self.feature(place)})")
        method = self.add("DESCRIPTIVE_REPRESENTATION_ITEM('measuring method','Ra')")
        value = self.add(f"MEASURE_REPRESENTATION_ITEM('characteristic value',"
                         f"LENGTH_MEASURE({number(ra)}),#{self.um})")
        shown = self.add("SURFACE_TEXTURE_REPRESENTATION('surface texture parameter',"
                         f"(#{method},#{value}),#{self.context})")
        self.add(f"PROPERTY_DEFINITION_REPRESENTATION(#{of},#{shown})")

    def place_z(self, place):
        face = next(f for f in self.shape.faces if f["id"] == self.places[place][0])
        return face["from"]

    def tolerance(self, t):
        if t["kind"] == "length":
            a, b = t["between"]
            dimension = self.add("DIMENSIONAL_LOCATION('linear distance','',"
                                 f"#{self.feature(a)},#{self.feature(b)})")
            self.size(dimension, abs(self.place_z(b) - self.place_z(a)))
            self.limits(dimension, *t["limits_mm"])
            return
        value, of = self.length(t["value_mm"]), self.feature(t["of"])
        entity = ENTITY[t["kind"]] + "_TOLERANCE"
        datum = f",(#{self.system(t['datum'])})" if "datum" in t else ""
        self.add(f"{entity}('{t['id']}','',#{value},#{of}{datum})")

    def text(self, name, key, text):
        of = self.add(f"PROPERTY_DEFINITION('{name}','',#{self.definition})")
        item = self.add(f"DESCRIPTIVE_REPRESENTATION_ITEM('{key}','{text}')")
        shown = self.add(f"REPRESENTATION('',(#{item}),#{self.context})")
        self.add(f"PROPERTY_DEFINITION_REPRESENTATION(#{of},#{shown})")


def number(x):
    text = repr(float(x)).upper()
    return text if "." in text else text.replace("E", ".E")


def main():
    for name in PARTS:
        part = json.loads((ROOT / "parts" / f"{name}.json").read_text())
        text = (FOLDER / "reference" / "freecad" / f"{name}.step").read_text()
        pmi = Pmi(part, Shape(text))
        for e in part["outer"]:
            pmi.element(e)
            if "Ra_um" in e:
                pmi.roughness(e["id"], e["Ra_um"])
        for face in part["faces"]:
            pmi.roughness(face["id"], face["Ra_um"])
        for t in part["tolerances"]:
            pmi.tolerance(t)
        pmi.text("material property", "material", part["material"])
        pmi.text("semantic text", "", "Tolerances not given: " + part["general"])
        head, tail = text.rsplit("ENDSEC;", 1)
        head = re.sub(r"FILE_SCHEMA\(\(.*?\)\);", "FILE_SCHEMA(("
                      "'AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }'"
                      "));", head, count=1, flags=re.S)
        (FOLDER / "pmi" / f"{name}.stp").write_text(
            head + "\n".join(pmi.lines) + "\nENDSEC;" + tail)


main()
