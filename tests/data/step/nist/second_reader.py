#!/usr/bin/env python3
"""Table of CTC-02, of which no QIF file is public: second_reader.py sizes|tolerances FILE.stp

Regular expressions on single statements, for this one file, instead of a Part 21 reader.
The letters of the datums are not those of the datum systems but the text of the validation
property 'datum references', which the exporting program has written beside them.
"""
import re
import sys

text = open(sys.argv[2], encoding="latin-1").read()
statements = dict(re.findall(r"^#(\d+)=(.*);$", text, re.M))


def millimetres(number):
    value = re.search(r"LENGTH_MEASURE\(([-\d.E]+)\),#(\d+)", statements[number])
    assert ".MILLI.,.METRE." in statements[value.group(2)]
    return f"{float(value.group(1)):.6g}"


def referring(word, number):
    return [n for n, s in statements.items() if s.startswith(word) and f"#{number}" in
            re.findall(r"#\d+", s)]


def letters(number):
    for definition in referring("PROPERTY_DEFINITION('pmi", number):
        for relation in referring("PROPERTY_DEFINITION_REP", definition):
            used = re.findall(r"#(\d+)", statements[relation])[1]
            for item in re.findall(r"#(\d+)", statements[used]):
                found = re.search(r"'datum references','([A-Z,]*|none)'",
                                  statements.get(item, ""))
                if found:
                    return found.group(1).replace("none", "").replace(",", " ")
    return ""


def tolerances():
    yield "kind,value_mm,zone,datums,modifiers"
    for number, s in statements.items():
        if "_TOLERANCE(" not in s or "PLUS_MINUS" in s:
            continue
        kind = re.search(r"(FLATNESS|PERPENDICULARITY|POSITION|SURFACE_PROFILE"
                         r"|LINE_PROFILE)_TOLERANCE", s).group(1)
        magnitude = re.search(r"'[^']*','',#(\d+),", s).group(1)
        modifiers = []
        if "(MAXIMUM_MATERIAL" in s.replace(".", ""):
            modifiers.append("maximum material requirement")
        if "(LEAST_MATERIAL" in s.replace(".", ""):
            modifiers.append("least material requirement")
        if "UNEQUALLY" in s:
            off = re.search(r"UNEQUALLY_DISPOSED_GEOMETRIC_TOLERANCE\(#(\d+)", s).group(1)
            modifiers.append(f"unequally disposed by {millimetres(off)} mm")
        zone = "diameter" if referring("TOLERANCE_ZONE(", number) else ""
        yield ",".join([kind.lower().replace("_", " "), millimetres(magnitude), zone,
                        letters(number), ", ".join(modifiers)])


def sizes():
    yield "kind,nominal,lower,upper"
    for number, s in statements.items():
        if not s.startswith("DIMENSIONAL_SIZE("):
            continue
        shown = statements[referring("DIMENSIONAL_CHARACTERISTIC", number)[0]]
        items = statements[re.findall(r"#(\d+)", shown)[1]]
        bounds = statements[re.search(
            r"#(\d+)", statements[referring("PLUS_MINUS", number)[0]]).group(1)]
        lower, upper = re.findall(r"#(\d+)", bounds)
        yield ",".join(["diameter", millimetres(re.search(r"\(#(\d+)\)", items).group(1)),
                        millimetres(lower), millimetres(upper)])


rows = list(tolerances() if sys.argv[1] == "tolerances" else sizes())
print("\n".join(rows[:1] + sorted(rows[1:])))
