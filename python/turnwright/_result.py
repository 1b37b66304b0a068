"""Results, their pictures and their numbers."""
from functools import cached_property
from typing import Any, Generic, TypeVar

Document = TypeVar("Document")


class Picture(str):
    """An SVG picture, which a notebook shows."""

    def _repr_svg_(self):
        return str(self)


class Result(dict[str, Any], Generic[Document]):
    """A result document.  A notebook shows its first picture.

    The pictures, where a call was not asked for them (`drawings=True`), are computed with
    the same result once more when they are first used.
    """

    def __init__(self, document, redraw):
        super().__init__(document)
        self._redraw = redraw  # catalogue, name and request

    @property
    def document(self) -> Document:
        """This result, typed as its schema says."""
        return self  # type: ignore[return-value]

    @cached_property
    def _drawn(self):
        catalogue, name, request = self._redraw
        return catalogue._answered(name, request, drawings=True)

    @property
    def drawings(self) -> dict[str, Picture]:
        """The pictures by name, "setup-1.svg"; none where a capability has none."""
        return {one["name"]: Picture(one["svg"]) for one in self._drawn["drawings"]}

    @property
    def report(self) -> str | None:
        """The report, a page of HTML to print; None where a capability has none."""
        return self._drawn.get("report")

    def _repr_svg_(self):
        return next(iter(self.drawings.values()), None)


def columns(rows):
    """The numbers in a list of objects as one NumPy array for each member.

    What is absent or null in a row is nan there.  Members that are no numbers are left out.
    """
    import numpy

    def is_number(value):
        return isinstance(value, (int, float)) and not isinstance(value, bool)

    names = dict.fromkeys(name for row in rows for name, value in row.items()
                          if is_number(value))
    return {name: numpy.array([row.get(name) if is_number(row.get(name)) else numpy.nan
                               for row in rows], dtype=float) for name in names}
