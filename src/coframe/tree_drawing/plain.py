# SPDX-License-Identifier: Apache-2.0
"""A forest as plain data, for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["as_data"]


def as_data(forest: Forest) -> dict[str, Any]:
    """Return the data that ``--json`` prints, documented in docs/how-to/tree-diagrams.md. Times are nanoseconds."""
    return {
        "live": forest.live,
        "start_ns": forest.start,
        "end_ns": forest.end,
        "trees": [{"root": root, "frames": count} for root, count in forest.trees.items()],
        "loops": sorted(forest.loops),
        "frames": [_frame(frame) for frame in forest.frames.values()],
    }


def _frame(frame: Frame) -> dict[str, Any]:
    return {
        "name": frame.name,
        "parent": frame.parent or None,
        "root": frame.root,
        "depth": frame.depth,
        "children": list(frame.children),
        "static": frame.static,
        "silent_ns": frame.silence,
        "stamps_behind_ns": frame.offset.offset if frame.offset else None,
        "edges": [edge._asdict() for edge in frame.edges],
        "other_edges": [edge._asdict() for edge in frame.other_edges],
    }
