"""Executes the code cells of notebooks in their order, as a kernel does, and shows the value at
the end of each cell as a notebook would.  Usage: notebook_test.py NOTEBOOK.ipynb..
"""
import ast
import json
import sys
import time
from pathlib import Path


def shown(value):
    """The picture or text that a notebook shows of a value."""
    picture = getattr(value, "_repr_svg_", lambda: None)()
    return f"<picture of {len(picture)} bytes>" if picture else repr(value)


def execute(cell, names):
    tree = ast.parse(cell)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "<cell>", "exec"), names)
    value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if last else None
    if value is not None:
        print(shown(value))


def run(notebook):
    cells = json.loads(notebook.read_text())["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    assert code, f"{notebook.name} has no code"
    names, begun = {"__name__": "__main__"}, time.perf_counter()
    for number, cell in enumerate(code, 1):
        try:
            execute(cell, names)
        except Exception as error:
            raise SystemExit(f"{notebook.name}, code cell {number}: {error!r}\n{cell}") from error
    print(f"{notebook.name}: {len(code)} cells in {time.perf_counter() - begun:.1f} s")


for file in sys.argv[1:]:
    run(Path(file))
