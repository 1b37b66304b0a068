"""Catalogues: materials, tools and machines that requests refer to by id."""
import json
from functools import lru_cache

from . import _request
from ._library import Handle
from ._result import Result


KINDS = ("materials", "tools", "machines", "shops", "parts", "schemas")


class Catalogue:
    """The documents of a folder with materials/, tools/ and machines/.

    Without a folder: that which TURNWRIGHT_DATA names, else the one in this package.
    A catalogue does not change, and any number of threads may use it at once.
    """

    def __init__(self, folder=None):
        self._handle = Handle(folder)

    def __reduce__(self):
        return Catalogue, (str(self.folder),)

    @property
    def folder(self):
        """Where the documents lie."""
        return self._handle.folder

    def ids(self, kind):
        """The ids of "materials", "tools", "machines", "shops", "parts" or "schemas"."""
        return sorted(file.stem for file in self._files(kind))

    def _files(self, kind):
        if kind not in KINDS:
            raise KeyError(f"no kind {kind!r} of documents: there are {', '.join(KINDS)}")
        return (self.folder / kind).rglob("*.json")

    def document(self, kind, id):
        """One of them, as a dict: document("parts", "pump-shaft")."""
        for file in self._files(kind):
            if file.stem == id:
                return json.loads(file.read_text())
        raise KeyError(f"no {id} in {kind}: there are {', '.join(self.ids(kind))}")

    def answer(self, name, request, *, drawings=False, progress=None, stop=None):
        """The result of the capability `name`, as the functions of this package give it."""
        text = _request.text(request)
        answer = self._answered(name, text, drawings, progress, stop)
        result = Result(answer["result"] if drawings else answer, (self, name, text))
        if drawings:
            result._drawn = answer
        return result

    def _answered(self, name, text, drawings, progress=None, stop=None):
        return self._handle.answer(name, text, drawings, progress, stop)


@lru_cache(maxsize=1)
def default():
    """The catalogue of calls that name none."""
    return Catalogue()
