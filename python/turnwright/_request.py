"""Requests as JSON text."""
import json
import math

from ._errors import InputError, Problem


def text(request):
    """The request as JSON.  NumPy's arrays and numbers are taken as lists and numbers.

    Raises InputError with the place of everything that JSON does not have.
    """
    try:
        return json.dumps(request, allow_nan=False, default=_plain)
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(list(_problems(request, "")) or
                         [Problem("", str(error), "a JSON document", "type")]) from None


def _plain(value):
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(type(value).__name__)


def _problems(value, pointer, depth=0):
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        yield Problem(pointer, str(value), "a finite number", "range")
    elif depth > 64:
        yield Problem(pointer, "a deeper value", "at most 64 levels", "range")
    elif isinstance(value, dict):
        for key, member in value.items():
            place = f"{pointer}/{str(key).replace('~', '~0').replace('/', '~1')}"
            if not isinstance(key, str):
                yield Problem(place, f"the key {key!r}", "text", "type")
            yield from _problems(member, place, depth + 1)
    elif isinstance(value, (list, tuple)):
        for index, member in enumerate(value):
            yield from _problems(member, f"{pointer}/{index}", depth + 1)
    elif not (value is None or isinstance(value, (str, int, float))):
        yield Problem(pointer, type(value).__name__, "a JSON value", "type")
