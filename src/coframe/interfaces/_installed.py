# SPDX-License-Identifier: Apache-2.0
"""Interface packages of installed distributions, which name them by entry points of the group ``coframe.messages``.

The name of an entry point is the name of the ROS package. Its value is the Python package whose folder contains
``msg``, ``srv`` or ``action``::

    [project.entry-points."coframe.messages"]
    acme_msgs = "acme_msgs"

This reads the folder and imports nothing.
"""

from __future__ import annotations

import sys
from importlib.machinery import PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._process.plugins import plugins
from coframe.interfaces.definition_files import PACKAGE_NAME, has_definitions
from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from coframe._process.plugins import Plugin

__all__ = ["GROUP", "InstalledPackage", "installed_packages"]

GROUP = "coframe.messages"


class InstalledPackage(NamedTuple):
    """An interface package of a distribution.

    Attributes:
        name: The name of the package, such as ``geometry_msgs``.
        folder: The folder with its definitions.
        distribution: The distribution, as ``pip`` names it.
    """

    name: str
    folder: Path
    distribution: str


def installed_packages() -> list[InstalledPackage]:
    """Return the packages of all distributions; packages without definitions are reported once."""
    found = []
    for plugin in plugins(GROUP):
        if not PACKAGE_NAME.fullmatch(plugin.name):
            report(str(plugin.error("does not have the name of a ROS package, such as 'acme_msgs'")))
            continue
        folder = _folder(plugin)
        if folder is None:
            report(str(plugin.error(f"names no folder with .msg, .srv, .action or .idl files: {plugin.target}")))
        else:
            found.append(InstalledPackage(plugin.name, folder, plugin.package))
    return found


def _folder(plugin: Plugin) -> Path | None:
    """Return the folder of a Python package, without importing it, or None if it has no definitions."""
    top, *inner = plugin.target.partition(":")[0].split(".")
    folders = [Path(folder, top) for folder in filter(None, sys.path)]
    if inner and not any((folder / Path(*inner)).is_dir() for folder in folders):
        # An editable installation has a finder for its package. The ROS package itself is excluded, because during
        # its import this search runs.
        spec = None if top == plugin.name else PathFinder.find_spec(top)
        folders = [Path(folder) for folder in (spec.submodule_search_locations or ())] if spec else []
    return next((path for folder in folders if has_definitions(path := folder.joinpath(*inner))), None)
