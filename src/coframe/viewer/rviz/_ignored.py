# SPDX-License-Identifier: Apache-2.0
"""The parts of an RViz configuration that have no effect in the viewer: options, tools and panels, by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.viewer.protocol.server_messages import IgnoredRvizPart
from coframe.viewer.rviz._defaults import DISPLAY_DEFAULTS, VIEW_DEFAULTS, differs_from_default
from coframe.viewer.rviz._tools import TOOL_CLASSES
from coframe.viewer.rviz._values import OWN_KEYS, TOPIC_KEYS, iterate_leaves, plain_class

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["ignored_options", "ignored_panels", "ignored_tools", "ignored_view_options"]

# What the page or the server reads without a row of options; the first part of a path decides.
_KEYS_READ_ELSEWHERE = frozenset(
    {*OWN_KEYS, *TOPIC_KEYS, "Value", "Namespaces", "Frames", "Frame Timeout", "Visibility"}
)
# How RViz shows its own tree and receives messages, which has no equivalent here.
_KEYS_WITHOUT_EFFECT = frozenset(
    {
        "Tree",
        "Expand Joint Details",
        "Expand Link Details",
        "Expand Tree",
        "Link Tree Style",
        "Links in Alphabetic Order",
    }
    | {"Queue Size", "Unreliable", "Transport Hint", "Selectable", "QoS", "Filter size", "Show Joints", "Expand Joint"}
)
# A subscription of the viewer keeps as many messages as the depth says.
_LIMITED_HISTORIES = ("Keep Last", "System Default")
_VIEW_KEYS_READ = {
    "Orbit": {"Distance", "Focal Point", "Pitch", "Yaw"},
    "XYOrbit": {"Distance", "Focal Point", "Pitch", "Yaw"},
    "ThirdPersonFollower": {"Distance", "Focal Point", "Pitch", "Yaw"},
    "FPS": {"Position", "Pitch", "Yaw", "Roll"},
    "FrameAligned": {"Position", "Pitch", "Yaw", "Roll", "Point towards", "Lock Camera"},
    "TopDownOrtho": {"Angle", "Scale", "X", "Y"},
}
_VIEW_KEYS_OF_ALL = frozenset(
    {"Class", "Name", "Value", "Target Frame", "Field of View", "Focal Shape Fixed Size", "Focal Shape Size"}
)
# Tools without an effect of their own: their functions belong to the mouse and the keyboard, or exist here, too.
_KNOWN_TOOLS = TOOL_CLASSES | {"FocusCamera", "Interact", "Measure", "MoveCamera", "Select"}
_KNOWN_PANELS = frozenset({"Displays", "Help", "Selection", "Time", "Tool Properties", "Transformation", "Views"})
MAX_VALUE_LENGTH = 60


def ignored_options(
    path: str, name: str, keys: frozenset[str], options: Mapping[str, Any]
) -> Iterator[IgnoredRvizPart]:
    """Yield the options of a display that have no effect here, unless they have RViz's defaults.

    Args:
        path: The display with its groups.
        name: Its class without the package.
        keys: The keys of the options that it has here.
        options: Its options.
    """
    known = keys | {key.removesuffix("/Value") for key in keys}
    defaults = DISPLAY_DEFAULTS.get(name, {})
    for key, value in iterate_leaves(options):
        first = key.partition("/")[0]
        if key == "Topic/History Policy" and value not in _LIMITED_HISTORIES:
            yield _part(path, key, value)
        if key in known or first in _KEYS_READ_ELSEWHERE or first in _KEYS_WITHOUT_EFFECT:
            continue
        if first == "Links" and not _link_differs(key, value):
            continue
        if differs_from_default(defaults, key, value):
            yield _part(path, key, value)


def ignored_view_options(view: Mapping[str, Any]) -> Iterator[IgnoredRvizPart]:
    """Yield the options of a view that have no effect here, unless they have RViz's defaults."""
    name = plain_class(view.get("Class"))
    known = _VIEW_KEYS_READ.get(name)
    if known is None:
        return  # The whole view is reported.
    for key, value in iterate_leaves(view):
        first = key.partition("/")[0]
        if first in known or first in _VIEW_KEYS_OF_ALL or key == "Enable Stereo Rendering/Value":
            continue
        if differs_from_default(VIEW_DEFAULTS[name], key, value):
            yield _part("Views/Current", key, value)


def ignored_tools(manager: Mapping[str, Any]) -> Iterator[IgnoredRvizPart]:
    """Yield the tools that the viewer does not have."""
    yield from _unknown_classes("Tools", manager.get("Tools"), _KNOWN_TOOLS)


def ignored_panels(document: Mapping[str, Any]) -> Iterator[IgnoredRvizPart]:
    """Yield the panels that the viewer does not have."""
    yield from _unknown_classes("Panels", document.get("Panels"), _KNOWN_PANELS)


def _unknown_classes(path: str, parts: Any, known: frozenset[str]) -> Iterator[IgnoredRvizPart]:
    for part in parts if isinstance(parts, list) else ():
        if isinstance(part, dict) and plain_class(part.get("Class")) not in known:
            name = str(part.get("Name") or plain_class(part.get("Class")))
            yield _part(path, name, str(part.get("Class") or ""))


def _link_differs(key: str, value: Any) -> bool:
    """Return whether an option of a single link differs from RViz's default."""
    option = key.rpartition("/")[2]
    defaults = {"Alpha": 1, "Show Axes": False, "Show Trail": False, "Value": True, "All Links Enabled": True}
    return option in defaults and differs_from_default(defaults, option, value)


def _part(path: str, name: str, value: Any) -> IgnoredRvizPart:
    text = str(value)
    text = text if len(text) <= MAX_VALUE_LENGTH else f"{text[:MAX_VALUE_LENGTH]}…"
    return IgnoredRvizPart(path=path, name=name, value=text)
