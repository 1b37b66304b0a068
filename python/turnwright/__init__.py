"""Certified plans of turned parts.

Every capability of Turnwright is a function from a dict to a Result, which is a dict, too:

    import turnwright
    plan = turnwright.plan(turnwright.document("parts", "pump-shaft"))
    plan["cost_per_part"], plan.drawings["setup-1.svg"]

Requests and results are the documents of the command line; `turnwright.documents` has their
types.  A wrong request raises InputError with the JSON pointer of every problem.  That a part
cannot be made is a result, whose "status" is "infeasible".
"""
from ._catalogue import Catalogue, default
from ._errors import (Cancelled, InputError, InternalError, ModelRangeError, Problem,
                      TurnwrightError)
from ._library import Stop, capabilities, version
from ._naming import identifier
from ._result import Picture, Result, columns

__version__ = version()


def document(kind, id):
    """A document of the catalogue: document("parts", "pump-shaft")."""
    return default().document(kind, id)


def ids(kind):
    """The ids of "materials", "tools", "machines", "shops", "parts" or "schemas"."""
    return default().ids(kind)


def example(name):
    """A request that the capability `name` answers as it stands."""
    examples = {row["name"]: row["example"] for row in capabilities()}
    if name not in examples:
        raise KeyError(f"no capability {name!r}: there are {', '.join(examples)}")
    return examples[name]


def _function(row):
    def function(request, *, drawings=False, progress=None, stop=None, catalogue=None):
        return (catalogue or default()).answer(row["name"], request, drawings=drawings,
                                               progress=progress, stop=stop)

    function.__name__ = function.__qualname__ = identifier(row["name"])
    function.__doc__ = f"""{row["summary"].replace("->", "to")}.

    request    as schemas/{row["request_schema"]} says; the result as {row["result_schema"]}
    drawings   True: with pictures at once, which are otherwise computed when they are used
    progress   called as progress(done, all) after each part of a long sweep
    stop       a Stop that ends the call early: it then raises Cancelled
    catalogue  instead of the package's own
    """
    return function


_functions = {identifier(row["name"]): _function(row) for row in capabilities()}
globals().update(_functions)

__all__ = ["Cancelled", "Catalogue", "InputError", "InternalError", "ModelRangeError",
           "Picture", "Problem", "Result", "Stop", "TurnwrightError", "capabilities",
           "columns", "document", "example", "ids", "version", *_functions]
