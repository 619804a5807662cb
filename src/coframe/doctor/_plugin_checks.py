# SPDX-License-Identifier: Apache-2.0
"""Checks that other distributions add, as entry points of the group ``coframe.checks``.

An entry point is a module like those of `coframe.doctor.checks`, with its page::

    [project.entry-points."coframe.checks"]
    battery = "acme_checks.battery"
"""

from __future__ import annotations

import functools
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._process.plugins import Plugin, load_plugins
from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["GROUP", "PluginCheck", "plugin_checks"]

GROUP = "coframe.checks"
_CODE = re.compile(r"(?!TF\d)[A-Z]{2,10}\d{3}")


class PluginCheck(NamedTuple):
    """A check of another distribution.

    Attributes:
        code: Its code, such as ``ACME001``.
        find: Yields findings for an observation.
        page: Its page in Markdown.
        plugin: The entry point.
    """

    code: str
    find: Callable[[Any], Any]
    page: str
    plugin: Plugin


@functools.cache
def plugin_checks() -> dict[str, PluginCheck]:
    """Return the checks of other distributions by code; unusable ones are reported once."""
    found: dict[str, PluginCheck] = {}
    for plugin, module in load_plugins(GROUP, report):
        values: list[Any] = [getattr(module, name, None) for name in ("CODE", "find", "PAGE")]
        code, find, page = values
        problem = _problem(code, find, page)
        if not problem and code in found:
            problem = f"has the code {code}, which {found[code].plugin.package} already uses"
        if problem:
            report(str(plugin.error(problem)))
        else:
            found[code] = PluginCheck(code, find, page, plugin)
    return dict(sorted(found.items()))


def _problem(code: Any, find: Any, page: Any) -> str:
    """Return why a module is not a valid check, as the rest of a sentence, or "" if it is valid."""
    if not isinstance(code, str) or not _CODE.fullmatch(code):
        return f"has no CODE such as 'ACME001', with other letters than TF, but {code!r}"
    if not callable(find):
        return "has no function find(observation)"
    if not isinstance(page, str) or not page.startswith(f"# {code}: "):
        return f"has no PAGE that begins with '# {code}: ' and its title"
    return ""
