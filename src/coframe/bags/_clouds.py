# SPDX-License-Identifier: Apache-2.0
"""The points of a recorded topic (clouds, laser scans or depth images), transformed into one frame and deskewed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from coframe import time
from coframe._output.formatting import count, duration
from coframe.analysis.liveness import usual_period
from coframe.bags._cloud_colors import CloudColors
from coframe.bags._recorded_camera import RecordedCamera
from coframe.buffer.gaps import gap_limit, in_long_gap
from coframe.errors import CameraError, DecodeError, ExtrapolationException, RecordingError, TransformException
from coframe.sensors import deskew, project_scan, transform_cloud
from coframe.sensors.depth_clouds import decode_depths, depth_points
from coframe.sensors.layout import field_of
from coframe.sensors.motion import still_frame
from coframe.sensors.point_times import (
    NO_TIME,
    TIME_FIELDS,
    UNITS,
    PointTimes,
    UnknownTimesError,
    implausible_sweep_reason,
    likely_times,
    read_times,
)
from coframe.sensors.thinning import thin_points
from coframe.type_names import COMPRESSED_IMAGE, IMAGE, LASER_SCAN, POINT_CLOUD

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.bags.recording import RecordedMessage, Recording
    from coframe.buffer.gaps import OnGap
    from coframe.time import DurationLike, StampLike

__all__ = ["Cloud", "Clouds"]

_SCAN_FIELDS = {"intensity", "index"}
_COLOR_FIELDS = ("red", "green", "blue", "colored")
_TYPES = {POINT_CLOUD, LASER_SCAN, IMAGE, COMPRESSED_IMAGE}
_MIN_PENDING = 1_000_000  # points to gather before they are thinned
_MAX_COMPARED_STAMPS = 200  # stamps of messages at which is seen what moves


class Cloud(NamedTuple):
    """The points of one message.

    Attributes:
        stamp: Stamp of the message in nanoseconds.
        frame: The frame in which the points are expressed.
        points: A structured array, (N,): ``x``, ``y``, ``z`` in meters as float64, all finite unless ``on_gap`` is
            ``"nan"``, and the other fields of the message with their types.
        deskewed: Whether each point was transformed at its own time.
        used_times: Name of the field with these times, even if all points of the message have the same time, or None if
            there is none, or if the points were not deskewed although their times differ.
    """

    stamp: int
    frame: str
    points: NDArray[Any]
    deskewed: bool
    used_times: str | None = None


class _MeasuredPoints(NamedTuple):
    """The points of one message in the frame of the sensor, with the time of each point."""

    points: NDArray[Any]
    times: NDArray[np.int64] | None = None
    read: PointTimes | None = None
    same_times: str | None = None  # the field, if all points have the same time


class Clouds:
    """An iterable over the point clouds, laser scans or depth images of a topic, transformed into one frame.

    It can be iterated several times. The attributes below describe the last iteration.

    Args:
        recording: The recording that contains the topic and the transforms.
        topic: A topic of PointCloud2 or LaserScan messages, or of depth images: Image (16UC1 in millimeters, 32FC1 in
            meters) or CompressedImage (compressedDepth).
        frame: The frame into which the points are transformed.
        start: The first stamp; earlier messages are skipped.
        stop: The end; messages with this or a later stamp are skipped.
        at: Read only the newest message with at most this stamp.
        deskew: ``"auto"`` transforms each point at its own time if the message contains it (a field such as ``t``,
            ``time`` or ``timestamp``, or the ``time_increment`` of a scan). ``"off"`` uses the stamp of the message.
        point_times: The field with the times of the points, and its unit (s, ms, us or ns) after a colon:
            ``"time:us"``. If omitted, the field or its unit is guessed; see ``times_read``.
        fixed: A frame that does not move during a sweep. If omitted, it is ``frame``, or, if ``frame`` moves with the
            sensor, the nearest frame above that does not; see ``fixed_frames``.
        fields: The fields to keep in addition to x, y, z, or None for all fields with one number per point.
        max_gap: The longest interval between two transforms of an edge to interpolate over, such as ``"200ms"``. None
            interpolates over any gap; see ``gaps``.
        on_gap: What to do with points in longer gaps: ``"omit"`` them, set their coordinates to ``"nan"``, or
            ``"raise"`` an ExtrapolationException.
        validity: Whether the points get the field ``gap_ns``: the longest interval between two transforms of an edge
            that their pose was interpolated over, in nanoseconds (int64).
        color: A topic of images that color the points: Image or CompressedImage. Each point is moved to the time of
            the image; points that the camera does not see, or that are behind nearer ones, get no color. The points get
            the fields ``red``, ``green``, ``blue`` and ``colored`` (0 or 1), as uint8.
        color_info: The topic of the CameraInfo of these images, or None for the one next to them.
        depth_info: The topic of the CameraInfo of depth images, or None for the one next to them.

    Attributes:
        total: Number of messages to read.
        messages: Number of messages that were transformed, including empty ones.
        points: Number of points.
        skipped: Number of skipped messages by reason.
        points_skipped: Number of skipped points by reason.
        hint: What to do about the first message that could not be transformed, or "" if there is none.
        deskewed: Number of messages whose points were transformed at their own times.
        times_read: Number of deskewed messages, by how their times were interpreted.
        fixed_given: Whether ``fixed`` was given.
        fixed_frames: Number of deskewed messages, by the frame that was assumed not to move during a sweep.
        not_deskewed: Number of messages that have point times but were not deskewed, by reason.
        gaps: Number of messages that lie in an unusually long gap of an edge, if there is no ``max_gap``, by edge.
        doubts: Number of messages with suspicious times, by reason.
        colored: Number of points that have a color.

    Raises:
        RecordingError: The topic does not exist or has another type.
        ValueError: ``deskew``, ``point_times``, ``fields`` or a value about gaps is invalid.
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
        max_gap: DurationLike | None = None,
        on_gap: OnGap = "omit",
        validity: bool = False,
        color: str | None = None,
        color_info: str | None = None,
        depth_info: str | None = None,
    ) -> None:
        if deskew not in {"auto", "off"}:
            raise ValueError(f'deskew must be "auto" or "off", not {deskew!r}')
        self._recording = recording
        self._stamps = recording.stamps(topic)  # Raises if the topic does not exist.
        self.topic = topic if topic in recording.topics else f"/{topic}"
        self._type = recording.topics[self.topic].type
        if self._type not in _TYPES:
            others = [name for name, other in recording.topics.items() if other.type in _TYPES]
            raise RecordingError(
                f"{self.topic} has type {self._type}, not PointCloud2, LaserScan or Image",
                hint=f"Topics with points or images: {', '.join(others) or 'none'}.",
            )
        is_image = self._type in {IMAGE, COMPRESSED_IMAGE}
        self._depth_camera = RecordedCamera(recording, self.topic, depth_info) if is_image else None
        self._colors = None if color is None else CloudColors(recording, color, color_info)
        self.frame = frame
        self._start, self._stop, self._only_at = start, stop, at
        self._deskews = deskew == "auto"
        self._time_field, self._time_unit = _field_and_unit(point_times)
        self._fixed_frame = fixed
        self.fixed_given = fixed is not None
        self._period = round(usual_period(np.sort(self._stamps)))
        self._still_frames: dict[str, str | None] = {}
        self._fields = None if fields is None else [name for name in fields if name not in {"x", "y", "z"}]
        if self._type == LASER_SCAN and (unknown := set(self._fields or ()) - _SCAN_FIELDS):
            known = ", ".join(sorted(_SCAN_FIELDS))
            raise ValueError(f"Scans have no field named {', '.join(sorted(unknown))}. Known fields: {known}.")
        self._max_gap = gap_limit(max_gap, on_gap)
        self._on_gap = on_gap
        self._with_validity = validity
        self._reset_counts()

    def _reset_counts(self) -> None:
        self.messages = self.points = self.deskewed = 0
        self.skipped: dict[str, int] = {}
        self.points_skipped: dict[str, int] = {}
        self.times_read: dict[str, int] = {}
        self.fixed_frames: dict[str, int] = {}
        self.not_deskewed: dict[str, int] = {}
        self.doubts: dict[str, int] = {}
        self.gaps: dict[str, int] = {}
        self.colored = 0
        if self._colors is not None:
            self._colors.not_colored = {}
        self.hint = ""
        self._known_reasons: dict[tuple[Any, ...], str] = {}
        self._unknown_time_reasons: dict[str | None, str] = {}  # the first message stands for all

    @property
    def not_colored(self) -> dict[str, int]:
        """Number of messages whose points have no colors, by reason."""
        return {} if self._colors is None else self._colors.not_colored

    @property
    def total(self) -> int:
        """Number of messages to read."""
        if self._only_at is not None:
            return 1
        selection = np.ones(len(self._stamps), dtype=bool)
        if self._start is not None:
            selection &= self._stamps >= time.stamp_ns(self._start)
        if self._stop is not None:
            selection &= self._stamps < time.stamp_ns(self._stop)
        return int(np.count_nonzero(selection))

    def __iter__(self) -> Iterator[Cloud]:
        self._reset_counts()
        for recorded in self._read_messages():
            cloud = self._cloud(recorded)
            if cloud is not None:
                self.messages += 1
                self.points += len(cloud.points)
                yield cloud

    def accumulated(self, voxel: float) -> Cloud | None:
        """Return one cloud with the first point in each voxel. Only these points are kept in memory.

        Args:
            voxel: Edge length of the voxels in meters.

        Returns:
            A cloud with the stamp of the last message, or None if there are no messages.

        Raises:
            ValueError: The edge length is invalid, or the messages have different fields.
        """
        kept: list[NDArray[Any]] = []
        last, pending, least = None, 0, _MIN_PENDING
        for cloud in self:
            last = cloud
            kept.append(thin_points(cloud.points, voxel))
            pending += len(kept[-1])
            if pending > least:
                kept = [thin_points(_concatenate(kept), voxel)]
                pending, least = 0, max(_MIN_PENDING, len(kept[0]))
        return None if last is None else last._replace(points=thin_points(_concatenate(kept), voxel))

    def _read_messages(self) -> Iterator[RecordedMessage]:
        if self._only_at is None:
            yield from self._recording.messages(self.topic, self._start, self._stop)
        elif (one := self._recording.message_at(self.topic, self._only_at)) is not None:
            yield one

    def _cloud(self, recorded_message: RecordedMessage) -> Cloud | None:
        try:
            message = recorded_message.message
            frame = self._recording.frame(str(message.header.frame_id))
            measured = self._measured(message, recorded_message.stamp)
            points, times = measured.points, measured.times
            finite = np.isfinite(points["x"]) & np.isfinite(points["y"]) & np.isfinite(points["z"])
            self._count(self.points_skipped, "have no finite coordinates", np.count_nonzero(~finite))
            points, times = points[finite], times[finite] if times is not None else None
            points = self._add_colors(points, times, frame, recorded_message.stamp)
            deskewed = self._transform_points(points, times, frame, recorded_message.stamp)
            gaps = self._find_gaps(times, frame, recorded_message.stamp)
        except TransformException as error:
            self.hint = self.hint or error.hint
            self._count(self.skipped, self._reason(error))
        except (CameraError, DecodeError, ValueError, AttributeError) as error:
            self.hint = self.hint or getattr(error, "hint", "")
            self._count(self.skipped, f"cannot be read: {error}")
        else:
            transformed = np.isfinite(points["x"])
            self._count(self.points_skipped, "have no transform at their own time", np.count_nonzero(~transformed))
            if self._max_gap is not None:
                transformed = self._apply_max_gap(points, transformed, gaps, frame, recorded_message.stamp)
            if self._with_validity:
                points = _structured_array(
                    {**{name: points[name] for name in points.dtype.names or ()}, "gap_ns": gaps}
                )
            if deskewed:
                self._count_times(measured.read)
            read = measured.read if deskewed else None
            used = measured.same_times if read is None else read.field
            return Cloud(recorded_message.stamp, self.frame, points[transformed], deskewed, used)
        return None

    def _measured(self, message: Any, stamp: int) -> _MeasuredPoints:
        if self._depth_camera is not None:
            return self._depths(message, self._depth_camera, stamp)
        return self._scan(message) if self._type == LASER_SCAN else self._points(message, stamp)

    def _add_colors(
        self, points: NDArray[Any], times: NDArray[np.int64] | None, frame: str, stamp: int
    ) -> NDArray[Any]:
        """Return the points with fields for their colors, if there is a camera."""
        if self._colors is None:
            return points
        fixed = self._choose_fixed_frame(frame)
        xyz = np.stack([points[axis] for axis in "xyz"], axis=1)
        colors, visible = self._colors.colors(xyz, times, frame, stamp, fixed)
        self.colored += int(np.count_nonzero(visible))
        columns = {name: points[name] for name in points.dtype.names or () if name not in _COLOR_FIELDS}
        added = zip(_COLOR_FIELDS, (*colors.T, visible.astype(np.uint8)), strict=True)
        return _structured_array({**columns, **dict(added)})

    def _transform_points(self, points: NDArray[Any], times: NDArray[np.int64] | None, frame: str, stamp: int) -> bool:
        """Transform points in place, and return whether each was transformed at its own time."""
        buffer = self._recording.buffer
        fixed = self._choose_fixed_frame(frame) if times is not None and points.size else None
        if fixed is None or times is None:
            if frame != self.frame:
                transform_cloud(points, buffer, self.frame, source=frame, stamp=stamp, in_place=True)
            if times is not None and points.size:
                reason = f"no transform moves {frame!r} relative to {self.frame!r} or to a frame above it"
                self._count(self.not_deskewed, reason)
            return False
        options: Any = {"source": frame, "on_error": "nan", "in_place": True}
        if fixed != self.frame:
            options |= {"fixed": fixed, "at": stamp}
        deskew(points, times, buffer, self.frame, **options)
        self._count(self.fixed_frames, fixed)
        return True

    def _find_gaps(self, times: NDArray[np.int64] | None, frame: str, stamp: int) -> NDArray[np.int64]:
        """Return over which gap the pose of each point is interpolated in nanoseconds, or one value for all."""
        buffer, fixed = self._recording.buffer, self._choose_fixed_frame(frame) or self.frame
        known = np.array([stamp]) if times is None else np.where(times == NO_TIME, stamp, times)
        legs = [(fixed, frame, known), (self.frame, fixed, np.array([stamp]))]
        legs = [leg for leg in legs if leg[0] != leg[1]]
        gaps = np.zeros(1, dtype=np.int64)
        if self._max_gap is not None or self._with_validity:
            for target, source, stamps in legs:
                gaps = np.maximum(gaps, buffer.validity(target, source, stamps).gaps)
        if self._max_gap is None:
            for target, source, stamps in legs:
                if child := in_long_gap(buffer, target, source, stamps):
                    self._count(self.gaps, child)
                    break
        return gaps

    def _apply_max_gap(
        self,
        points: NDArray[Any],
        transformed: NDArray[np.bool_],
        gaps: NDArray[np.int64],
        frame: str,
        stamp: int,
    ) -> NDArray[np.bool_]:
        """Return which points are kept, and raise or set those in longer gaps to NaN on request."""
        limit = self._max_gap or 0
        inside = transformed & (gaps > limit)
        if inside.any() and self._on_gap == "raise":
            raise ExtrapolationException.with_details(
                f"{count(int(inside.sum()), 'point')} of the message at {stamp} ns lie in a gap of "
                f"{duration(int(gaps.max()))} between two transforms, which is longer than max_gap, {duration(limit)}",
                target=self.frame,
                source=frame,
                requested=stamp,
                hint="coframe doctor lists the gaps.",
            )
        self._count(self.points_skipped, "lie in a gap that is longer than max_gap", np.count_nonzero(inside))
        if self._on_gap == "omit":
            return transformed & ~inside
        for name in "xyz":
            points[name][inside] = np.nan
        return transformed

    def _choose_fixed_frame(self, frame: str) -> str | None:
        """Return the frame that does not move during a sweep of this sensor, or None if nothing moves."""
        if self._fixed_frame is not None:
            return self._fixed_frame
        if frame not in self._still_frames:
            stamps = self._stamps[:: -(-len(self._stamps) // _MAX_COMPARED_STAMPS)]
            self._still_frames[frame] = still_frame(self._recording.buffer, self.frame, frame, stamps)
        return self._still_frames[frame]

    def _count_times(self, times: PointTimes | None) -> None:
        self.deskewed += 1
        if times is None:
            return
        reference = "as stamps" if times.absolute else "relative to the message's stamp"
        guessed = ", inferred from the length of the sweep" if times.found else ""
        self._count(self.times_read, f"the field {times.field}, interpreted in {times.unit} {reference}{guessed}")
        if implausible_sweep_reason(times, self._period):
            # One sentence is enough: the sweeps of most messages differ a little.
            first = next(iter(self.doubts), implausible_sweep_reason(times, self._period))
            self._count(self.doubts, first)

    def _points(self, message: Any, stamp: int) -> _MeasuredPoints:
        names = [field.name for field in message.fields if field.count <= 1 and field.name not in {"x", "y", "z"}]
        if self._fields is not None:
            times_of = TIME_FIELDS if self._time_field is None else (self._time_field,)
            needed = [name for name in times_of if name in names] if self._deskews else []
            names = list(dict.fromkeys([*self._fields, *needed]))
        columns = {name: field_of(message, name).reshape(-1) for name in ("x", "y", "z", *names)}
        points = _structured_array(columns)
        times, same = self._times(points, stamp) if self._deskews else (None, None)
        if self._fields is not None and names != self._fields:
            points = _structured_array({name: points[name] for name in ("x", "y", "z", *self._fields)})
        return _MeasuredPoints(points, None if times is None else times.times, times, same)

    def _times(self, points: NDArray[Any], stamp: int) -> tuple[PointTimes | None, str | None]:
        """Return the times of the points, and the name of their field if all of them are the same."""
        names = points.dtype.names or ()
        field = next((name for name in TIME_FIELDS if name in names), None)
        if field is None and self._time_field is None and (likely := likely_times(names)):
            self._count(self.not_deskewed, f"{likely[0]!r} may be the time of each point: select it with its unit")
        try:
            times = read_times(points, stamp, self._time_field, self._time_unit, period=self._period)
        except UnknownTimesError as error:
            self._count(self.not_deskewed, self._unknown_time_reasons.setdefault(self._time_field, str(error)))
            return None, None
        return times, (self._time_field or field) if times is None else None

    def _scan(self, message: Any) -> _MeasuredPoints:
        hits = project_scan(message)
        columns: dict[str, NDArray[Any]] = dict(zip("xyz", hits.points.T, strict=True))
        others = {"intensity": hits.intensities, "index": hits.beams}
        columns |= {n: v for n, v in others.items() if v is not None and (self._fields is None or n in self._fields)}
        self._count(self.points_skipped, "are out of range", len(message.ranges) - len(hits.points))
        return _MeasuredPoints(
            _structured_array(columns), hits.times if self._deskews and message.time_increment != 0 else None
        )

    def _depths(self, message: Any, camera: RecordedCamera, stamp: int) -> _MeasuredPoints:
        points = depth_points(decode_depths(message), camera.camera_at(stamp), rectified=camera.rectified).reshape(
            -1, 3
        )
        measured = np.isfinite(points[:, 2])
        self._count(self.points_skipped, "have no depth", np.count_nonzero(~measured))
        return _MeasuredPoints(_structured_array(dict(zip("xyz", points[measured].T, strict=True))))

    def _reason(self, error: TransformException) -> str:
        """Return the first error message that differs from this one only in its times."""
        key = (type(error), error.target, error.source, error.edge)
        return self._known_reasons.setdefault(key, f"{type(error).__name__}: {error}")

    @staticmethod
    def _count(counts: dict[str, int], reason: str, times: int | np.integer[Any] = 1) -> None:
        if times:
            counts[reason] = counts.get(reason, 0) + int(times)


def _field_and_unit(text: str | None) -> tuple[str | None, str | None]:
    """Split ``FIELD:UNIT`` or ``FIELD``."""
    field, colon, unit = (text or "").partition(":")
    if (text is not None and not field) or (colon and unit not in UNITS):
        raise ValueError(
            f"{text!r} is not a field with a unit. Write it as FIELD:UNIT, for example time:us. Units: "
            f"{', '.join(UNITS)}."
        )
    return field or None, unit or None


def _structured_array(columns: dict[str, NDArray[Any]]) -> NDArray[Any]:
    """Return a packed little-endian array, with float64 coordinates that remain exact far from the origin."""
    kinds = [(n, "<f8" if n in {"x", "y", "z"} else v.dtype.newbyteorder("<")) for n, v in columns.items()]
    points = np.empty(len(columns["x"]), dtype=kinds)
    for name, values in columns.items():
        points[name] = values
    return points


def _concatenate(parts: list[NDArray[Any]]) -> NDArray[Any]:
    if any(part.dtype != parts[0].dtype for part in parts):
        raise ValueError("The messages have different fields: choose the fields to keep.")
    return np.concatenate(parts)
