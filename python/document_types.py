"""Writes the types of a package's documents from its JSON Schemas: turnwright/documents.py, and
turnwright/__init__.pyi, the signatures of the capabilities.

Usage: document_types.py PACKAGE_FOLDER
"""
import ctypes
import json
import keyword
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "turnwright"))
from _naming import identifier  # noqa: E402  (the package itself cannot be imported yet)

SIMPLE = {"string": "str", "number": "float", "integer": "int", "boolean": "bool",
          "null": "None"}
NOT_WRITTEN = ("$schema",)


def camel(name):
    return "".join(word[:1].upper() + word[1:] for word in re.split(r"[^0-9A-Za-z]+", name))


def root_name(file):
    """part.json -> Part, plan.result.json -> PlanResult."""
    return camel(file.removesuffix(".json"))


def union(types):
    return " | ".join(dict.fromkeys(types)) or "Any"


def variant(schema, index):
    """What tells one of several objects from the others: its kind, else its place."""
    properties = schema.get("properties", {})
    for key in ("kind", "model"):
        kind = properties.get(key, {}).get("const")
        if isinstance(kind, str):
            return camel(kind)
    return str(index + 1)


class Types:
    """The classes of one schema file, innermost first."""

    def __init__(self, file, schema, lists):
        self.file, self.lists, self.classes = file, lists, {}
        self.schema = schema
        for name, definition in schema.get("definitions", {}).items():
            self.alias(self.of_definition(name), definition)
        self.alias(root_name(file), schema)

    def of_definition(self, name):
        return root_name(self.file) + camel(name)

    def alias(self, name, schema):
        told = self.type(schema, name)
        if told != f'"{name}"':
            self.classes[name] = f"{name}: TypeAlias = {quoted(told, True)}\n"

    def type(self, schema, name):
        """The type of a value; classes that it needs are called `name` and what follows."""
        if not isinstance(schema, dict):
            return "Any"
        if "$ref" in schema:
            return self.referred(schema["$ref"])
        if "const" in schema:
            return f"Literal[{schema['const']!r}]"
        if "enum" in schema:
            return f"Literal[{', '.join(repr(one) for one in schema['enum'])}]"
        for key in ("oneOf", "anyOf"):
            if key in schema and "properties" not in schema and "type" not in schema:
                return union(self.type(one, name + variant(one, i))
                             for i, one in enumerate(schema[key]))
        if "allOf" in schema and "type" not in schema and "properties" not in schema:
            return self.type(schema["allOf"][0], name)
        kinds = schema.get("type", "object" if "properties" in schema else [])
        return union(self.of_kind(kind, schema, name)
                     for kind in ([kinds] if isinstance(kinds, str) else kinds))

    def of_kind(self, kind, schema, name):
        if kind == "array":
            items = schema.get("items", {})
            if isinstance(items, list):
                return f"{self.lists}[{union(self.type(one, name) for one in items)}]"
            return f"{self.lists}[{self.type(items, name + 'Item')}]"
        return self.object(schema, name) if kind == "object" else SIMPLE[kind]

    def referred(self, reference):
        file, _, pointer = reference.partition("#")
        names = [camel(part) for part in pointer.split("/") if part and part != "definitions"]
        return f'"{root_name(file or self.file)}{"".join(names)}"'

    def object(self, schema, name):
        members = {key: member for key, member in schema.get("properties", {}).items()
                   if key not in NOT_WRITTEN and member is not False}
        if not members:
            more = [*schema.get("patternProperties", {}).values(),
                    schema.get("additionalProperties")]
            kinds = [self.type(one, name + "Value") for one in more if isinstance(one, dict)]
            return f"dict[str, {union(kinds)}]"
        required = schema.get("required", [])
        fields = {key: (self.type(member, name + camel(key)), key in required,
                        member.get("description") if isinstance(member, dict) else None)
                  for key, member in members.items()}
        self.classes[name] = typed_dict(name, schema.get("description"), fields)
        return f'"{name}"'


def docstring(text, indent):
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'{indent}"""{escaped}"""\n'


def typed_dict(name, description, fields):
    if not all(key.isidentifier() and not keyword.iskeyword(key) for key in fields):
        members = ", ".join(f"{key!r}: {quoted(*field[:2])}" for key, field in fields.items())
        return f"{name} = TypedDict({name!r}, {{{members}}})\n"
    text = f"class {name}(TypedDict):\n"
    text += docstring(description, "    ") + "\n" if description else ""
    for key, (told, required, meaning) in fields.items():
        text += f"    {key}: {quoted(told, required)}\n"
        text += docstring(meaning, "    ") if meaning else ""
    return text


def quoted(told, required):
    """The whole annotation as text, so that classes may refer to later ones."""
    told = told.replace('"', "")
    return repr(told) if required else f"NotRequired[{told!r}]"


HEAD = '''"""Types of requests and results, made from the schemas; see schemas/*.json."""
from collections.abc import Sequence
from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

'''

STUB = '''"""Signatures of the capabilities, made from the request table."""
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from . import documents
from ._errors import (Cancelled as Cancelled, InputError as InputError,
                      InternalError as InternalError, ModelRangeError as ModelRangeError,
                      Problem as Problem, TurnwrightError as TurnwrightError)
from ._library import Stop as Stop
from ._result import Picture as Picture, Result as Result

__version__: str
Progress = Callable[[int, int], object]


class Catalogue:
    def __init__(self, folder: str | PathLike[str] | None = None) -> None: ...
    @property
    def folder(self) -> Path: ...
    def ids(self, kind: str) -> list[str]: ...
    def document(self, kind: str, id: str) -> Any: ...
    def answer(self, name: str, request: Any, *, drawings: bool = False,
               progress: Progress | None = None,
               stop: Stop | None = None) -> Result[Any]: ...


def version() -> str: ...
def capabilities() -> list[dict[str, Any]]: ...
def document(kind: str, id: str) -> Any: ...
def ids(kind: str) -> list[str]: ...
def example(name: str) -> Any: ...
def columns(rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]: ...
'''


def capabilities(package):
    """Those of the package's library."""
    library = ctypes.CDLL(str(next(package.glob("lib/**/libturnwright.so"))))
    library.turnwright_capabilities.restype = ctypes.c_char_p  # kept: the process ends
    return json.loads(library.turnwright_capabilities())


def signature(row):
    request, result = root_name(row["request_schema"]), root_name(row["result_schema"])
    return f'''
def {identifier(row["name"])}(request: documents.{request}, *, drawings: bool = False,
        progress: Progress | None = None, stop: Stop | None = None,
        catalogue: Catalogue | None = None) -> Result[documents.{result}]:
    """{row["summary"].replace("->", "to")}"""
'''


def write(package):
    """Writes both files into a package that has its library and data."""
    classes = {}
    for file in sorted((package / "share" / "turnwright" / "schemas").glob("*.json")):
        lists = "list" if file.name.endswith(".result.json") else "Sequence"
        classes |= Types(file.name, json.loads(file.read_text()), lists).classes
    (package / "documents.py").write_text(HEAD + "\n\n".join(classes.values()))
    (package / "__init__.pyi").write_text(STUB + "".join(map(signature, capabilities(package))))


if __name__ == "__main__":
    write(Path(sys.argv[1]))
