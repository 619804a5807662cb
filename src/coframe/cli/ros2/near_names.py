# SPDX-License-Identifier: Apache-2.0
"""Suggest types with names similar to a nonexistent one."""

from __future__ import annotations

import difflib

from coframe._output.formatting import did_you_mean

__all__ = ["similar_types_hint"]

_KINDS = ("msg", "srv", "action")
_MAX_NAMES = 3


def similar_types_hint(name: str) -> str:
    """Return "Did you mean ...?" for a nonexistent type, even if parts of its name are missing.

    Args:
        name: What the user wrote, e.g. "std_msgs/String" or "TransformStamped".
    """
    from coframe.messages.packages import find_package, find_shipped, shipped_names  # noqa: PLC0415 - slow import

    package, _, last = name.rpartition("/")
    package = package.partition("/")[0]
    found = find_package(package) if package else None
    packages = [found] if found else [each for each in map(find_shipped, shipped_names()) if each]
    types = [f"{each.name}/{kind}/{type_}" for each in packages for kind in _KINDS for type_ in each.names(kind)]
    same = [each for each in types if each.rpartition("/")[2] == last]
    if same:
        nearest = difflib.get_close_matches(name, same, n=_MAX_NAMES, cutoff=0.0)
        return f"Did you mean {' or '.join(map(repr, nearest))}?"
    # If the package was not found, types of other packages are not suggested.
    return did_you_mean(name, types, limit=2) if found else ""
