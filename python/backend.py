"""Builds the wheel (PEP 517): the Python files, the C library, the data and the types of documents.
It needs nothing but Python, CMake and the library.

The library comes from the CMake build folder that TURNWRIGHT_BUILD names, as it is; otherwise
from build/release beside this folder, which is built first.
"""
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sysconfig
import tempfile
import zipfile
from pathlib import Path

import document_types

HERE = Path(__file__).resolve().parent
METADATA = """\
Metadata-Version: 2.1
Name: turnwright
Version: {version}
Summary: Certified plans of turned parts: Turnwright's capabilities as functions of dicts
License: Apache-2.0
Requires-Python: >=3.11
Provides-Extra: numpy
Requires-Dist: numpy; extra == "numpy"
"""
# For any Python 3 of this platform: the library knows nothing of Python.
TAG = "py3-none-" + re.sub("[-.]", "_", sysconfig.get_platform())
WHEEL = f"""\
Wheel-Version: 1.0
Generator: turnwright
Root-Is-Purelib: false
Tag: {TAG}
"""


def built():
    """The CMake build folder, with the library in it."""
    if given := os.environ.get("TURNWRIGHT_BUILD"):
        return Path(given)
    subprocess.run([HERE.parent / "scripts" / "build", "turnwright_library"], check=True)
    return HERE.parent / "build" / "release"


def version(build):
    """The project's version, as CMake keeps it."""
    cache = (build / "CMakeCache.txt").read_text()
    return re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.*)$", cache, re.M)[1]


def packed(folder, wheel, record):
    """A folder as a wheel, with the digests of its files; the same bytes every time."""
    rows = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(path for path in folder.rglob("*") if path.is_file()):
            name, content = file.relative_to(folder).as_posix(), file.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")
            rows.append(f"{name},sha256={digest},{len(content)}\n")
            archive.writestr(entry(name), content)
        archive.writestr(entry(record), "".join(rows) + f"{record},,\n")


def entry(name):
    one = zipfile.ZipInfo(name)  # of 1 January 1980
    one.external_attr, one.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
    return one


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = built()
    name = f"turnwright-{version(build)}"
    with tempfile.TemporaryDirectory() as work:
        package, info = Path(work) / "turnwright", Path(work) / f"{name}.dist-info"
        shutil.copytree(HERE / "turnwright", package,
                        ignore=shutil.ignore_patterns("__pycache__"))
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", package],
                       check=True, stdout=subprocess.DEVNULL)
        document_types.write(package)
        info.mkdir()
        (info / "METADATA").write_text(METADATA.format(version=version(build)))
        (info / "WHEEL").write_text(WHEEL)
        packed(Path(work), Path(wheel_directory) / f"{name}-{TAG}.whl", f"{info.name}/RECORD")
    return f"{name}-{TAG}.whl"
