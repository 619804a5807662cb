# SPDX-License-Identifier: Apache-2.0
"""The columns that a table is requested to have: fields of messages, and poses of frames."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

from coframe._output.formatting import did_you_mean
from coframe.errors import RecordingError
from coframe.time import duration_ns
from coframe.trajectories.formats import TRAJECTORY_SUFFIXES
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.time import DurationLike

__all__ = [
    "METHODS",
    "Column",
    "ColumnLike",
    "FieldSource",
    "Method",
    "PathSource",
    "PoseSource",
    "Step",
    "column",
    "column_list",
    "parse_path",
]

Method: TypeAlias = Literal["match", "nearest", "previous", "interpolate"]
METHODS = ("match", "nearest", "previous", "interpolate")
Step: TypeAlias = "str | int | Key"

_ARROW = re.compile(r"->|→|:")
_NAME = re.compile(r"([A-Za-z_][\w-]*)\s*=\s*(\S.*)", re.ASCII | re.DOTALL)
_METHOD = re.compile(r"(.*\S)\s*@\s*([A-Za-z_]+)\s*(?::\s*(.*))?", re.ASCII | re.DOTALL)
_STEP = re.compile(r"([A-Za-z_]\w*)((?:\[[^\[\]]+\])*)", re.ASCII)
_INDEX = re.compile(r"-?\d+", re.ASCII)
_EXAMPLES = (
    "Examples: '/odom.pose', '/scan.ranges[0]', '/joint_states.position[elbow]', 'map:camera', ('map', 'camera')."
)


class Key(str):
    """A name that is used as an index, such as the name of a joint."""

    __slots__ = ()


class FieldSource(NamedTuple):
    """Messages on a topic, or one of their fields.

    Attributes:
        topic: The name of the topic.
        path: The names of the fields from the outermost one, indices, and names of elements; () for whole messages.
    """

    topic: str
    path: tuple[Step, ...] = ()


class PathSource(NamedTuple):
    """A trajectory that is not in the recording.

    Attributes:
        poses: The poses with their stamps, or the name of a file.
    """

    poses: Transform | str


class PoseSource(NamedTuple):
    """The pose of a frame.

    Attributes:
        target: The frame in which the pose is expressed.
        source: The frame that moves; in text, perhaps with a quantity such as ``.yaw`` at its end.
        is_text: Whether it was written as text.
    """

    target: str
    source: str
    is_text: bool = False


@dataclass(frozen=True)
class Column:
    """A column of :meth:`coframe.bags.Recording.table`.

    Attributes:
        source: A topic with or without a field (``"/odom"``, ``"/imu.angular_velocity"``, ``"/scan.ranges[0]"``,
            ``"/joint_states.position[elbow]"``), or a pose: ``("map", "camera")``, which is the pose of ``camera``
            relative to ``map``, ``"map:camera"``, or one of its quantities, ``"map:camera.yaw"``; or a trajectory: a
            batch of poses with stamps, or the name of a file for :func:`coframe.trajectories.read_trajectory`.
        method: Which messages the value at a time comes from: the ``"nearest"`` one, the ``"previous"`` one, or the one
            whose stamp is equal (``"match"``); ``"interpolate"`` numbers linearly between the two messages around the
            time, and quaternions along the shortest arc. None means the method of the table. Poses of frames are
            always interpolated.
        name: The name of the column; "" means the source.
        tolerance: The maximum time between the message and the row: nanoseconds or a string such as ``"20ms"``. None
            means the tolerance of the table.
        max_gap: The maximum interval for interpolation between two messages or transforms; None means that of the
            table.
    """

    source: str | tuple[str, str] | Transform
    method: Method | None = None
    name: str = ""
    tolerance: DurationLike | None = None
    max_gap: DurationLike | None = None

    def __post_init__(self) -> None:
        if self.method is not None and self.method not in METHODS:
            hint = did_you_mean(str(self.method), METHODS)
            raise RecordingError(
                f"{self.label}: no method named {self.method!r}", hint=f"{hint} Methods: {', '.join(METHODS)}.".lstrip()
            )
        for what, length, smallest in (("tolerance", self.tolerance, 0), ("max_gap", self.max_gap, 1)):
            if length is not None and duration_ns(length) < smallest:
                raise RecordingError(
                    f"{self.label}: {what} must {'not be negative' if not smallest else 'be positive'}"
                )
        parsed = self.parsed
        if not isinstance(parsed, FieldSource) and (
            self.tolerance is not None or self.method not in {None, "interpolate"}
        ):
            option = "method" if self.tolerance is None else "tolerance"
            raise RecordingError(
                f"{self.label}: poses of frames are interpolated between transforms, so they have no {option}",
                hint="max_gap limits the interval between the two transforms.",
            )

    @property
    def label(self) -> str:
        """The name of the column in the table."""
        if self.name:
            return self.name
        if isinstance(self.source, Transform):
            return self.source.source or "trajectory"
        if isinstance(self.source, str):
            return Path(self.source).stem if isinstance(self.parsed, PathSource) else self.source
        return ":".join(self.source)

    @property
    def parsed(self) -> FieldSource | PoseSource | PathSource:
        """What the source means.

        Raises:
            RecordingError: It is not a source of a column.
        """
        if isinstance(self.source, Transform):
            return PathSource(self.source)
        return _parse_source(self.source) if isinstance(self.source, str) else PoseSource(*self.source)


ColumnLike: TypeAlias = "str | tuple[str, str] | Transform | Column"


def column(spec: ColumnLike) -> Column:
    """Return a column for a string, a pair of frames, or a column.

    Args:
        spec: Text may have a name before it and a method with a tolerance after it:
            ``"speed=/odom.twist.twist.linear.x@previous:100ms"``.

    Raises:
        RecordingError: It is not a column.

    Example:
        >>> column("speed=/odom.twist.twist.linear.x@previous:100ms").name
        'speed'
    """
    if isinstance(spec, Column):
        return spec
    if isinstance(spec, Transform):
        return Column(spec)
    if isinstance(spec, str):
        return _parse_column(spec)
    other: object = spec
    if isinstance(other, tuple | list) and list(map(type, other)) == [str, str]:
        return Column((other[0], other[1]))
    raise RecordingError(f"{spec!r} is not a column", hint=_EXAMPLES)


def column_list(spec: ColumnLike | Sequence[ColumnLike]) -> list[ColumnLike]:
    """Return columns as a list. A tuple of two names is one pose if they are names of frames."""
    if isinstance(spec, str | Column | Transform):
        return [spec]
    is_pose = isinstance(spec, tuple) and list(map(type, spec)) == [str, str]
    if is_pose and not any(str(each).startswith("/") or ":" in str(each) for each in spec):
        return [(str(spec[0]), str(spec[1]))]
    return list(spec)


def _parse_column(text: str) -> Column:
    name, source, method, tolerance = "", text.strip(), None, None
    if match := _NAME.fullmatch(source):
        name, source = match.groups()
    if match := _METHOD.fullmatch(source):
        source, method, tolerance = match.groups()
    try:
        limit = None if tolerance is None else duration_ns(tolerance)
    except ValueError as error:
        raise RecordingError(f"{text!r}: {error}", hint="Write the tolerance as in @nearest:20ms.") from None
    return Column(source, method, name, limit)  # type: ignore[arg-type]  # Column checks the method


def _parse_source(text: str) -> FieldSource | PoseSource | PathSource:
    is_file_name = Path(text).suffix.lower() in TRAJECTORY_SUFFIXES
    if is_file_name and (Path(text).is_file() or not (text.startswith("/") or _ARROW.search(text))):
        return PathSource(text)
    frames = [part.strip() for part in _ARROW.split(text, maxsplit=1)]
    if len(frames) == 2:
        if not all(frames):
            raise RecordingError(f"{text!r} needs a frame on both sides of the colon", hint=_EXAMPLES)
        return PoseSource(frames[0], frames[1], is_text=True)
    if not text.startswith("/"):
        raise RecordingError(
            f"{text!r} is neither two frames nor a topic: topics begin with '/', frames are separated by ':'",
            hint=_EXAMPLES,
        )
    topic, dot, rest = text.partition(".")
    if dot and not rest:
        raise RecordingError(f"{text!r} ends with a dot", hint=_EXAMPLES)
    try:
        return FieldSource(topic, parse_path(rest) if rest else ())
    except ValueError as error:
        raise RecordingError(f"{text!r} is not valid at {str(error)!r}", hint=_EXAMPLES) from None


def parse_path(text: str) -> tuple[Step, ...]:
    """Parse the path of a field: names with dots between them, and indices or names of elements in brackets.

    Raises:
        ValueError: The text is not a path; the message is the part that is wrong.

    Example:
        >>> parse_path("poses[0].pose.position.x")
        ('poses', 0, 'pose', 'position', 'x')
    """
    path: list[Step] = []
    # A name in brackets may contain dots.
    for part in re.split(r"\.(?![^\[]*\])", text):
        match = _STEP.fullmatch(part)
        if match is None:
            raise ValueError(part)
        path.append(match[1])
        path += [_index(index) for index in re.findall(r"\[([^\[\]]+)\]", match[2])]
    return tuple(path)


def _index(text: str) -> int | Key:
    return int(text) if _INDEX.fullmatch(text) else Key(text.strip("'\""))
