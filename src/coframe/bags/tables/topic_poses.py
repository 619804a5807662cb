# SPDX-License-Identifier: Apache-2.0
"""Trajectories from topics: the poses in Odometry, PoseStamped, TransformStamped, Path and similar messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._output.formatting import count, join_names
from coframe.bags.tables._fields import FieldReader
from coframe.bags.tables._leaves import MissingElementError, at_path, class_fields
from coframe.bags.tables._sampling import TopicReader
from coframe.bags.tables.columns import FieldSource
from coframe.errors import RecordingError
from coframe.messages.definition import AbstractNestedType, NamespacedType
from coframe.time import stamp_ns
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.bags.recording import Recording

__all__ = ["has_pose", "topic_poses"]

_POSE_FIELDS = (("position", "orientation"), ("translation", "rotation"))
_MAX_LEVELS = 4  # of messages around a pose; in Odometry there are two
_NUMBERS_PER_POSE = 7
_LIST_FIELDS = ("poses", "transforms")
_COVARIANCE_SIZE = 36

_Path = tuple[str, ...]


def has_pose(recording: Recording, source: FieldSource) -> bool:
    """Return whether messages contain a pose that has no field with the last name of the path."""
    messages = TopicReader(recording, recording.find_topic(source.topic))
    message = messages.first()
    try:
        owner = type(at_path(message, source.path[:-1]))
    except LookupError:
        return False
    is_message = hasattr(owner, "SLOT_TYPES")
    return is_message and source.path[-1] not in class_fields(owner) and len(_pose_paths(owner)) == 1


def topic_poses(recording: Recording, source: FieldSource, report: Callable[[str], object]) -> Transform:
    """Return the poses in the messages on a topic, sorted by stamp. For lists of poses, use the last message.

    Args:
        recording: The recording.
        source: The topic, with a field if its messages contain several poses.
        report: Called with a sentence for poses that are skipped, and if receive times are used.

    Raises:
        RecordingError: The topic or the field does not exist, or the messages have no poses or several.
    """
    topic = recording.find_topic(source.topic)
    label = ".".join([topic, *map(str, source.path)])
    messages = TopicReader(recording, topic)
    first = messages.first()
    FieldReader(label, FieldSource(topic, source.path), first)  # raises an error if the field does not exist
    owner = at_path(first, source.path)
    if not hasattr(type(owner), "SLOT_TYPES"):
        raise _no_pose(label)
    if name := _list_of_poses(type(owner)):
        return _poses_of_list(messages, source.path, name, label, recording, report)
    path = _only_path(type(owner), label)
    rows, frames = np.full((len(messages.samples), _NUMBERS_PER_POSE + _COVARIANCE_SIZE), np.nan), dict[str, str]()
    for index, message in messages.iterate_messages(range(len(messages.samples))):
        if message is not None:
            _read(message, (*source.path, *path), rows[index])
            frame, child = _frames(message)
            frames.setdefault(frame, child)
    if not recording.has_stamps(topic):
        report(f"{topic}: the messages have no stamp, so their receive times are used")
    if len(frames) > 1:
        raise RecordingError(
            f"{label} has poses in several frames: {join_names(sorted(frames))}", hint="A trajectory is in one frame."
        )
    frame, child = next(iter(frames.items()))
    return _batch(rows, messages.samples, recording.frame(frame), recording.frame(child), label, report)


def _read(message: Any, path: tuple[Any, ...], row: NDArray[np.float64]) -> None:
    """Write the numbers of the pose at a path and of its covariance to a row."""
    try:
        pose, around = at_path(message, path), at_path(message, path[:-1])
    except MissingElementError:
        return
    row[:_NUMBERS_PER_POSE] = _numbers(pose)
    covariance = getattr(around, "covariance", None)
    if covariance is not None and len(covariance) == _COVARIANCE_SIZE:
        row[_NUMBERS_PER_POSE:] = covariance


def _frames(message: Any) -> tuple[str, str]:
    frame = getattr(getattr(message, "header", None), "frame_id", "")
    return str(frame), str(getattr(message, "child_frame_id", ""))


def _numbers(pose: Any) -> tuple[float, ...]:
    for linear, angular in _POSE_FIELDS:
        if hasattr(pose, linear):
            p, q = getattr(pose, linear), getattr(pose, angular)
            return (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
    raise TypeError(f"not a pose: {pose!r}")


def _batch(
    rows: NDArray[np.float64],
    stamps: NDArray[np.int64],
    frame: str,
    child: str,
    label: str,
    report: Callable[[str], object],
) -> Transform:
    """Return the valid poses as a trajectory."""
    with np.errstate(over="ignore"):
        norms = np.linalg.norm(rows[:, 3:_NUMBERS_PER_POSE], axis=1)
    valid = np.isfinite(rows[:, :_NUMBERS_PER_POSE]).all(axis=1) & (norms > 0) & np.isfinite(norms)
    if not valid.any():
        raise RecordingError(f"{label} has no valid pose", hint="All are NaN, or have quaternions of zeros.")
    if not valid.all():
        report(f"{label}: {count(int((~valid).sum()), 'pose')} with NaN or a zero quaternion skipped")
    kept = rows[valid]
    covariances = kept[:, _NUMBERS_PER_POSE:]
    has_covariance = np.isfinite(covariances).all() and covariances.any()
    return Transform(
        kept[:, :3],
        kept[:, 3:_NUMBERS_PER_POSE],
        target=frame or None,
        source=child or None,
        stamp=stamps[valid],
        covariance=_to_matrices(covariances) if has_covariance else None,
    )


def _to_matrices(covariances: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return covariances (N, 36) as matrices (N, 6, 6), or None if they are invalid, as some drivers publish."""
    matrices = covariances.reshape(-1, 6, 6)
    if not np.allclose(matrices, matrices.transpose(0, 2, 1)) or (np.linalg.eigvalsh(matrices) < -1e-9).any():
        return None
    return np.asarray((matrices + matrices.transpose(0, 2, 1)) / 2)


def _poses_of_list(
    messages: TopicReader,
    path: tuple[Any, ...],
    name: str,
    label: str,
    recording: Recording,
    report: Callable[[str], object],
) -> Transform:
    """Return the poses of the last message with a list, such as Path, each of which has its own stamp."""
    for _, message in messages.iterate_messages([len(messages.samples) - 1]):
        owner = None if message is None else at_path(message, path)
        items = [] if owner is None else list(getattr(owner, name))
        if not items:
            raise RecordingError(f"the last message on {messages.topic} has no poses")
        if not hasattr(items[0], "header"):
            raise RecordingError(
                f"the poses of {label} have no separate stamps, so they are not a trajectory",
                hint="Trajectories come from messages such as Odometry, PoseStamped, TransformStamped and Path.",
            )
        stamps = np.array([stamp_ns(each.header.stamp) for each in items], dtype=np.int64)
        children = {_frames(each)[1] for each in items}
        if name == "transforms" or len(children) > 1:
            raise RecordingError(
                f"{label} has transforms of a tree, not a trajectory", hint="Give two frames, such as map:base_link."
            )
        if len(items) > 1 and (np.diff(np.sort(stamps)) == 0).all():
            raise RecordingError(
                f"all poses of {label} have the same stamp, so they are a plan and not a trajectory",
                hint="Trajectories come from paths that a robot has driven.",
            )
        inner = _only_path(type(items[0]), label)
        rows = np.full((len(items), _NUMBERS_PER_POSE + _COVARIANCE_SIZE), np.nan)
        for row, item in enumerate(items):
            rows[row, :_NUMBERS_PER_POSE] = _numbers(at_path(item, inner))
        order = np.argsort(stamps, kind="stable")
        frame = _frames(message)[0] or _frames(items[0])[0]
        return _batch(rows[order], stamps[order], recording.frame(frame), "", label, report)
    raise RecordingError(f"{label} has no messages")


def _list_of_poses(cls: Any) -> str:
    """Return the field of a message that is a list of poses, or "" if there is none."""
    fields = class_fields(cls)
    for name in _LIST_FIELDS:
        type_ = fields.get(name)
        if isinstance(type_, AbstractNestedType) and isinstance(type_.value_type, NamespacedType):
            return name
    return ""


def _only_path(cls: Any, label: str) -> _Path:
    paths = _pose_paths(cls)
    if not paths:
        raise _no_pose(label)
    if len(paths) > 1:
        texts = [".".join([label, *path]) for path in paths]
        raise RecordingError(f"{label} contains several poses", hint=f"Choose one: {join_names(texts)}.")
    return paths[0]


def _no_pose(label: str) -> RecordingError:
    return RecordingError(
        f"the messages on {label} contain no pose",
        hint="A pose has the fields position and orientation, or translation and rotation.",
    )


def _pose_paths(cls: Any) -> list[_Path]:
    """Return the paths to the poses in a message class, at the first level that has any."""
    level: list[tuple[_Path, Any]] = [((), cls)]
    for _ in range(_MAX_LEVELS):
        fields = [(path, class_fields(each)) for path, each in level]
        if found := [path for path, names in fields if any(set(pair) <= set(names) for pair in _POSE_FIELDS)]:
            return found
        level = [
            ((*path, name), inner)
            for path, names in fields
            for name, inner in names.items()
            if isinstance(inner, NamespacedType)
        ]
    return []
