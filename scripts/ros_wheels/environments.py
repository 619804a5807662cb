# SPDX-License-Identifier: Apache-2.0
"""Create environments of ROS 2 from wheels: its rclpy, message classes and Fast DDS, without an installation of ROS.

There are no wheels of tf2_msgs and example_interfaces: ROS's own generators make them here from their definitions. The
tf2_ros of the environment is tests/course/tf2_on_rclpy, and its tf2_geometry_msgs is a copy of coframe's.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parents[2]

_PACKAGES = (
    *("rclpy", "rmw-fastrtps-cpp", "geometry-msgs", "sensor-msgs", "std-msgs", "nav-msgs", "visualization-msgs"),
    *("std-srvs", "diagnostic-msgs", "shape-msgs", "stereo-msgs", "trajectory-msgs"),
)
# What CMake needs to generate and compile an interface package; the wheels do not require each other for that.
_AMENT_CMAKE = (
    *("core", "export-definitions", "export-dependencies", "export-include-directories", "export-interfaces"),
    *("export-libraries", "export-link-flags", "export-targets", "gen-version-h", "include-directories", "libraries"),
    *("python", "target-dependencies", "test", "version", "ros", "gmock", "gtest", "pytest"),
)
_GENERATORS = (
    *("ament-cmake", *(f"ament-cmake-{part}" for part in _AMENT_CMAKE), "ament-package", "python-cmake-module"),
    *("rosidl-core-generators", "rosidl-default-generators", "gmock-vendor", "gtest-vendor", "domain-coordinator"),
)
_TOOLS = ("catkin_pkg", "cmake", "ninja", "numpy", "PyYAML", "pytest", "pytest-timeout")

# The interfaces to generate: those that programs here use, with the packages that they need.
_GENERATED = {
    "tf2_msgs": (
        ("msg/TFMessage.msg", "msg/TF2Error.msg", "srv/FrameGraph.srv", "action/LookupTransform.action"),
        ("action_msgs", "builtin_interfaces", "geometry_msgs"),
    ),
    "example_interfaces": (("srv/AddTwoInts.srv", "action/Fibonacci.action"), ("action_msgs",)),
}

_CMAKE = """\
cmake_minimum_required(VERSION 3.20)
project({name})
find_package(ament_cmake REQUIRED)
{find}
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${{PROJECT_NAME}} {files} DEPENDENCIES {dependencies})
ament_package()
"""

_PACKAGE_XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name><version>0.0.0</version><description>Interfaces</description>
  <maintainer email="interfaces@example.org">interfaces</maintainer><license>BSD</license>
  <buildtool_depend>ament_cmake</buildtool_depend><buildtool_depend>rosidl_default_generators</buildtool_depend>
  {depends}<exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


class Distro(NamedTuple):
    """A distribution of ROS 2 of which there are wheels.

    Attributes:
        name: Its name in ROS_DISTRO.
        prefix: What the names of its wheels start with.
        more: Packages that only this distribution has.
    """

    name: str
    prefix: str
    more: tuple[str, ...]

    @property
    def wheels(self) -> list[str]:
        """The distributions to install with pip."""
        return [f"{self.prefix}{package}" for package in (*_PACKAGES, *_GENERATORS, *self.more)]


DISTROS = {
    distro.name: distro
    for distro in (Distro("jazzy", "ros-jazzy-", ()), Distro("kilted", "ros-", ("ament-cmake-ros-core",)))
}


class Environment:
    """A virtual environment with the rclpy of a distribution.

    Args:
        distro: The distribution.
        folder: The folder that contains all environments.

    Attributes:
        distro: The distribution.
        folder: The folder of this environment.
        python: Its interpreter.
    """

    def __init__(self, distro: Distro, folder: Path) -> None:
        self.distro = distro
        self.folder = folder.resolve() / distro.name
        self._venv = self.folder / "venv"
        self.python = self._venv / "bin" / "python"

    @property
    def is_complete(self) -> bool:
        """Whether `create` has finished."""
        return all((self.folder / f".{step}").exists() for step in ("wheels", *_GENERATED))

    def variables(self) -> dict[str, str]:
        """Return the environment variables of a shell where this ROS is sourced, and no other one."""
        paths = [self.folder / "packages", ROOT / "tests/course/tf2_on_rclpy"]
        libraries = self._venv / "lib"
        return {
            **{name: text for name, text in os.environ.items() if not name.startswith(("ROS_", "RMW_", "COFRAME_"))},
            "AMENT_PREFIX_PATH": str(self._venv),
            "LD_LIBRARY_PATH": str(libraries),
            "PATH": os.pathsep.join((str(self.python.parent), os.environ.get("PATH", ""))),
            "PYTHONPATH": os.pathsep.join(map(str, paths)),
            "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_DISTRO": self.distro.name,
            # The wheels would start Python a second time to set the path of their libraries.
            "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
        }

    def create(self) -> None:
        """Create what is missing; the first time takes some minutes."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self._once("wheels", self._install_wheels)
        for package in _GENERATED:
            self._once(package, self._generate, package)
        packages = self.folder / "packages"
        shutil.rmtree(packages, ignore_errors=True)
        shutil.copytree(ROOT / "src/ros/tf2_geometry_msgs", packages / "tf2_geometry_msgs")
        module = packages / "tf2_geometry_msgs" / "__init__.py"
        check = re.compile(r"^(from coframe import ros_side|ros_side\.check.*)\n", re.MULTILINE)
        module.write_text(check.sub("", module.read_text()))

    def install(self, wheel: Path) -> None:
        """Install coframe from a wheel, with what its extras need."""
        self._pip("--force-reinstall", "--no-deps", str(wheel))
        self._pip("coframe[all]")

    def _once(self, step: str, action: Callable[..., None], *arguments: str) -> None:
        done = self.folder / f".{step}"
        if not done.exists():
            print(f"{self.distro.name}: {step}", flush=True)
            action(*arguments)
            done.touch()

    def _install_wheels(self) -> None:
        subprocess.run([sys.executable, "-m", "venv", str(self._venv)], check=True)
        self._pip(*self.distro.wheels, *_TOOLS)
        libraries = self._venv / "lib"
        for library in libraries.glob("python3.*/site-packages/ros_*.libs/*"):
            if not (link := libraries / library.name).is_symlink():
                link.symlink_to(library)
        # The files of the wheels name the headers of the machine that built them.
        headers = sysconfig.get_path("include")
        print_numpy = "import numpy; print(numpy.get_include())"
        numpy = subprocess.run([self.python, "-c", print_numpy], check=True, capture_output=True, text=True).stdout
        for file in self._venv.glob("share/*/cmake/*.cmake"):
            text = file.read_text()
            changed = re.sub(r"/opt/python/[^;\" ]*numpy/_?core/include", numpy.strip(), text)
            changed = re.sub(r"/opt/python/cp\d+-cp\d+/include/python3\.\d+", headers, changed)
            if changed != text:
                file.write_text(changed)

    def _generate(self, name: str) -> None:
        files, dependencies = _GENERATED[name]
        source, build = self.folder / name, self.folder / f"build_{name}"
        for folder in (source, build):
            shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(ROOT / "interfaces" / name, source)
        find = "\n".join(f"find_package({package} REQUIRED)" for package in dependencies)
        listed = " ".join(f'"{file}"' for file in files)
        cmake = _CMAKE.format(name=name, find=find, files=listed, dependencies=" ".join(dependencies))
        (source / "CMakeLists.txt").write_text(cmake)
        depends = "".join(f"<depend>{package}</depend>" for package in dependencies)
        (source / "package.xml").write_text(_PACKAGE_XML.format(name=name, depends=depends))
        places = [f"-DCMAKE_PREFIX_PATH={self._venv}", f"-DCMAKE_INSTALL_PREFIX={self._venv}"]
        self._cmake("-S", source, "-B", build, "-G", "Ninja", *places, f"-DPython3_EXECUTABLE={self.python}")
        self._cmake("--build", build)
        self._cmake("--install", build)

    def _cmake(self, *words: object) -> None:
        command = [str(self.python.parent / "cmake"), *map(str, words)]
        done = subprocess.run(command, env=self.variables(), capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")

    def _pip(self, *words: str) -> None:
        subprocess.run([self.python, "-m", "pip", "install", "--quiet", *words], check=True)
