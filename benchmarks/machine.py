# SPDX-License-Identifier: Apache-2.0
"""Facts about the machine and the versions of the peers."""

import datetime
import os
import platform
import re
import shlex
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from benchmarks.measuring import MissingPeerError
from benchmarks.peers import DEBIAN_PYTHON, ROS2
from benchmarks.process import ROOT

PACKAGES = ("numpy", "transform-tree", "scipy", "pytransform3d", "rosbags", "cyclonedds")
DEBIAN_PACKAGES = ("python3-tf2", "python3-tf2-ros", "python3-tf2-sensor-msgs", "python3-pykdl")


def facts() -> dict[str, str]:
    """Return the facts that are needed to interpret the results."""
    return {
        "Date": f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC",
        "Command": f"make bench{_arguments()}",
        "Machine": f"{_cpu()}, {os.cpu_count()} cores, {platform.machine()}, {platform.system()} {platform.release()}",
        "Load": f"{os.getloadavg()[0]:.1f} on average in the last minute",
        "coframe": f"{version('coframe')}, commit {_output('git', 'describe', '--always', '--dirty')}",
        "Python": platform.python_version(),
        "Packages": ", ".join(f"{package} {_version(package)}" for package in PACKAGES),
        "Debian": f"{', '.join(_debian_packages())}; {_output(*DEBIAN_PYTHON, '--version')}",
        "ROS 2": _ros2(),
    }


def _arguments() -> str:
    return f' ARGS="{shlex.join(sys.argv[1:])}"' if sys.argv[1:] else ""


def _cpu() -> str:
    names = re.findall(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text("utf-8"), re.MULTILINE)
    return names[0].strip() if names else platform.processor()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "missing"


def _debian_packages() -> list[str]:
    return [
        f"{package} {_output('dpkg-query', '--show', '--showformat=${Version}', package)}"
        for package in DEBIAN_PACKAGES
    ]


def _ros2() -> str:
    try:
        python = ROS2.python()
    except MissingPeerError:
        return "none sourced"
    return f"{os.environ['ROS_DISTRO']}, {_output(*python, '--version')}"


def _output(*command: str) -> str:
    """Return what a command prints."""
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return "missing"
    return done.stdout.strip()
