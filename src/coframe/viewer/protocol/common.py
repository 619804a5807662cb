# SPDX-License-Identifier: Apache-2.0
"""Field types shared by several messages."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias, TypedDict

from coframe.viewer.protocol._limits import Range

JsonObject: TypeAlias = dict[str, Any]
Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
Span: TypeAlias = tuple[float, float]
Pose: TypeAlias = tuple[float, float, float, float, float, float, float]
"""x, y, z in meters, and a quaternion x, y, z, w."""

Id: TypeAlias = Annotated[int, Range(0, 2**32 - 1)]
Meters: TypeAlias = Annotated[float, Range(-1e9, 1e9)]
Radians: TypeAlias = Annotated[float, Range(-100.0, 100.0)]
Unit: TypeAlias = Annotated[float, Range(-1.01, 1.01)]
Variance: TypeAlias = Annotated[float, Range(0.0, 1e18)]
Position: TypeAlias = tuple[Meters, Meters, Meters]
Variances: TypeAlias = tuple[Variance, Variance, Variance]
Nanoseconds: TypeAlias = Annotated[float, Range(-(2.0**62), 2.0**62)]
PayloadRows: TypeAlias = tuple[int, int]
"""An offset into the numbers of a drawing, and a number of rows: 7 numbers per pose, 3 per point, 4 per color."""

UploadState: TypeAlias = Literal["receiving", "done", "failed"]
ViewerMode: TypeAlias = Literal["live", "recording", "buffer", "replay"]
ClockState: TypeAlias = Literal["system", "simulated", "paused"]
FrameActivity: TypeAlias = Literal["static", "fresh", "stale", "gone"]
DisplayState: TypeAlias = Literal["ok", "waiting", "error"]
Severity: TypeAlias = Literal["error", "warning", "note"]
FindingsState: TypeAlias = Literal["none", "waiting", "ready", "failed"]
LogLevel: TypeAlias = Literal["debug", "info", "warning", "error", "fatal"]
CompletionKind: TypeAlias = Literal["expression", "topic"]
ColorBy: TypeAlias = Literal["axis", "intensity", "rgb", "rgbf", "distance", "flat"]
ControlKind: TypeAlias = Literal["topic", "service", "action", "node"]
ControlStep: TypeAlias = Literal["names", "form", "act"]
ShapeKind: TypeAlias = Literal["box", "capsule", "cylinder", "mesh", "sphere"]
JointKind: TypeAlias = Literal["fixed", "revolute", "continuous", "prismatic", "floating", "planar"]
Reliability: TypeAlias = Literal["automatic", "reliable", "best_effort"]
Durability: TypeAlias = Literal["automatic", "volatile", "transient_local"]
AxisName: TypeAlias = Literal["x", "y", "z"]
NodeKind: TypeAlias = Literal["frame", "points", "lines", "mesh", "text", "image"]
WidgetKind: TypeAlias = Literal["button", "checkbox", "dropdown", "folder", "image", "number", "plot", "slider", "text"]

_RvizDisplay = TypedDict(
    "_RvizDisplay",
    {"class": str, "name": str, "enabled": bool, "topic": str | None, "options": JsonObject},
)


class RvizDisplay(_RvizDisplay, total=False):
    """A display of an RViz configuration; ``class`` has no package prefix.

    ``enabled`` is false also in a disabled group; ``checked`` is the display's own flag. ``source`` is the place in the
    file, missing for displays of the page, and ``group`` the source of the group that contains the display, or "".
    """

    checked: bool
    source: str
    group: str


class RvizGroup(TypedDict):
    """A group of displays; ``source`` is its place in the file, ``group`` that of the group that contains it, or ""."""

    source: str
    group: str
    name: str
    enabled: bool


RvizView = TypedDict("RvizView", {"class": str, "options": JsonObject})
"""The current view of an RViz configuration."""

RvizTool = TypedDict("RvizTool", {"class": str, "topic": str | None, "options": JsonObject})
"""A tool of an RViz configuration that publishes; ``class`` has no package prefix."""
