# SPDX-License-Identifier: Apache-2.0
"""The rules of `coframe bag edit` that repair problems in recordings, as strings."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

import numpy as np

from coframe.time import HOUR, MILLISECOND, SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["drop_edge", "drop_tracks", "rename_frame", "replace_mount", "set_static", "shift"]

_Edge = tuple[str, str]
_MAX_LATENCY = SECOND  # by which an offset of whole hours may be off


def rename_frame(old: str, new: str) -> str:
    """Return the rule that renames a frame."""
    return f"rename-frame {old}={new}"


def shift(subject: str | _Edge, offset: float) -> str:
    """Return the rule that corrects stamps that are an offset in nanoseconds before their arrival.

    An offset of whole hours is the mistake; what remains is the usual delay. Others are rounded to milliseconds.

    Example:
        >>> shift(("odom", "base_link"), 3600.003e9), shift("/scan", -2.5e9)
        ('shift odom->base_link=+1h', 'shift /scan=-2500ms')
    """
    name = subject if isinstance(subject, str) else "->".join(subject)
    hours = round(offset / HOUR)
    if hours and abs(offset - hours * HOUR) < _MAX_LATENCY:
        return f"shift {name}={hours:+d}h"
    return f"shift {name}={round(offset / MILLISECOND):+d}ms"


def drop_edge(edge: _Edge, topic: str = "") -> str:
    """Return the rule that leaves an edge out, on one topic or on all."""
    return f"drop-publisher {'->'.join(edge)}" + (f"@{topic}" if topic else "")


def drop_tracks(edge: _Edge) -> tuple[str, str]:
    """Return the rules that leave out the first or the second of two publishers of an edge."""
    return f"drop-publisher {'->'.join(edge)}#1", f"drop-publisher {'->'.join(edge)}#2"


def replace_mount(child: str, pose: NDArray[np.float64]) -> str:
    """Return the rule that replaces the pose of a frame: x, y, z, qx, qy, qz, qw."""
    # Adding 0.0 turns -0.0 into 0.0.
    return f"replace-mount {shlex.quote(child)} {' '.join(f'{value + 0.0:.9g}' for value in np.asarray(pose).tolist())}"


def set_static(parent: str, child: str) -> str:
    """Return the form of the rule that adds a static transform."""
    return f"set-static {shlex.quote(parent)} {shlex.quote(child)} X Y Z ROLL PITCH YAW"
