#!/usr/bin/env python3
"""The fuzzers' corpus: a file per target here (corpus/TARGET.jsonl, an input per line, bytes
as the characters of their numbers), a folder per target for libFuzzer.

Usage: corpus.py unpack FOLDER   the kept inputs, the schemas' examples and parts/; prints
                                 the targets
       corpus.py pack FOLDER     keeps what is there, the short ones first, 40 kB per target"""
import base64
import io
import json
import pathlib
import sys
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KEPT = pathlib.Path(__file__).resolve().parent / "corpus"
MOST_BYTES = 40_000


def http(method, path, body=""):
    return (f"{method} {path} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
            f"Content-Length: {len(body)}\r\n\r\n{body}")


def seeds():
    """(target, input) of all that is known to be right."""
    for part in sorted((ROOT / "parts").glob("*.json")):
        for door in "plan", "drawing", "nc", "predict":
            yield door, part.read_text()
        yield "quote", f'{{"parts": [{part.read_text()}], "batches": [1, 100]}}'
    for schema in sorted((ROOT / "schemas").glob("*.request.json")):
        door = schema.name.removesuffix(".request.json")
        for example in json.loads(schema.read_text()).get("examples", []):
            text = json.dumps(example)
            yield door, text
            yield "batch", json.dumps({"name": door, "document": example})
            yield "json", text
            yield "http", http("POST", f"/v1/{door}", text)
            if door == "compensate":
                program = example["program"]
                program = program if isinstance(program, str) else "\n".join(program)
                yield "program", program
                yield "program-lathe", program
            if door == "listen":
                yield "sound", base64.b64decode(example["wav"]).decode("latin-1")
            if "comp_file" in example:
                yield "comp-file", "\n".join(example["comp_file"]["text"])
            if door == "review":
                yield "review-fanuc", example["programs"][0]["text"]
            for table in tables(example):
                taps = "frf-taps" if table.startswith("t [s]") else "frf-csv"
                yield taps if door == "stability" else "csv-" + door, table
                if door == "stability":
                    yield "frf-file", table
    for program in sorted((ROOT / "tests" / "data" / "nc").rglob("*.*")):
        control = {".ngc": "linuxcnc", ".mpf": "siemens"}.get(program.suffix)
        if control:
            yield "review-" + control, program.read_text()
    for kind, pattern in ("step", "step/cases/*.step"), ("dxf", "dxf/*.dxf"):
        for drawing in sorted((ROOT / "tests" / "data").glob(pattern)):
            yield f"drawing-{kind}", drawing.read_text()
            yield "drawing-file", drawing.read_bytes().decode("latin-1")
    for file in sorted((ROOT / "tests" / "data" / "uff").rglob("*.uff")):
        yield "frf-uff", file.read_bytes().decode("latin-1")
        yield "frf-file", file.read_bytes().decode("latin-1")
    yield "frf-file", "400\t1e-8\t-2e-8\tFreq\tHz\tReal\tm/N\tImag\n401\t2e-8\t-1e-8\t\n"
    for file in sorted((ROOT / "tests" / "data" / "qif").glob("*.qif")):
        yield "qif", file.read_text()
    for library in sorted((ROOT / "tests" / "data" / "tools").glob("*.[cjxf]*")):
        yield "library", library.read_bytes().decode("latin-1")
        yield "library", zipped(library).decode("latin-1")
    yield "drawing-notation", "d50 h7 x 40 Ra1.6; 1x45; d30 k6 x 32; bore d20 H7 x 60"
    yield "http", http("GET", "/v1/parts/pump-shaft")
    yield "http", ("POST /v1/plan HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n"
                   "\r\n2\r\n{}\r\n0\r\n\r\n")


def zipped(file):
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as zip_file:
        entry = zipfile.ZipInfo("tools.json" if file.suffix == ".json" else file.name)
        zip_file.writestr(entry, file.read_bytes())
    return archive.getvalue()


def tables(value):
    if isinstance(value, dict):
        if "csv" in value:
            csv = value["csv"]
            yield csv if isinstance(csv, str) else "\n".join(csv)
        for member in value.values():
            yield from tables(member)
    elif isinstance(value, list):
        for member in value:
            yield from tables(member)


def unpack(folder):
    count = {}
    kept = ((file.stem, json.loads(line)) for file in sorted(KEPT.glob("*.jsonl"))
            for line in file.read_text().splitlines())
    for target, text in [*kept, *seeds()]:
        data = text.encode("latin-1" if all(ord(c) < 256 for c in text) else "utf-8")
        count[target] = count.get(target, 0) + 1
        (folder / target).mkdir(parents=True, exist_ok=True)
        (folder / target / f"seed-{count[target]}").write_bytes(data)
    print(*sorted(count), sep="\n")


def pack(folder):
    KEPT.mkdir(exist_ok=True)
    for target in sorted(folder.iterdir()):
        inputs = sorted((f.read_bytes() for f in target.iterdir()),
                        key=lambda data: (len(data), data))
        lines, size = [], 0
        for data in inputs:
            line = json.dumps(data.decode("latin-1"), ensure_ascii=True)
            size += len(line)
            if size > MOST_BYTES:
                break
            lines.append(line)
        (KEPT / f"{target.name}.jsonl").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    {"unpack": unpack, "pack": pack}[sys.argv[1]](pathlib.Path(sys.argv[2]))
