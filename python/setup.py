"""Makes the wheel: the Python files, the C library, the data and the types of documents.

The library comes from the CMake build folder that TURNWRIGHT_BUILD names, as it is; otherwise
from build/release beside this folder, which is built first.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import document_types  # noqa: E402


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


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        package = Path(self.build_lib).resolve() / "turnwright"
        subprocess.run(["cmake", "--install", BUILD, "--component", "python",
                        "--prefix", package], check=True, stdout=subprocess.DEVNULL)
        document_types.write(package)


class PlatformWheel(bdist_wheel):
    """For any Python 3 of this platform: the library knows nothing of Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


BUILD = built()
setup(version=version(BUILD),
      cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
