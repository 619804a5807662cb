# SPDX-License-Identifier: Apache-2.0
"""The names of topics in .rviz files and in requests, resolved as in RViz: "scan" is /scan, "~/scan" a private name."""

from __future__ import annotations

import re
from typing import NamedTuple

from coframe.errors import ViewerError

__all__ = ["VIEWER_NODE", "NodeName", "resolve_topic", "resolved_topic"]

_PART_PATTERN = r"[A-Za-z_][A-Za-z0-9_]*"
_FULL_NAME_PATTERN = re.compile(rf"(/{_PART_PATTERN})+", re.ASCII)
_SUBSTITUTION_PATTERN = re.compile(r"\{([^{}]*)\}")
_MAX_SHOWN = 80  # characters of a name in an error message


class NodeName(NamedTuple):
    """The node relative to which names of topics are resolved.

    Attributes:
        namespace: The namespace, such as "/" or "/robot1".
        name: The name in this namespace.
    """

    namespace: str
    name: str


VIEWER_NODE = NodeName("/", "coframe_view")
"""The node of a viewer without a ROS graph."""


def resolve_topic(name: str, node: NodeName = VIEWER_NODE) -> str:
    """Return the full name of a topic.

    Args:
        name: A name as in ROS 2: absolute, relative to the namespace, private with a tilde, with substitutions
            such as "{ns}".
        node: The node that uses the name.

    Raises:
        ViewerError: The name is not a valid name of a topic.

    Example:
        >>> resolve_topic("scan"), resolve_topic("~/scan"), resolve_topic("{ns}/scan", NodeName("/robot1", "view"))
        ('/scan', '/coframe_view/scan', '/robot1/scan')
    """
    namespace = node.namespace.rstrip("/")
    values = {"ns": namespace, "namespace": namespace, "node": node.name}
    full = _SUBSTITUTION_PATTERN.sub(lambda found: values.get(found[1], found[0]), name)
    if full == "~" or full.startswith("~/"):
        full = f"{namespace}/{node.name}{full[1:]}"
    elif not full.startswith("/"):
        full = f"{namespace}/{full}"
    if not _FULL_NAME_PATTERN.fullmatch(full):
        shown = name if len(name) <= _MAX_SHOWN else f"{name[:_MAX_SHOWN]}…"
        raise ViewerError(
            f"{shown!r} is not a valid topic name",
            hint="Names consist of letters, digits and underscores, separated by slashes; no part begins with a digit.",
        )
    return full


def resolved_topic(name: str, node: NodeName = VIEWER_NODE) -> str:
    """Return the full name of a topic, or the name itself if it is not valid; see :func:`resolve_topic`."""
    try:
        return resolve_topic(name, node)
    except ViewerError:
        return name
