# SPDX-License-Identifier: Apache-2.0
"""Create a new package: of Python nodes, which pip can install, or of types; colcon builds both."""

from __future__ import annotations

import getpass
import re
import socket
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import escape, quoteattr

from coframe.cli.output import fail

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["BUILD_TYPES", "NewPackage", "write_package"]

BUILD_TYPES = ("ament_python", "ament_cmake")
_NAME = re.compile(r"[a-z][a-z0-9_]*", re.ASCII)


class NewPackage(NamedTuple):
    """The properties of a new package; `node_name` is the name of its first executable."""

    name: str
    node_name: str | None
    dependencies: tuple[str, ...]
    description: str
    license: str
    maintainer_name: str | None
    maintainer_email: str | None
    build_type: str = "ament_python"


def write_package(package: NewPackage, destination: Path) -> list[Path]:
    """Write the files of a package to a new folder, and end the command if that fails.

    Returns:
        The files, in the order in which they were written.
    """
    for what, name in (("package", package.name), ("node", package.node_name)):
        if name is not None and not _NAME.fullmatch(name):
            fail(f"{name!r} is not a valid {what} name", "Use lower-case letters, digits and underscores.", code=2)
    if package.node_name == package.name:
        fail("The node and the package need different names, because both become executables.", code=2)
    folder = destination / package.name
    if folder.exists():
        fail(f"Aborted! {folder} already exists.", "Choose another name, or remove the folder.")
    written = []
    try:
        for name, text in _files(package).items():
            path = folder / name
            if not name.rpartition("/")[2]:
                path.mkdir(parents=True)
                continue
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            written.append(path)
    except OSError as error:
        fail(f"cannot write {error.filename}: {error.strerror}")
    return written


def _files(package: NewPackage) -> dict[str, str]:
    """Return the contents of the files by name. A name that ends with a slash is an empty folder."""
    name = package.name
    if package.build_type == "ament_cmake":
        return {
            "package.xml": _manifest(package),
            "CMakeLists.txt": _CMAKE.format(
                name=name, find="".join(f"find_package({each} REQUIRED)\n" for each in package.dependencies)
            ),
            "msg/": "",
            "srv/": "",
            "action/": "",
        }
    files = {
        "package.xml": _manifest(package),
        "setup.py": _setup(package),
        "setup.cfg": f"[develop]\nscript_dir=$base/lib/{name}\n[install]\ninstall_scripts=$base/lib/{name}\n",
        f"resource/{name}": "",
        f"{name}/__init__.py": "",
    }
    if package.node_name:
        files[f"{name}/{package.node_name}.py"] = _NODE.format(node=package.node_name)
    return files


def _maintainer(package: NewPackage) -> tuple[str, str]:
    try:
        user = getpass.getuser()
    except (KeyError, OSError):  # a container without an entry for its user
        user = "user"
    return package.maintainer_name or user, package.maintainer_email or f"{user}@{socket.gethostname()}"


def _manifest(package: NewPackage) -> str:
    name, email = _maintainer(package)
    dependencies = "".join(f"  <depend>{escape(each)}</depend>\n" for each in package.dependencies)
    return (
        '<?xml version="1.0"?>\n'
        '<package format="3">\n'
        f"  <name>{package.name}</name>\n"
        "  <version>0.0.0</version>\n"
        f"  <description>{escape(package.description)}</description>\n"
        f"  <maintainer email={quoteattr(email)}>{escape(name)}</maintainer>\n"
        f"  <license>{escape(package.license)}</license>\n\n"
        f"{_TYPES_MANIFEST if package.build_type == 'ament_cmake' else ''}"
        f"{dependencies}"
        "  <export>\n"
        f"    <build_type>{package.build_type}</build_type>\n"
        "  </export>\n"
        "</package>\n"
    )


def _setup(package: NewPackage) -> str:
    name, email = _maintainer(package)
    script = (
        f"\n            '{package.node_name} = {package.name}.{package.node_name}:main',\n        "
        if package.node_name
        else ""
    )
    return (
        "from setuptools import find_packages, setup\n\n"
        f"package_name = '{package.name}'\n\n"
        "setup(\n"
        "    name=package_name,\n"
        "    version='0.0.0',\n"
        "    packages=find_packages(exclude=['test']),\n"
        "    data_files=[\n"
        "        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),\n"
        "        ('share/' + package_name, ['package.xml']),\n"
        "    ],\n"
        "    install_requires=['setuptools'],\n"
        "    zip_safe=True,\n"
        f"    maintainer={name!r},\n"
        f"    maintainer_email={email!r},\n"
        f"    description={package.description!r},\n"
        f"    license={package.license!r},\n"
        "    entry_points={\n"
        f"        'console_scripts': [{script}],\n"
        "    },\n"
        ")\n"
    )


_TYPES_MANIFEST = (
    "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
    "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n"
    "  <exec_depend>rosidl_default_runtime</exec_depend>\n"
    "  <member_of_group>rosidl_interface_packages</member_of_group>\n\n"
)
# colcon needs the list of the files; coframe uses all files in the folders.
_CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project({name})

find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{find}
file(GLOB INTERFACES RELATIVE ${{CMAKE_CURRENT_SOURCE_DIR}} msg/*.msg srv/*.srv action/*.action)
if(INTERFACES)
  rosidl_generate_interfaces(${{PROJECT_NAME}} ${{INTERFACES}})
endif()

ament_package()
"""
_NODE = '''\
import rclpy
from rclpy.node import Node


class FirstNode(Node):
    """Logs a greeting every second."""

    def __init__(self):
        super().__init__('{node}')
        self.create_timer(1.0, self.greet)

    def greet(self):
        self.get_logger().info('Hello from {node}')


def main():
    rclpy.init()
    node = FirstNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
'''
