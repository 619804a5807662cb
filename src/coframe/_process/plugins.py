# SPDX-License-Identifier: Apache-2.0
"""Plug-ins: objects that other distributions add to coframe through entry points.

A distribution declares its objects in its ``pyproject.toml``; users only have to install it::

    [project.entry-points."coframe.commands"]
    hello = "robot_tools.hello:hello"

:func:`plugins` lists the entry points of a group and imports none of them. A plug-in that cannot be loaded raises
:class:`PluginError`, whose text is one sentence that names the entry point and its package.

The folders of ``sys.path`` are read here: importing ``importlib.metadata`` takes 30 ms, a third of the start of a
command, because it parses metadata with the packages ``email`` and ``zipfile``. Distributions inside zip files are
therefore not found.
"""

from __future__ import annotations

import functools
import importlib
import os
import re
import sys
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from coframe._base_error import CoframeError
from coframe._files.regular_files import read_regular_text
from coframe._output.escaping import one_line

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["Plugin", "PluginError", "load_plugins", "plugins"]

MAX_BYTES: Final = 1 << 20  # of a file with entry points
# Python compiles the patterns when they are used: most programs have no plug-ins.
_METADATA: Final = r"(.+?)(?:-[^-]+)?(?:-py[\d.]+)?\.(?:dist-info|egg-info)"
_SECTION_LINE: Final = r"\[(.+)\]"
_ENTRY_LINE: Final = r"([^=#;\[]+?)\s*=\s*([\w.]+(?::[\w.]+)?)\s*(?:\[.*\])?"


class PluginError(CoframeError, RuntimeError):
    """A plug-in cannot be loaded, or is not of the kind that its group expects."""

    def __init__(self, text: str, *, hint: str = "") -> None:
        super().__init__(text)
        self._hint = hint


class Plugin(NamedTuple):
    """An entry point of an installed distribution.

    Attributes:
        group: The group, such as ``coframe.commands``.
        name: The name within the group.
        target: The object to load: ``package.module:object``, or a module.
        package: The distribution, with the name that ``pip`` accepts.
    """

    group: str
    name: str
    target: str
    package: str

    def load(self) -> Any:
        """Import the object.

        Raises:
            PluginError: Its module cannot be imported, ends the program, or has no such object.
        """
        module, _, names = self.target.partition(":")
        try:
            loaded: Any = importlib.import_module(module)
            for name in filter(None, names.split(".")):
                loaded = getattr(loaded, name)
        except (Exception, SystemExit) as error:
            raise self.error(f"cannot be loaded: {type(error).__name__}: {error}") from error
        return loaded

    def error(self, problem: str) -> PluginError:
        """Return an exception about this plug-in.

        Args:
            problem: The rest of a sentence whose subject is the plug-in, such as ``"is not a function"``.
        """
        subject = f"The entry point {self.name!r} ({self.group}) of the package {self.package}"
        return PluginError(
            one_line(f"{subject} {problem.rstrip('.')}."),
            hint=f"Update the package, or uninstall it: pip uninstall {self.package}",
        )


def plugins(group: str) -> list[Plugin]:
    """Return the entry points of a group in the order of ``sys.path``; for duplicate names, only the first one.

    Args:
        group: The group, such as ``coframe.commands``.
    """
    found: dict[str, Plugin] = {}
    packages: set[str] = set()
    for folder in filter(None, sys.path):  # never the current folder
        here = _entry_points(folder, _modification_time(folder))
        for plugin in here:
            # A distribution in an earlier folder replaces the one with the same name in a later folder.
            if plugin.group == group and plugin.package not in packages:
                found.setdefault(plugin.name, plugin)
        packages.update(plugin.package for plugin in here)
    return list(found.values())


def load_plugins(group: str, report: Callable[[str], None]) -> Iterator[tuple[Plugin, Any]]:
    """Load the entry points of a group, each with its object. Failing ones are reported and skipped.

    Args:
        group: The group, such as ``coframe.commands``.
        report: Receives one sentence about each plug-in that cannot be loaded.
    """
    for plugin in plugins(group):
        try:
            loaded = plugin.load()
        except PluginError as error:
            report(str(error))
        else:
            yield plugin, loaded


def _modification_time(folder: str) -> int:
    try:
        return os.stat(folder).st_mtime_ns  # noqa: PTH116 - entries of sys.path are texts
    except (OSError, ValueError):
        return 0


@functools.lru_cache(maxsize=256)
def _entry_points(folder: str, _modification_time: int) -> tuple[Plugin, ...]:
    """Return all entry points in a folder of ``sys.path``. They are read again when the folder changes."""
    try:
        names = sorted(os.listdir(folder))  # noqa: PTH208 - as above
    except (OSError, ValueError):
        return ()
    found: list[Plugin] = []
    for name in names:
        if metadata := re.fullmatch(_METADATA, name):
            package = re.sub(r"[-_.]+", "-", metadata[1]).lower()
            found += _parse_entry_points(os.path.join(folder, name, "entry_points.txt"), package)  # noqa: PTH118
    return tuple(found)


def _parse_entry_points(path: str, package: str) -> Iterator[Plugin]:
    """Yield the entry points of a file. Lines in another format are skipped."""
    try:
        text = read_regular_text(path, MAX_BYTES)
    except (OSError, ValueError):  # Most distributions have none.
        return
    group = ""
    for line in map(str.strip, text.splitlines()):
        if section := re.fullmatch(_SECTION_LINE, line):
            group = section[1].strip()
        elif (entry := re.fullmatch(_ENTRY_LINE, line)) and entry[1].isprintable():
            yield Plugin(group, entry[1], entry[2], package)
