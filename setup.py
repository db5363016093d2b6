"""The wheel: CMake builds the module, as it does for the rest of the project.

    pip wheel . --no-deps                        # with setuptools from the network
    pip wheel . --no-deps --no-build-isolation   # with those of the system

The packages of `scripts/install-packages build python` have to be there.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()


class CMakeBuild(build_ext):
    """Builds and installs the component `python` in place of an extension. MERGE2D_BUILD names a
    build tree that has it already, for the same Python."""

    def build_extension(self, ext):
        ready = os.environ.get("MERGE2D_BUILD")
        work = pathlib.Path(ready or pathlib.Path(self.build_temp) / "cmake").resolve()
        if not ready:
            self.build(work)
        prefix = pathlib.Path(self.build_temp).resolve() / "prefix"
        subprocess.run(["cmake", "--install", str(work), "--component", "python", "--prefix",
                        str(prefix), "--strip"], check=True)
        (package,) = prefix.glob("**/merge2d")
        shutil.copytree(package, pathlib.Path(self.build_lib).resolve() / "merge2d",
                        dirs_exist_ok=True)

    def build(self, work):
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(work), "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=20",
                        "-DMERGE2D_TESTS=OFF", "-DMERGE2D_PYTHON=ON",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", str(work), "--target", "merge2d_python", "-j",
                        str(os.cpu_count() or 1)], check=True)


VERSION = re.search(r"project\(merge2d VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
setup(version=VERSION, packages=[], ext_modules=[Extension("merge2d._merge2d", [])],
      cmdclass={"build_ext": CMakeBuild})
