# SPDX-License-Identifier: Apache-2.0
"""Trajectories as arguments: files, frames in recordings, and topics of recordings."""

from __future__ import annotations

import warnings
from pathlib import Path, PurePath
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import numpy as np

from coframe._base_error import CoframeWarning
from coframe._output.formatting import count, duration
from coframe._sources.sources import as_source
from coframe._sources.urls import is_url
from coframe.bags.formats import has_known_suffix
from coframe.buffer.gaps import MAX_GAP
from coframe.cli.output import fail, warn
from coframe.cli.recordings import open_recording
from coframe.trajectories import read_trajectory
from coframe.trajectories.formats import TRAJECTORY_SUFFIXES

if TYPE_CHECKING:
    from collections.abc import Collection

    from coframe._sources.sources import Readable
    from coframe.bags import Recording
    from coframe.bags.namespaces import TransformChoice
    from coframe.transform.transform import Transform

__all__ = [
    "TRAJECTORY_FORMS",
    "frame_pair",
    "is_trajectory_file",
    "read_argument",
    "read_file",
    "read_frames",
]

TRAJECTORY_FORMS = (
    "a TUM, KITTI, EuRoC, CSV or npz file, BAG:/TOPIC for the poses on a topic, such as Odometry, PoseStamped or Path, "
    "or BAG:TARGET:SOURCE for the poses of the frame SOURCE relative to TARGET"
)


def is_trajectory_file(file: Readable) -> bool:
    """Return whether an argument is a trajectory file and not a recording, by its suffix."""
    is_folder = isinstance(file, Path) and file.is_dir()
    return PurePath(file.name).suffix.lower() in TRAJECTORY_SUFFIXES and not is_folder


def read_file(file: Readable) -> Transform:
    """Return the trajectory in a file; print on stderr what is suspicious about it."""
    return read_trajectory(file, report=warn)


def read_argument(text: str, choice: TransformChoice, max_gap: int = MAX_GAP) -> Transform:
    """Return the trajectory that an argument names; end the command if it is not one.

    Args:
        text: A file, ``BAG:/TOPIC`` or ``BAG:TARGET:SOURCE``; files and recordings may be URLs.
        choice: The transforms of the recording.
        max_gap: The longest interval over which poses are interpolated, in nanoseconds.

    Raises:
        CoframeError: The file, the recording, the topic or the frames cannot be read.
    """
    path, source = _split(text)
    if source:
        with open_recording(path, choice) as recording:
            if source.startswith("/") and ":" not in source:
                return recording.trajectory(source)
            return read_frames(recording, frame_pair(source, recording.buffer.frame_names()), max_gap)
    file = as_source(path)
    if has_known_suffix(PurePath(file.name)) or (isinstance(file, Path) and file.is_dir()):
        fail(
            f"{path} is a recording: give a topic with poses, or two of its frames",
            f"Write BAG:/TOPIC or BAG:TARGET:SOURCE, for example {path}:/odom or {path}:map:base_link.",
            code=2,
        )
    return read_file(file)


def read_frames(recording: Recording, frames: tuple[str, str], max_gap: int = MAX_GAP) -> Transform:
    """Return the poses of a frame, without interpolating between transforms that are far apart.

    Raises:
        CoframeError: The frames are not connected.
    """
    measured = recording.trajectory(frames, max_gap=max_gap)
    stamps = measured.stamps
    if stamps is None or not np.size(stamps):
        fail(
            f"every pose of {frames[1]!r} in {frames[0]!r} lies between transforms that are more than "
            f"{duration(max_gap)} apart",
            "Permit interpolation over longer intervals with --max-gap.",
        )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CoframeWarning)
        omitted = len(recording.trajectory(frames)) - len(measured)
    if omitted:
        warn(
            f"omitted {count(omitted, 'pose')} of {frames[1]!r} in {frames[0]!r} between transforms that are more than "
            f"{duration(max_gap)} apart; --max-gap changes this limit"
        )
    return measured


def frame_pair(text: str, frames: Collection[str]) -> tuple[str, str]:
    """Return the two frames in ``TARGET:SOURCE``, whose names may contain colons, such as ``map:tag36h11:0``."""
    parts = text.split(":")
    pairs = [(":".join(parts[:number]), ":".join(parts[number:])) for number in range(1, len(parts))]
    known = [pair for pair in pairs if {name.lstrip("/") for name in pair} <= {name.lstrip("/") for name in frames}]
    if len(known) > 1:
        fail(f"{text!r} can be several pairs of frames: {' or '.join(map(str, known))}", code=2)
    # The usual names have no colon; the error about an unknown frame then names the second part.
    return known[0] if known else pairs[0]


def _existing_path(text: str) -> tuple[str, str] | None:
    """Return the shortest path of an existing file in front of at least two names, and these."""
    parts = text.split(":")
    for number in range(1, len(parts) - 1):
        path = ":".join(parts[:number])
        if path and not is_url(text) and Path(path).exists() and all(parts[number:]):
            return path, ":".join(parts[number:])
    return None


def _split(text: str) -> tuple[str, str]:
    """Split an argument into a path and a topic or two frames; a path may contain colons."""
    if not is_url(text) and Path(text).exists():
        return text, ""
    bag, colon, topic = text.rpartition(":/")
    if colon and (is_url(bag) or (bag and Path(bag).exists())):
        return bag, f"/{topic}"
    if (colon_path := _existing_path(text)) is not None:
        return colon_path
    first, *frames = text.rsplit(":", 2)
    is_part_of_url = is_url(text) and not (is_url(first) and urlsplit(first).path)  # http://host:8000/run.tum
    if len(frames) == 2 and all((first, *frames)) and not is_part_of_url:
        return first, ":".join(frames)
    if frames and not is_url(text) and Path(first).exists():
        fail(
            f"{text!r} has one frame; a trajectory needs two",
            "Write BAG:TARGET:SOURCE, or BAG:/TOPIC for the poses on a topic.",
            code=2,
        )
    return text, ""
