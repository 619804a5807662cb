# SPDX-License-Identifier: Apache-2.0
"""A shift from the clock of one recording to that of another, and its measurement from their common data."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe._output.formatting import count, did_you_mean, duration
from coframe.errors import RecordingError, TrajectoryError, TransformException
from coframe.time import DAY, MILLISECOND, SECOND
from coframe.trajectories.motion_offset import motion_offset
from coframe.type_names import is_tf_message

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.recording import Recording

__all__ = ["ClockShift", "measured_shift"]

_MAX_STAMP_AGE = 30 * DAY  # a stamp that differs more from its receive time is on another clock, such as simulated time
_MAX_MESSAGES = 20_000  # on a topic, that are compared
_MIN_EQUAL = 10
_MAX_DEVIATION = 10 * MILLISECOND
_MAD = 1.4826  # The standard deviation of a normal distribution is this multiple of its median absolute deviation.


class ClockShift(NamedTuple):
    """What is added to the times of a recording.

    Attributes:
        offset: The offset in nanoseconds at the time `middle`.
        drift: The change of the offset, in seconds per second.
        middle: A time after the shift, in nanoseconds.
        evidence: How it was measured, with its standard deviation, or "" for a given offset.
    """

    offset: int
    drift: float = 0.0
    middle: int = 0
    evidence: str = ""

    def apply(self, time: int) -> int:
        """Return a shifted time in nanoseconds."""
        shifted = time + self.offset
        return shifted + round(self.drift * (shifted - self.middle)) if self.drift else shifted

    def of_stamp(self, stamp: int, receive_time: int) -> int:
        """Return a shifted stamp; a stamp on a different clock from the receive time is not changed."""
        return self.apply(stamp) if abs(stamp - receive_time) < _MAX_STAMP_AGE else stamp


def measured_shift(first: Recording, second: Recording, method: str) -> ClockShift:
    """Return the shift of the second recording that brings it to the clock of the first one.

    Args:
        first: The recording whose clock is kept.
        second: The recording to shift.
        method: ``topic:/scan`` for a topic whose messages both received; ``motion:map:base_link`` for a frame that
            turns, with another name in the second recording as ``motion:map:base_link=world:camera``; ``auto`` for
            the topic with the most equal messages, or else for the frames that turn in both.

    Raises:
        RecordingError: The evidence is missing, or too weak for a standard deviation below 10 ms.
    """
    kind, _, what = method.partition(":")
    if kind == "topic" and what:
        return _by_messages(first, second, what)
    if kind == "motion" and what:
        return _by_motion(first, second, what)
    if method == "auto":
        return _by_anything(first, second)
    raise RecordingError(
        f"{method[:60]!r} is not an offset",
        hint="Write +35ms, auto, topic:/scan, motion:map:base_link or motion:map:base_link=world:camera.",
    )


def _by_messages(first: Recording, second: Recording, topic: str) -> ClockShift:
    for recording in (first, second):
        if topic not in recording.topics:
            raise RecordingError(
                f"{recording.path} has no topic {topic}", hint=did_you_mean(topic, list(recording.topics))
            )
    differences = _differences(first, second, topic)
    if len(differences) < _MIN_EQUAL:
        raise RecordingError(
            f"{topic} has {count(len(differences), 'message')} that both recordings received, and a time offset needs "
            f"{_MIN_EQUAL}"
        )
    offset = int(np.median(differences))
    spread = _MAD * float(np.median(np.abs(differences - offset)))
    deviation = 1.2533 * spread / np.sqrt(len(differences))  # of a median
    if deviation > _MAX_DEVIATION:
        raise RecordingError(
            f"the receive times of {topic} vary by {duration(spread)}, which gives a standard deviation of "
            f"{duration(deviation)} for the time offset; {duration(_MAX_DEVIATION)} is the limit"
        )
    text = f"{offset / SECOND:+.4f} s +-{duration(deviation)}, from {count(len(differences), 'message')} of {topic}"
    return ClockShift(offset, evidence=text)


def _differences(first: Recording, second: Recording, topic: str) -> NDArray[np.int64]:
    """Return the receive time in the first recording minus that in the second one, for each message in both."""
    known, other = _unique_messages(first, topic), _unique_messages(second, topic)
    return np.array([known[key] - other[key] for key in known.keys() & other.keys()], dtype=np.int64)


def _unique_messages(recording: Recording, topic: str) -> dict[bytes, int]:
    """Return the receive time by the hash of each message; without messages that occur twice."""
    found: dict[bytes, int] = {}
    repeated: set[bytes] = set()
    for number, (_, received, data) in enumerate(recording.in_order([topic])):
        if number >= _MAX_MESSAGES:
            break
        key = hashlib.blake2b(data, digest_size=16).digest()
        if key in found:
            repeated.add(key)
        found[key] = received
    return {key: received for key, received in found.items() if key not in repeated}


def _by_motion(first: Recording, second: Recording, what: str) -> ClockShift:
    own, _, other = what.partition("=")
    try:
        found = motion_offset(_rotations(first, own), _rotations(second, other or own))
    except (TransformException, TrajectoryError) as error:
        raise RecordingError(f"no time offset from the motion {what}: {error}", hint=error.hint) from None
    return ClockShift(found.offset, found.drift, found.middle, f"{found}, from the rotation of {what}")


def _rotations(recording: Recording, frames: str) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the rotations of SOURCE in TARGET for ``TARGET:SOURCE`` at each recorded sample."""
    from coframe.bags._trajectory_query import TrajectoryQuery  # noqa: PLC0415 - imports the recording

    target, colon, source = frames.partition(":")
    if not colon or not target or not source:
        raise RecordingError(f"{frames[:60]!r} is not two frames such as map:base_link")
    poses, _ = TrajectoryQuery(target, source).run(recording)
    return np.asarray(poses.stamps, dtype=np.int64), np.asarray(poses.quaternion)


def _by_anything(first: Recording, second: Recording) -> ClockShift:
    """Use the topic with the most equal messages; without one, the frames that turn in both recordings."""
    # Two publishers can send equal messages, such as a counter. Equal stamps show that it was one publisher.
    shared = [name for name, topic in first.topics.items() if topic.messages and _have_stamps(name, first, second)]
    counts = {name: len(_differences(first, second, name)) for name in shared}
    best = max(counts, key=lambda name: counts[name], default="")
    if best and counts[best] >= _MIN_EQUAL:
        return _by_messages(first, second, best)
    reasons = []
    for what in _common_motions(first, second):
        try:
            return _by_motion(first, second, what)
        except RecordingError as error:
            reasons.append(str(error))
    reason = f"; {reasons[0]}" if reasons else ""
    raise RecordingError(
        f"the recordings have no common evidence of a time offset: no topic has {_MIN_EQUAL} messages with stamps that "
        f"both received{reason}",
        hint="Name two frames of one body that turns: motion:map:base_link=world:camera.",
    )


def _have_stamps(topic: str, *recordings: Recording) -> bool:
    return all(
        topic in each.topics and (is_tf_message(each.topics[topic].type) or each.may_have_header(topic))
        for each in recordings
    )


def _common_motions(first: Recording, second: Recording) -> list[str]:
    """Return the moving edges that both recordings contain, as ``parent:child``."""
    edges = [
        {(edge.parent, edge.child) for edge in each.buffer.edges() if edge.parent and not edge.static}
        for each in (first, second)
    ]
    return [f"{parent}:{child}" for parent, child in sorted(edges[0] & edges[1]) if ":" not in parent + child]
