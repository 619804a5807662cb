# SPDX-License-Identifier: Apache-2.0
"""The tools of an RViz configuration that publish, and their topics."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.viewer.rviz._values import changed_values, plain_class, set_topic, to_json, topic_of, update
from coframe.viewer.sources.topic_names import resolved_topic

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.protocol.common import RvizTool

__all__ = ["TOOL_CLASSES", "merge_tools", "read_tools"]

TOOL_CLASSES = frozenset({"PublishPoint", "SetGoal", "SetInitialPose"})
"""The publishing RViz tools that the page supports, by class name without the package."""

_OWN_KEYS = ("Class", "Topic")


def read_tools(manager: dict[str, Any]) -> list[RvizTool]:
    """Return the tools that publish."""
    return [_describe(tool) for tool in _tools(manager)]


def merge_tools(manager: dict[str, Any], tools: Sequence[RvizTool], package: str) -> None:
    """Write those topics and options of tools that differ from the file."""
    for shown in tools:
        if shown["class"] not in TOOL_CLASSES:
            continue
        tool = next((one for one in _tools(manager) if plain_class(one.get("Class")) == shown["class"]), None)
        if tool is None:
            tool = {"Class": f"{package}/{shown['class']}"}
            known = manager.get("Tools")
            manager["Tools"] = [*(known if isinstance(known, list) else []), tool]
        before = _describe(tool)
        if shown["topic"] and shown["topic"] != before["topic"]:
            set_topic(tool, shown["topic"], package)
        update(
            tool, changed_values(before["options"], {k: v for k, v in shown["options"].items() if k not in _OWN_KEYS})
        )


def _describe(tool: dict[str, Any]) -> RvizTool:
    topic = topic_of(tool)
    return {
        "class": plain_class(tool.get("Class")),
        "topic": None if topic is None else resolved_topic(topic),
        "options": {str(key): to_json(value) for key, value in tool.items() if key not in _OWN_KEYS},
    }


def _tools(manager: dict[str, Any]) -> list[dict[str, Any]]:
    tools = manager.get("Tools")
    return [
        tool
        for tool in (tools if isinstance(tools, list) else [])
        if isinstance(tool, dict) and plain_class(tool.get("Class")) in TOOL_CLASSES
    ]
