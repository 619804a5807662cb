# SPDX-License-Identifier: Apache-2.0
"""The axes of optical frames: the view direction of a camera, and corrections of impossible mounts.

By REP-103, the z axis of an optical frame points forward, its x axis to the right and its y axis down in the image.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.analysis.missing_edges import is_base_frame
from coframe.doctor.pose_mistakes import OPTICAL_ROTATION, Correction, corrections, explain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["WrongAxes", "is_optical", "optical_frame_below", "wrong_axes"]

_MAX_TILT_SINE = np.sin(np.radians(10.0))
_MIN_ALIGNED_COSINE = np.cos(np.radians(25.0))
_MIN_ROLLED_SINE = np.sin(np.radians(30.0))
_MAX_UNROTATED_ANGLE = np.radians(10.0)  # how far calibrated cameras are off the axes of their robot
_MAX_ALIGNMENT_ERROR = 0.1  # of an axis of one frame in another, at most this much off 0 or 1
_MAX_ANGLE_ERROR = np.radians(3.0)
_NAMED_SIDES = (("rear|back|aft", 3), ("left", 1), ("right", 4))  # words in names, and the index of the direction
_DIRECTIONS = ("forward", "left", "up", "backward", "right", "down")
_MAX_CANDIDATES = 2
_TOOL_NAMES = re.compile("tool|flange|gripper|hand|effector|tcp|wrist")
_TYPED_STEPS = (1e-3, np.radians(0.1))
_MAX_TYPED_ERROR = 2e-6  # radians
_MIN_REORDERED_ANGLE = np.radians(0.3)


class WrongAxes(NamedTuple):
    """An optical frame with impossible axes.

    Attributes:
        edge: The edge whose correction makes them right, or the edge above the frame.
        text: Which way the axes point, and what would make them right.
        fix: What to do.
        pose: The pose of the edge that makes them right, (7,).
    """

    edge: Edge
    text: str
    fix: str
    pose: NDArray[np.float64]


def is_optical(observation: Observation, edge: Edge) -> bool:
    """Return whether an edge leads to the optical frame of a camera, from a frame that is not optical."""
    return _is_optical_frame(observation, edge.child) and not _is_optical_frame(observation, edge.parent)


def _is_optical_frame(observation: Observation, frame: str) -> bool:
    if "optical" in frame.lower():
        return True
    return _camera_topic(observation, frame) is not None and optical_frame_below(observation, frame) is None


def _camera_topic(observation: Observation, frame: str) -> str | None:
    """Return the topic of a CameraInfo in a frame, which is optical by definition."""
    return next((camera.topic for camera in observation.cameras if camera.frame == frame), None)


def optical_frame_below(observation: Observation, frame: str) -> str | None:
    """Return the optical frame of a camera's body, or None if a frame is not the body of a camera."""
    below = (edge.child for edge in observation.last.values() if edge.parent == frame)
    return next((child for child in below if "optical" in child.lower() and _is_body_of(frame, child)), None)


def _optical_name(observation: Observation, frame: str) -> str:
    """Return why a frame is optical, as the beginning of a sentence."""
    if "optical" in frame.lower():
        return f"{frame!r} is named optical"
    return f"{frame!r} is the frame of {_camera_topic(observation, frame)}, and therefore optical"


def wrong_axes(observation: Observation, edge: Edge) -> WrongAxes | None:
    """Return what is wrong with the axes of an optical frame, or None if a camera can be mounted in this way."""
    if _is_body_of(edge.parent, edge.child):
        return _check_rep103_rotation(observation, edge) or _optical_values_for_the_body(observation, edge)
    chain = [edge] if is_base_frame(edge.parent) else [edge, *observation.mounts(edge.parent)]
    turn = _chain_rotation(chain, None)
    if not is_base_frame(chain[-1].parent):
        return None
    sides = _possible_sides(edge.child)
    right, down, forward = _axes(turn)
    if _angle(turn, _IDENTITY) < _MAX_UNROTATED_ANGLE:
        return _unrotated_frame(observation, edge)
    if sides != _FORWARD_ONLY and forward[2] > np.cos(_MAX_UNROTATED_ANGLE) and _looks_to(sides, right) is not None:
        return _find_corrected_edge(observation, chain, turn)  # The axes are those of the body.
    is_rolled = abs(right[2]) > _MIN_ROLLED_SINE or down[2] > _MAX_TILT_SINE
    if is_rolled:
        is_possible = any(_side(side) @ forward > _MIN_ROLLED_SINE for side in sides)
        return None if is_possible else _find_corrected_edge(observation, chain, turn)
    return _with_round_angles(edge)


_FORWARD_ONLY = (0,)


def _possible_sides(frame: str) -> tuple[int, ...]:
    """Return the sides to which a camera looks by its name; the left camera of a stereo pair also looks forward."""
    named = tuple(side for words, side in _NAMED_SIDES if re.search(words, frame.lower()))
    return named if 3 in named else (*named, 0)


def _looks_to(sides: Sequence[int], forward: NDArray[np.float64]) -> int | None:
    """Return the side to which a camera looks, or None if it is none of them."""
    return next((side for side in sides if _side(side) @ forward > _MIN_ALIGNED_COSINE), None)


def _side(index: int) -> NDArray[np.float64]:
    """Return the unit vector of one of the directions."""
    return np.asarray(np.eye(3)[index % 3] * (1.0 if index < 3 else -1.0))


def _optical_values_for_the_body(observation: Observation, edge: Edge) -> WrongAxes | None:
    """Return a mount of a camera's body whose rotation is that of its optical frame.

    On a robot, the camera is upright and looks ahead if the rotation is that of the optical frame. On a gripper, it
    looks along the axis of the tool.
    """
    # Drivers publish further frames of one camera, such as camera_color_frame, which are not rotated.
    mounts = observation.mounts(edge.parent)
    above = next((each for each in mounts if each.angle > _MAX_UNROTATED_ANGLE), None)
    if above is None:
        return None
    own = above.rotations[-1]
    if is_base_frame(above.parent):
        right, down, forward = _axes(own)
        is_upright = abs(right[2]) < _MAX_TILT_SINE and down[2] < -_MIN_ALIGNED_COSINE
        meant = bool(is_upright and abs(forward[2]) < _MIN_ROLLED_SINE)
    elif _TOOL_NAMES.search(above.parent.lower()):
        meant = bool(_axes(own)[2][2] > _MIN_ALIGNED_COSINE and _angle(own, _IDENTITY) > _MAX_UNROTATED_ANGLE)
        meant = meant and abs(float(_axes(quaternion.multiply(own, OPTICAL_ROTATION))[2][2])) < _MIN_ROLLED_SINE
    else:
        return None
    if not meant:
        return None
    rotation = quaternion.multiply(own, quaternion.inverse(OPTICAL_ROTATION))
    text = (
        f"{above.child!r} is the body of a camera, and is rotated like its optical frame {edge.child!r}: with the "
        "rotation to the optical frame, the camera looks sideways"
    )
    fix = f"The values are those of {edge.child!r}: remove the rotation of optical frames (REP-103) from them."
    return WrongAxes(above, text, fix, np.concatenate([above.values[-1, :3], rotation]))


def _with_round_angles(edge: Edge) -> WrongAxes | None:
    """Return a mount whose angles are round only with the numbers of its quaternion in another order.

    Near the axes of an optical frame all four numbers are alike, so that another order is hardly another rotation: only
    angles that were typed show it.
    """
    turn = edge.rotations[-1]
    if _has_round_angles(turn):
        return None
    for shift, reading in ((-1, "is read as w, x, y, z"), (1, "x, y, z, w was passed as w, x, y, z")):
        other = np.roll(turn, shift)
        if _has_round_angles(other) and _angle(turn, other) > _MIN_REORDERED_ANGLE:
            roll, pitch, yaw = (f"{value + 0.0:.4g}" for value in _body_angles(other))
            text = (
                f"the rotation of {edge.child!r} is {np.degrees(_angle(turn, other)):.3g} degrees from one with round "
                f"angles: roll {roll}, pitch {pitch}, yaw {yaw} degrees of the body if its quaternion {reading}"
            )
            fix = "A quaternion of ROS is x, y, z, w: set rotation.w from the scalar."
            return WrongAxes(edge, text, fix, np.concatenate([edge.values[-1, :3], other]))
    return None


def _body_angles(turn: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return roll, pitch and yaw in degrees of the body of a camera whose optical frame has a rotation."""
    angles = quaternion.to_rpy(quaternion.multiply(turn, quaternion.inverse(OPTICAL_ROTATION)))
    return np.asarray(np.round(np.degrees(angles), 6))


def _has_round_angles(turn: NDArray[np.float64]) -> bool:
    """Return whether the angles of a camera's body were typed: steps of 0.001 radians, or of 0.1 degrees."""
    angles = quaternion.to_rpy(quaternion.multiply(turn, quaternion.inverse(OPTICAL_ROTATION)))
    return any(bool((np.abs(angles / step - np.round(angles / step)) * step < _MAX_TYPED_ERROR).all())
               for step in _TYPED_STEPS)  # fmt: skip


_IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])


def _is_body_of(parent: str, child: str) -> bool:
    """Return whether two names are those of the body and the optical frame of one camera."""
    generic = {"link", "frame", "optical", ""}
    words = [set(re.split(r"[_/. -]|(?<=[a-z])(?=[A-Z])", name.lower())) - generic for name in (parent, child)]
    return words[0] == words[1] and bool(words[0])


def _check_rep103_rotation(observation: Observation, edge: Edge) -> WrongAxes | None:
    """Return what is wrong with the optical frame of a camera's body, whose rotation REP-103 defines."""
    turn = edge.rotations[-1]
    if _angle(turn, OPTICAL_ROTATION) < 2.0 * _MAX_UNROTATED_ANGLE:
        return None
    if _angle(turn, _IDENTITY) < _MAX_UNROTATED_ANGLE:
        return _unrotated_frame(observation, edge)
    zero = np.zeros(3)
    published, expected = (np.concatenate([zero, each])[None] for each in (turn, OPTICAL_ROTATION))
    found = explain(published, expected, radians=_MAX_ANGLE_ERROR)
    matrix = quaternion.to_matrix(turn)
    is_aligned = bool((np.abs(np.abs(matrix) - np.round(np.abs(matrix))) < _MAX_ALIGNMENT_ERROR).all())
    if found is None and not is_aligned:
        return None
    reading = f"; the rotation agrees with REP-103 if {found.reading}" if found else ""
    text = f"{_describe_axes(observation, edge, turn)}{reading}"
    return WrongAxes(edge, text, found.fix if found else "", np.concatenate([edge.values[-1, :3], OPTICAL_ROTATION]))


def _unrotated_frame(observation: Observation, edge: Edge) -> WrongAxes:
    text = (
        f"{_optical_name(observation, edge.child)}, but is not rotated relative to {edge.parent!r}: its z axis points "
        "up instead of forward"
    )
    turn = quaternion.multiply(edge.rotations[-1], OPTICAL_ROTATION)
    return WrongAxes(edge, text, "", np.concatenate([edge.values[-1, :3], turn]))


def _find_corrected_edge(
    observation: Observation, chain: Sequence[Edge], turn: NDArray[np.float64]
) -> WrongAxes | None:
    """Return the first edge and the corrections with which the camera is upright and looks forward."""
    sides = _possible_sides(chain[0].child)
    for edge in chain:
        found: dict[int, dict[str, Correction]] = {}
        for correction in corrections(np.concatenate([edge.values[-1, :3], edge.rotations[-1]])):
            right, down, forward = _axes(_chain_rotation(chain, (edge, correction.pose[3:])))
            side = _looks_to(sides, forward)
            if side is not None and abs(right[2]) < _MAX_TILT_SINE and down[2] < -_MIN_ALIGNED_COSINE:
                found.setdefault(side, {}).setdefault(correction.reading, correction)
        for side in sides:
            if side in found:
                first, *_ = found[side].values()
                readings = " or ".join(f"if {reading}" for reading in list(found[side])[:_MAX_CANDIDATES])
                axes = _describe_axes(observation, chain[0], turn, side)
                text = f"{axes}; the camera is upright and looks {_DIRECTIONS[side]} {readings}"
                return WrongAxes(edge, text, first.fix, first.pose)
    return None


def _chain_rotation(chain: Sequence[Edge], changed: tuple[Edge, NDArray[np.float64]] | None) -> NDArray[np.float64]:
    """Return the rotation from the upper end of a chain to its lower end, with another rotation of one edge."""
    turn = _IDENTITY
    for edge in reversed(chain):
        own = changed[1] if changed is not None and edge is changed[0] else edge.rotations[-1]
        turn = quaternion.multiply(turn, own)
    return turn


def _axes(turn: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the x, y and z axis of a frame, one row each."""
    return np.asarray(quaternion.to_matrix(turn).T)


def _angle(first: NDArray[np.float64], second: NDArray[np.float64]) -> float:
    return float(2.0 * np.arccos(min(1.0, abs(float(first @ second)))))


def _describe_axes(observation: Observation, edge: Edge, turn: NDArray[np.float64], side: int = 0) -> str:
    """Return which way the axes of an optical frame point instead of those of a camera that looks to a side."""
    right, _, forward = (_direction(axis) for axis in _axes(turn))
    on_its_right = _direction(np.cross(_side(side), [0.0, 0.0, 1.0]))
    wrong = [
        f"its {axis} axis points {direction} instead of {expected}"
        for axis, direction, expected in (("z", forward, _DIRECTIONS[side]), ("x", right, on_its_right))
        if direction != expected
    ]
    return f"{_optical_name(observation, edge.child)}, but {' and '.join(wrong) or 'its axes are tilted'}"


def _direction(axis: NDArray[np.float64]) -> str:
    largest = int(np.argmax(np.abs(axis)))
    return _DIRECTIONS[largest if axis[largest] > 0 else largest + 3]
