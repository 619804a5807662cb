# SPDX-License-Identifier: Apache-2.0
"""Composable nodes in Python: the entry points of the group ``rclpy_components`` of packages."""

from __future__ import annotations

import re
from importlib.metadata import entry_points
from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.errors import PackageError
from coframe.workspace.packages import _builtin, _console_scripts
from coframe.workspace.packages.finding import candidates, find_package, package_names

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["IN_CPP", "component_types", "find_component"]

_GROUP = "rclpy_components"
_TARGET = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*", re.ASCII)
IN_CPP = "composable nodes in C++ are libraries, which need a ROS 2 installation"


def find_component(package: str, plugin: str) -> str:
    """Return ``MODULE:CLASS`` of a composable node in Python.

    Args:
        package: Name of the package.
        plugin: Name of the entry point, such as ``"demo_nodes_py::Talker"``, or ``MODULE:CLASS`` itself.

    Raises:
        PackageError: There is no such package, or it has no such node in Python.
    """
    try:
        find_package(package)
    except PackageError as error:  # Most nodes in launch files are in C++, and their packages are not here.
        raise PackageError(f"{str(error).rstrip('.')}; {IN_CPP}.", hint=error.hint) from None
    found = _components_of(package)
    if plugin in found:
        return found[plugin]
    if _TARGET.fullmatch(plugin):
        return plugin
    there = did_you_mean(plugin, found, limit=3)
    hint = f"{there} Entry points of the group {_GROUP} and MODULE:CLASS name nodes in Python.".lstrip()
    raise PackageError(f"The package {package!r} has no composable node {plugin!r} in Python; {IN_CPP}.", hint=hint)


def component_types() -> dict[str, list[str]]:
    """Return the names of all composable nodes in Python by package."""
    found = {package: sorted(_components_of(package)) for package in package_names()}
    return {package: names for package, names in found.items() if names}


def _components_of(package: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for candidate in candidates(package):
        declared: Mapping[str, str] = {}
        if candidate.origin == "builtin":
            declared = _builtin.COMPONENTS.get(package, {})
        elif candidate.origin != "installed":
            declared = _console_scripts.read(candidate.source or candidate.share).components
        found = {**declared, **found}
    for each in entry_points(group=_GROUP):
        if each.dist is not None and each.dist.name.replace("-", "_") == package.replace("-", "_"):
            found.setdefault(each.name, each.value)
    return found
