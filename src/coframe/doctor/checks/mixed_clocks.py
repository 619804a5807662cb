"""TF009: stamps by several clocks in one system: the wall's, a simulation's, one of another day."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed
from coframe.formatting import duration, seconds

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF009"
_HOUR = 3_600_000_000_000


def find(observation: Observation) -> Iterator[Finding]:
    """One finding for every clock but the usual one, and a note for static transforms."""
    by_clock: dict[str, list[str]] = {}
    for name, clock in observation.clocks.items():
        by_clock.setdefault(clock, []).append(name)
    usual, *others = sorted(by_clock, key=lambda clock: (-len(by_clock[clock]), clock)) or [""]
    for clock in others:
        yield _finding(observation, usual, by_clock[usual], clock, by_clock[clock])
    if by_clock:
        yield from _statics(observation, usual)


def _finding(observation: Observation, usual: str, usual_names: list[str], clock: str, names: list[str]) -> Finding:
    edges = [edge for edge in observation.dynamic if f"{edge.parent} -> {edge.child}" in names]
    sensors = [sensor for sensor in observation.sensors if sensor.topic in names]
    frames = {name for edge in edges for name in edge.key} | {sensor.frame for sensor in sensors}
    stamps = [edge.first_stamp for edge in edges] + [int(sensor.stamp[0]) for sensor in sensors]
    first = edges[0] if edges else None
    wrong_is_wall = clock == "wall"
    return Finding(
        code=CODE,
        severity=Severity.ERROR,
        text=f"two clocks: {listed(names)} {'is' if len(names) == 1 else 'are'} stamped by {_called(clock)} "
        f"({seconds(stamps[0])}), {listed(usual_names)} by {_called(usual)}",
        fix="Let all nodes use one clock. "
        + (
            "Start these with --ros-args -p use_sim_time:=true."
            if wrong_is_wall and observation.clock is not None
            else "In a simulation start every node with --ros-args -p use_sim_time:=true; on a robot, none; replay a "
            "recording with its own clock (ros2 bag play --clock)."
        ),
        edge=first.key if first else None,
        topic="" if first else sensors[0].topic,
        frames=frozenset(frames),
        first_stamp=stamps[0],
        publishers=tuple(dict.fromkeys(name for edge in edges for name in edge.publishers)),
    )


def _statics(observation: Observation, usual: str) -> Iterator[Finding]:
    """Their stamps do not matter to tf2, but say that somebody does not use the simulation's time, or ran before."""
    moving = [edge for edge in observation.dynamic if observation.clocks[f"{edge.parent} -> {edge.child}"] == usual]
    if not moving or usual == "wall":
        return
    low = min(int(edge.stamp.min()) for edge in moving)
    high = max(int(edge.stamp.max()) for edge in moving)
    odd = [edge for edge in observation.static if ((edge.stamp > high + _HOUR) | _before(edge.stamp, low)).any()]
    zero = sum(int((edge.stamp == 0).all()) for edge in observation.static)
    if odd:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{len(odd)} of {len(observation.static)} static transforms are stamped by another clock than /tf "
            f"({seconds(odd[0].first_stamp)}, {duration(abs(odd[0].first_stamp - high))} off), {zero} with the "
            "stamp 0; harmless to tf2",
            fix="Start their publishers with --ros-args -p use_sim_time:=true, like the rest.",
            harm="A static transform holds at all times whatever its stamp; but its publisher has another clock than "
            "the rest, and whatever else it sends will not fit.",
            edge=odd[0].key,
            frames=frozenset(edge.child for edge in odd),
            first_stamp=odd[0].first_stamp,
            publishers=tuple(dict.fromkeys(name for edge in odd for name in edge.publishers)),
        )


def _before(
    stamp: np.ndarray[tuple[int, ...], np.dtype[np.int64]], low: int
) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    return np.asarray((stamp != 0) & (stamp < low - _HOUR))


def _called(clock: str) -> str:
    return {"wall": "the wall's clock", "simulated": "the simulation's clock"}.get(
        clock, "a clock hours off the wall's"
    )
