"""Pages of Markdown from JSON Schemas: every member of a document with its kind and meaning."""
import json
from pathlib import Path

LIMITS = (("minimum", "≥ {}"), ("exclusiveMinimum", "> {}"), ("maximum", "≤ {}"),
          ("exclusiveMaximum", "< {}"), ("minItems", "{} or more"), ("maxItems", "at most {}"),
          ("pattern", "`{}`"), ("default", "absent: {}"))


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")


def reference(target, here):
    file, _, pointer = target.partition("#")
    page = (file or here).removesuffix(".json") + ".md"
    name = pointer.rsplit("/", 1)[-1]
    place = member(name) if "/properties/" in pointer else name.lower()
    return f"[{name or file}]({page if file else ''}{'#' + place if name else ''})"


def member(name):
    """The place of a document's own member in its page."""
    return "member-" + name.lower()


def kind(schema, here):
    """What a value may be, in one cell."""
    if "$ref" in schema:
        return reference(schema["$ref"], here)
    if "const" in schema:
        return f"`{cell(json.dumps(schema['const']))}`"
    if "enum" in schema:
        return ", ".join(f"`{cell(json.dumps(one))}`" for one in schema["enum"])
    for key in ("oneOf", "anyOf", "allOf"):
        if key in schema and "type" not in schema:
            return " or ".join(dict.fromkeys(kind(one, here) for one in schema[key])) or "any"
    kinds = schema.get("type", "any")
    name = kinds if isinstance(kinds, str) else " or ".join(kinds)
    items = schema.get("items")
    if name == "array" and isinstance(items, dict):
        return f"array of {kind(items, here)}"
    return name


def limits(schema):
    return ", ".join(form.format(cell(json.dumps(schema[key]) if key == "default" else
                                      schema[key]))
                     for key, form in LIMITS if key in schema)


def rows(schema, place, here):
    """A row for each member, those of inner objects below it."""
    required = schema.get("required", [])
    for name, value in schema.get("properties", {}).items():
        if not isinstance(value, dict) or name == "$schema":
            continue
        path = f"{place}{name}"
        anchor = "" if place else f'<a id="{member(name)}"></a>'
        must = " **(required)**" if name in required else ""
        yield (f"| {anchor}`{path}`{must} | {kind(value, here)} | {limits(value)} | "
               f"{cell(value.get('description', ''))} |")
        yield from inner(value, path, here)
    for one in schema.get("oneOf", []) + schema.get("anyOf", []):
        if isinstance(one, dict):
            yield from rows({key: value for key, value in one.items() if key != "required"}
                            | {"required": one.get("required", [])}, place, here)


def inner(value, path, here):
    items = value.get("items")
    if isinstance(items, dict):
        yield from inner(items, path + "[]", here)
    elif "$ref" not in value:
        yield from rows(value, path + ".", here)


def table(schema, here):
    found = list(rows(schema, "", here))
    if not found:
        return f"{kind(schema, here)} {limits(schema)}\n"
    return "\n".join(["| member | kind | limits | meaning |", "| --- | --- | --- | --- |",
                      *found]) + "\n"


def page(file):
    schema = json.loads(file.read_text())
    text = [f"# {schema.get('title', file.stem)}\n", schema.get("description", "") + "\n",
            f"The schema itself: [schemas/{file.name}]({file.name})\n",
            table(schema, file.name)]
    for name, definition in schema.get("definitions", {}).items():
        text += [f"## {name}\n", definition.get("description", "") + "\n",
                 table(definition, file.name)]
    return "\n".join(text)


def write(schemas, folder):
    """A page of each schema and a list of them."""
    listed = ["# Documents\n", "Requests, results and the catalogue's documents, from their "
              "JSON Schemas.\n"]
    for file in sorted(Path(schemas).glob("*.json")):
        (folder / f"{file.stem}.md").write_text(page(file))
        (folder / file.name).write_text(file.read_text())
        title = json.loads(file.read_text()).get("title", file.stem)
        listed.append(f"- [{title}]({file.stem}.md): `{file.name}`")
    (folder / "index.md").write_text("\n".join(listed) + "\n")
