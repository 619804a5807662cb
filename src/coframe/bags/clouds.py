"""The points that a topic of a recording has measured, each message at its own time, in one frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from coframe import time
from coframe.errors import DecodeError, RecordingError, TransformException
from coframe.sensors import deskew, project_scan, transform_cloud
from coframe.sensors.layout import field_of
from coframe.sensors.point_times import TIME_FIELDS, UNITS, times_in
from coframe.sensors.thinning import thinned

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.bags.recording import RecordedMessage, Recording
    from coframe.time import StampLike

__all__ = ["Cloud", "Clouds"]

_CLOUD, _SCAN = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/LaserScan"
_OF_SCANS = {"intensity", "index"}
_LEAST_PENDING = 1_000_000  # points that are gathered before they are thinned


class Cloud(NamedTuple):
    """The points of one message.

    Attributes:
        stamp: Its header's, in nanoseconds.
        frame: What the points are told in.
        points: A structured array, (N,): ``x``, ``y``, ``z`` as float64 metres, all of them finite, and the other
            fields of the message as they are there.
        deskewed: Whether each point was moved by its own time.
    """

    stamp: int
    frame: str
    points: NDArray[Any]
    deskewed: bool


class Clouds:
    """A topic's clouds or scans, one after the other, seen from a frame; may be gone through again and again.

    Args:
        recording: Where they are.
        topic: Of PointCloud2 or LaserScan.
        frame: What the points shall be told in.
        start: Only messages whose stamps are at or after this.
        stop: Only those before this.
        at: Only the newest message that is no newer than this.
        deskew: ``"auto"`` moves each point by its own time where the message tells it (a field such as ``t``, ``time``
            or ``timestamp``; a scan's ``time_increment``), ``"off"`` all by the message's stamp.
        point_times: The field of a cloud that tells each point's time, and its unit (s, ms, us, ns) behind a colon:
            ``"time:us"``. Without a unit, or without both, that is guessed from the values: see ``times_read``.
        fixed: A frame that stands still during a sweep, where ``frame`` moves with the sensor.
        fields: The fields to keep besides x, y, z; None: all that have one number a point.

    Attributes:
        total: How many messages there are to go through.
        messages: How many of them gave points the last time, also if it was none.
        points: How many points.
        left_out: Messages that could not be transformed or read, by the reason.
        points_left_out: Single points that could not, by the reason.
        hint: What to do about the first message that could not be transformed; "" if there is none.
        times_read: In how many messages points were moved by their own times, by how these were taken.

    Raises:
        RecordingError: There is no such topic, or it has other messages.
        ValueError: ``deskew``, ``point_times`` or the fields of a scan are not among what they may be.
    """

    def __init__(
        self,
        recording: Recording,
        topic: str,
        frame: str,
        *,
        start: StampLike | None = None,
        stop: StampLike | None = None,
        at: StampLike | None = None,
        deskew: Literal["auto", "off"] = "auto",
        point_times: str | None = None,
        fixed: str | None = None,
        fields: Sequence[str] | None = None,
    ) -> None:
        if deskew not in {"auto", "off"}:
            raise ValueError(f'deskew must be "auto" or "off", not {deskew!r}')
        self._recording = recording
        self._stamps = recording.stamps(topic)  # raises where there is no such topic
        self.topic = topic if topic in recording.topics else f"/{topic}"
        self._type = recording.topics[self.topic].type
        if self._type not in {_CLOUD, _SCAN}:
            others = [name for name, other in recording.topics.items() if other.type in {_CLOUD, _SCAN}]
            raise RecordingError(
                f"{self.topic} has messages of the type {self._type}, which are no points",
                hint=f"PointCloud2 and LaserScan are on {', '.join(others) or 'no topic of this recording'}.",
            )
        self.frame = frame
        self._start, self._stop, self._at = start, stop, at
        self._deskews = deskew == "auto"
        self._time_field, self._time_unit = _field_and_unit(point_times)
        self._fixed = fixed
        self._fields = None if fields is None else [name for name in fields if name not in {"x", "y", "z"}]
        if self._type == _SCAN and (unknown := set(self._fields or ()) - _OF_SCANS):
            raise ValueError(f"scans have no field {', '.join(sorted(unknown))}, only {', '.join(sorted(_OF_SCANS))}")
        self._reset()

    def _reset(self) -> None:
        self.messages = self.points = 0
        self.left_out: dict[str, int] = {}
        self.points_left_out: dict[str, int] = {}
        self.times_read: dict[str, int] = {}
        self.hint = ""
        self._reasons: dict[tuple[Any, ...], str] = {}

    @property
    def total(self) -> int:
        """How many messages there are to go through."""
        if self._at is not None:
            return 1
        chosen = np.ones(len(self._stamps), dtype=bool)
        if self._start is not None:
            chosen &= self._stamps >= time.stamp_ns(self._start)
        if self._stop is not None:
            chosen &= self._stamps < time.stamp_ns(self._stop)
        return int(np.count_nonzero(chosen))

    def __iter__(self) -> Iterator[Cloud]:
        self._reset()
        for recorded in self._recorded():
            cloud = self._cloud(recorded)
            if cloud is not None:
                self.messages += 1
                self.points += len(cloud.points)
                yield cloud

    def accumulated(self, voxel: float) -> Cloud | None:
        """All points in one cloud, the first one of each cube; it takes memory for the points that are left.

        Args:
            voxel: The cubes' edge in metres.

        Returns:
            With the last message's stamp; None where there was no message.

        Raises:
            ValueError: As :func:`coframe.sensors.thinning.thinned`; or messages do not have the same fields.
        """
        kept: list[NDArray[Any]] = []
        last, pending, least = None, 0, _LEAST_PENDING
        for cloud in self:
            last = cloud
            kept.append(thinned(cloud.points, voxel))
            pending += len(kept[-1])
            if pending > least:
                kept = [thinned(_joined(kept), voxel)]
                pending, least = 0, max(_LEAST_PENDING, len(kept[0]))
        return None if last is None else last._replace(points=thinned(_joined(kept), voxel))

    def _recorded(self) -> Iterator[RecordedMessage]:
        if self._at is None:
            yield from self._recording.messages(self.topic, self._start, self._stop)
        elif (one := self._recording.message_at(self.topic, self._at)) is not None:
            yield one

    def _cloud(self, recorded: RecordedMessage) -> Cloud | None:
        try:
            message = recorded.message
            frame = self._recording.frame(str(message.header.frame_id))
            points, times = self._scan(message) if self._type == _SCAN else self._points(message, recorded.stamp)
            finite = np.isfinite(points["x"]) & np.isfinite(points["y"]) & np.isfinite(points["z"])
            self._note(self.points_left_out, "measured nothing (not a number)", np.count_nonzero(~finite))
            points, times = points[finite], times[finite] if times is not None else None
            deskewed = self._move(points, times, frame, recorded.stamp)
        except TransformException as error:
            self.hint = self.hint or error.hint
            self._note(self.left_out, self._reason(error))
        except (DecodeError, ValueError, AttributeError) as error:
            self._note(self.left_out, f"cannot be read: {error}")
        else:
            there = np.isfinite(points["x"])
            self._note(self.points_left_out, "have no transform at their own time", np.count_nonzero(~there))
            return Cloud(recorded.stamp, self.frame, points[there], deskewed)
        return None

    def _move(self, points: NDArray[Any], times: NDArray[np.int64] | None, frame: str, stamp: int) -> bool:
        """Brings points into the frame, in place; whether each by its own time."""
        buffer = self._recording.buffer
        if frame == self.frame and self._fixed is None:
            return False
        if times is None or not points.size:
            transform_cloud(points, buffer, self.frame, source=frame, stamp=stamp, in_place=True)
            return False
        options: Any = {"source": frame, "on_error": "nan", "in_place": True}
        if self._fixed is not None:
            options |= {"fixed": self._fixed, "at": stamp}
        deskew(points, times, buffer, self.frame, **options)
        return True

    def _points(self, message: Any, stamp: int) -> tuple[NDArray[Any], NDArray[np.int64] | None]:
        names = [field.name for field in message.fields if field.count <= 1 and field.name not in {"x", "y", "z"}]
        if self._fields is not None:
            times_of = TIME_FIELDS if self._time_field is None else (self._time_field,)
            needed = [name for name in times_of if name in names] if self._deskews else []
            names = list(dict.fromkeys([*self._fields, *needed]))
        columns = {name: field_of(message, name).reshape(-1) for name in ("x", "y", "z", *names)}
        points = _structured(columns)
        times = times_in(points, stamp, self._time_field, self._time_unit) if self._deskews else None
        if times is not None:
            since = "as stamps" if times.absolute else "from the message's stamp"
            self._note(self.times_read, f"the field {times.field}, taken for {times.unit} {since}")
        if self._fields is not None and names != self._fields:
            points = _structured({name: points[name] for name in ("x", "y", "z", *self._fields)})
        return points, None if times is None else times.times

    def _scan(self, message: Any) -> tuple[NDArray[Any], NDArray[np.int64] | None]:
        hits = project_scan(message)
        columns: dict[str, NDArray[Any]] = dict(zip("xyz", hits.points.T, strict=True))
        others = {"intensity": hits.intensities, "index": hits.beams}
        columns |= {n: v for n, v in others.items() if v is not None and (self._fields is None or n in self._fields)}
        self._note(self.points_left_out, "measured nothing (out of range)", len(message.ranges) - len(hits.points))
        return _structured(columns), hits.times if self._deskews and message.time_increment != 0 else None

    def _reason(self, error: TransformException) -> str:
        """The first text of errors that differ in their times only."""
        key = (type(error), error.target, error.source, error.edge)
        return self._reasons.setdefault(key, f"{type(error).__name__}: {error}")

    @staticmethod
    def _note(counts: dict[str, int], reason: str, times: int | np.integer[Any] = 1) -> None:
        if times:
            counts[reason] = counts.get(reason, 0) + int(times)


def _field_and_unit(text: str | None) -> tuple[str | None, str | None]:
    """Of ``FIELD:UNIT`` or ``FIELD``."""
    field, colon, unit = (text or "").partition(":")
    if (text is not None and not field) or (colon and unit not in UNITS):
        raise ValueError(f"{text!r} is no field with a unit: write time:us, with one of {', '.join(UNITS)}")
    return field or None, unit or None


def _structured(columns: dict[str, NDArray[Any]]) -> NDArray[Any]:
    """A packed little-endian array; coordinates as float64, so that those far from the origin stay exact."""
    kinds = [(n, "<f8" if n in {"x", "y", "z"} else v.dtype.newbyteorder("<")) for n, v in columns.items()]
    points = np.empty(len(columns["x"]), dtype=kinds)
    for name, values in columns.items():
        points[name] = values
    return points


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    if any(part.dtype != parts[0].dtype for part in parts):
        raise ValueError("the messages do not have the same fields: name those to keep")
    return np.concatenate(parts)
