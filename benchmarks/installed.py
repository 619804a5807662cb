# SPDX-License-Identifier: Apache-2.0
"""Virtual environments with coframe as its wheel installs it, and without it, made from this checkout."""

import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import NamedTuple

from coframe import _core

ROOT = Path(__file__).parents[1]


class Environment(NamedTuple):
    """A virtual environment: its interpreter, and the folder of its packages."""

    python: Path
    packages: Path


def create(folder: Path, *, with_coframe: bool) -> Environment:
    """Create an environment in a folder.

    It also finds the packages of this process, such as NumPy, but none of their .pth files is run.
    """
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    code = "import sysconfig; print(sysconfig.get_path('purelib'))"
    packages = Path(subprocess.check_output([python, "-I", "-c", code], text=True).strip())
    (packages / "others.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    if with_coframe:
        _install(packages)
    return Environment(python, packages)


def _install(packages: Path) -> None:
    target = packages / "coframe"
    shutil.copytree(ROOT / "src/coframe", target, ignore=shutil.ignore_patterns("__pycache__", "static"))
    shutil.copytree(ROOT / "src/ros", target / "ros", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(_core.__file__, target)
    template = (ROOT / "src/coframe_ros.pth.in").read_text(encoding="utf-8")
    (packages / "coframe_ros.pth").write_text(template.replace("@ROS_PATH@", "coframe/ros"), encoding="utf-8")
