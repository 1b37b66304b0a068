"""The C library, include/turnwright/turnwright.h, by ctypes, which releases the interpreter's
lock during every call."""
import ctypes
import json
import threading
from ctypes import POINTER, byref, c_char_p, c_int, c_size_t, c_void_p
from pathlib import Path

from ._errors import Cancelled, InputError, InternalError, ModelRangeError, Problem

_OK, _WRONG_INPUT, _OUTSIDE_RANGE, _CANCELLED = 0, 2, 3, 4
_Progress = ctypes.CFUNCTYPE(None, c_size_t, c_size_t, c_void_p)


class _Options(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("stop", c_void_p), ("progress", _Progress),
                ("user", c_void_p), ("drawings", c_int)]


def _loaded():
    library = ctypes.CDLL(str(next(Path(__file__).parent.glob("lib/**/libturnwright.so"))))
    for name, result, arguments in (
            ("version", c_char_p, []),
            ("capabilities", c_void_p, []),
            ("open", c_int, [c_char_p, POINTER(c_void_p), POINTER(c_void_p)]),
            ("close", None, [c_void_p]),
            ("folder", c_char_p, [c_void_p]),
            ("answer", c_int, [c_void_p, c_char_p, c_char_p, POINTER(_Options),
                               POINTER(c_void_p)]),
            ("free", None, [c_void_p]),
            ("stop_new", c_void_p, []),
            ("stop_request", None, [c_void_p]),
            ("stop_free", None, [c_void_p])):
        function = getattr(library, "turnwright_" + name)
        function.restype, function.argtypes = result, arguments
    return library


_c = _loaded()


def version():
    """The library's version."""
    return _c.turnwright_version().decode()


def _taken(pointer):
    """The document of a text that the library gave, which is freed."""
    if not pointer:
        raise InternalError("no memory")
    try:
        return json.loads(ctypes.string_at(pointer))
    finally:
        _c.turnwright_free(pointer)


def capabilities():
    """The rows of the request table: name, summary, example, schemas, drawings."""
    return _taken(_c.turnwright_capabilities())


def _checked(status, document):
    """The document, if it is a result."""
    if status == _OK:
        return document
    if status == _WRONG_INPUT:
        raise InputError([Problem(**problem) for problem in document["errors"]])
    kind = {_OUTSIDE_RANGE: ModelRangeError, _CANCELLED: Cancelled}
    raise kind.get(status, InternalError)(document["detail"])


class Stop:
    """A wish to end calls early: hand it to them as `stop`, and call `request()` from
    another thread or from a progress function."""

    def __init__(self):
        self._stop = _c.turnwright_stop_new()
        if not self._stop:
            raise InternalError("no memory")

    def __del__(self, free=_c.turnwright_stop_free):  # bound: used while Python ends, too
        free(self._stop)

    def request(self):
        """Ends every call that was given this stop, and those that will be."""
        _c.turnwright_stop_request(self._stop)


class Handle:
    """An open catalogue."""

    def __init__(self, folder):
        self._catalogue, problem = c_void_p(), c_void_p()
        status = _c.turnwright_open(None if folder is None else str(folder).encode(),
                                    byref(self._catalogue), byref(problem))
        if status != _OK:
            _checked(status, _taken(problem))
        self.folder = Path(_c.turnwright_folder(self._catalogue).decode())

    def __del__(self, close=_c.turnwright_close):
        close(self._catalogue)

    def answer(self, name, request, drawings, progress, stop):
        """The library's answer to a request as text; Ctrl-C ends the computation."""
        stop = stop or Stop()
        fault = []

        def tell(done, all_, _):
            try:
                progress(done, all_)
            except BaseException as error:  # raised when the library has returned
                fault.append(error)
                stop.request()

        # What has been asked is kept until the library has returned.
        options = _Options(ctypes.sizeof(_Options), stop._stop,
                           _Progress(tell) if progress else _Progress(), None, drawings)
        answer = c_void_p()
        status = _interruptible(
            lambda: _c.turnwright_answer(self._catalogue, name.encode(), request.encode(),
                                         byref(options), byref(answer)), stop)
        document = _taken(answer)
        if fault:
            raise fault[0]
        return _checked(status, document)


def _interruptible(call, stop):
    """The call's result.  The main thread waits for it, so that it hears Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        return call()
    result, returned = [], threading.Event()

    def work():
        result.append(call())
        returned.set()

    worker = threading.Thread(target=work)
    try:
        worker.start()
        returned.wait()  # not join(), which takes a thread for ended once it was interrupted
    except BaseException:
        stop.request()
        if worker.ident is not None:  # it was started
            returned.wait()
        raise
    return result[0]
