# SPDX-License-Identifier: Apache-2.0
"""Type definitions as text, with the fields of nested types below each field."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.cli.output import fail
from coframe.cli.ros2.near_names import similar_types_hint

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.interfaces.definition_files import Definition

__all__ = ["definition_lines", "origin_lines"]

# A field: the type without array bounds, and the name. A constant has "=" after its name.
_FIELD = re.compile(
    r"\s*(?P<type>[A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z]\w*\s*(?!\s*=)(?:[^=].*)?", re.ASCII
)
_PRIMITIVE_TYPE = re.compile(r"bool|byte|char|u?int(8|16|32|64)|float(32|64)|w?string|time|duration", re.ASCII)
_MAX_LEVELS = 16
_KINDS = ("msg", "srv", "action")


def definition_lines(name: str, *, comments: bool, nested_comments: bool, level: int = 0) -> Iterator[str]:
    """Yield the lines of a definition; fields of nested types follow their field, indented by tabs.

    Args:
        name: Name of a type, e.g. "geometry_msgs/msg/Pose"; "msg" may be omitted.
        comments: Whether to show the comments of this type.
        nested_comments: Whether to also show the comments of nested types.
        level: The nesting depth of this type.
    """
    package, kind, base = _parts(name)
    for line in _definition(package, kind, base).text.splitlines():
        shown = line.rstrip() if comments else line.partition("#")[0].rstrip()
        if shown or comments:
            yield "\t" * level + shown
        field = _FIELD.fullmatch(line.partition("#")[0].rstrip())
        if field is None or _PRIMITIVE_TYPE.fullmatch(field["type"]) or level == _MAX_LEVELS:
            continue
        nested = "std_msgs/Header" if field["type"] == "Header" else field["type"]
        yield from definition_lines(
            nested if "/" in nested else f"{package}/msg/{nested}",
            comments=comments and nested_comments,
            nested_comments=nested_comments,
            level=level + 1,
        )


def origin_lines(name: str) -> Iterator[str]:
    """Yield the file of a definition and its type hash, as comments.

    Args:
        name: Name of a type, as for :func:`definition_lines`.
    """
    from coframe.messages.registry import find  # noqa: PLC0415 - slow import
    from coframe.messages.type_hash import type_hash  # noqa: PLC0415

    full_name = "/".join(_parts(name))
    yield f"# {full_name}, {_definition(*_parts(name)).file or 'contained in coframe'}"
    yield f"# {type_hash(find(full_name))}"


def _parts(name: str) -> tuple[str, str, str]:
    parts = name.split("/")
    if len(parts) == 2:
        parts.insert(1, "msg")
    if len(parts) != 3 or parts[1] not in _KINDS or not all(parts):
        examples = "Examples: geometry_msgs/msg/Pose, std_srvs/srv/SetBool"
        fail(f"{name!r} is not a type name.", similar_types_hint(name) or examples, code=2)
    return parts[0], parts[1], parts[2]


def _definition(package: str, kind: str, name: str) -> Definition:
    """Return a definition: of coframe or of the user's packages, or from the file of a sourced ROS."""
    from coframe.interfaces.definition_files import read  # noqa: PLC0415 - slow import
    from coframe.messages.packages import find_package  # noqa: PLC0415
    from rosidl_runtime_py import get_interface_path  # noqa: PLC0415

    found = find_package(package)
    if found is not None and name in found.names(kind):
        return found.definition(kind, name)
    try:
        path = Path(get_interface_path(f"{package}/{kind}/{name}"))
    except (LookupError, OSError):
        if found is None:
            fail(f"Unknown package '{package}'", "coframe interface packages shows all packages with types.")
        full_name = f"{package}/{kind}/{name}"
        fail(
            f"Unknown type '{full_name}'",
            similar_types_hint(full_name) or f"coframe interface package {package} shows its types.",
        )
    return read(path)
