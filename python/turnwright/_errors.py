"""What calls raise."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Problem:
    """One error in a request."""

    pointer: str  #: JSON pointer to its place, "/outer/0/diameter_mm"; "" for the whole
    got: str  #: the value there, as text
    expected: str  #: what is allowed, with unit and limits
    code: str  #: machine-readable kind: "type", "range", "unknown-key", ...

    def __str__(self):
        return f"{self.pointer or '(document)'}: got {self.got}, expected {self.expected}"


class TurnwrightError(Exception):
    """Base of all that this package raises itself."""


class InputError(TurnwrightError, ValueError):
    """A request that cannot be read; `problems` has all of its errors."""

    def __init__(self, problems):
        super().__init__(problems)
        self.problems = problems

    def __str__(self):
        return "\n".join(str(problem) for problem in self.problems)


class ModelRangeError(TurnwrightError, ValueError):
    """A request outside the range for which a model holds."""


class Cancelled(TurnwrightError):
    """A stop was requested before the result was there."""


class InternalError(TurnwrightError, RuntimeError):
    """A fault of the library, or no memory."""
