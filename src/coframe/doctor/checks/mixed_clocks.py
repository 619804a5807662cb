# SPDX-License-Identifier: Apache-2.0
"""TF009: stamps from several clocks in one system: the system clock, simulated time, or a clock that is days off."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import duration, join_names, seconds
from coframe.analysis.clocks import SAME_CLOCK
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import shift
from coframe.doctor.observation import Sensor
from coframe.time import HOUR, SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF009"
_FIX = (
    "In a simulation, start every node with --ros-args -p use_sim_time:=true; on a real robot, none, and synchronize "
    "the clocks of its machines (chronyc tracking). Replay a recording with its own clock (`coframe play BAG --clock`)."
)
_TIME_ZONE_FIX = (
    "The difference is a number of whole hours: check the node for a local time that is used as UTC, and the time zone "
    "of its machine."
)
_MAX_HOURS = 14  # The time zones of the world are up to 14 hours off UTC.
_MAX_OFFSETS = 4  # different offsets in one text
_KINDS = {"wall": ", the system clock", "simulated": ", simulated time"}


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding for every clock except the most used one, and a note for static transforms."""
    by_clock: dict[str, list[str]] = {}
    for name, clock in observation.clocks.items():
        by_clock.setdefault(clock, []).append(name)
    usual = observation.usual_clock
    for clock in sorted(by_clock.keys() - {usual}, key=lambda clock: (-len(by_clock[clock]), clock)):
        yield _make_finding(observation, usual, by_clock[usual], clock, by_clock[clock])
    if by_clock:
        yield from _find_static_offsets(observation, usual)


def _make_finding(
    observation: Observation, usual_clock: str, usual_names: list[str], clock: str, names: list[str]
) -> Finding:
    edges = [edge for edge in observation.dynamic if edge.name in names]
    sensors = [sensor for sensor in observation.sensors if sensor.topic in names]
    frames = {name for edge in edges for name in edge.key} | {sensor.frame for sensor in sensors}
    stamps = [edge.first_stamp for edge in edges] + [int(sensor.stamp[0]) for sensor in sensors]
    first = edges[0] if edges else None
    should_be_simulated = clock == "wall" and observation.clock is not None
    repairs, choices = _repair(observation, usual_clock, clock, [*edges, *sensors])
    return Finding(
        code=CODE,
        severity=Severity.ERROR,
        text=f"two clocks: the stamps of {_offsets(observation, names)} {_clock_name(usual_clock)} "
        f"({seconds(stamps[0])}"
        f"{_KINDS.get(clock, '')}), the clock of {join_names(usual_names)}",
        fix="Use one clock for all nodes. "
        + (
            "Start these nodes with --ros-args -p use_sim_time:=true."
            if should_be_simulated
            else _TIME_ZONE_FIX
            if _is_whole_hours(observation.offset(names[0]).offset)
            else _FIX
        ),
        edge=first.key if first else None,
        edges=tuple(edge.key for edge in edges),
        topic="" if first else sensors[0].topic,
        frames=frozenset(frames),
        first_stamp=stamps[0],
        publishers=publishers_of(edges),
        repairs=repairs,
        choices=choices,
    )


def _repair(
    observation: Observation, usual_clock: str, clock: str, wrong_items: list[Edge | Sensor]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the rules that repair the stamps: with /clock, or by a number of hours; else shifts to choose from."""
    if observation.clock is not None and {usual_clock, clock} == {"wall", "simulated"}:
        return (f"clock {'sim' if usual_clock == 'simulated' else 'wall'}",), ()
    named = [(one, one.topic if isinstance(one, Sensor) else one.name) for one in wrong_items]
    offsets = [(one, observation.offset(name).offset) for one, name in named]
    rules = tuple(shift(one.topic if isinstance(one, Sensor) else one.key, offset) for one, offset in offsets)
    return (rules, ()) if all(_is_whole_hours(offset) for _, offset in offsets) else ((), rules)


def _find_static_offsets(observation: Observation, usual_clock: str) -> Iterator[Finding]:
    """Yield a note for static transforms: tf2 ignores their stamps, but their publishers use another clock."""
    moving_edges = [edge for edge in observation.dynamic if observation.clocks.get(edge.name) == usual_clock]
    if not moving_edges or usual_clock == "wall":
        return
    low = min(int(edge.stamp.min()) for edge in moving_edges)
    high = max(int(edge.stamp.max()) for edge in moving_edges)
    edges = [
        edge
        for edge in observation.static
        if ((edge.stamp > high + SAME_CLOCK) | ((edge.stamp != 0) & (edge.stamp < low - SAME_CLOCK))).any()
    ]
    zero = sum(int((edge.stamp == 0).all()) for edge in observation.static)
    if edges:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"the stamps of {len(edges)} of {len(observation.static)} static transforms use a different clock "
            f"from /tf ({seconds(edges[0].first_stamp)}, {duration(abs(edges[0].first_stamp - high))} off), "
            f"{zero} have the stamp 0; tf2 ignores the stamps of static transforms",
            fix="Start their publishers with --ros-args -p use_sim_time:=true, like the other nodes.",
            harm="A static transform is valid for all times, regardless of its stamp. But its publisher uses another "
            "clock than the other nodes, and its other messages will not match theirs.",
            edge=edges[0].key,
            edges=tuple(edge.key for edge in edges),
            frames=frozenset(edge.child for edge in edges),
            first_stamp=edges[0].first_stamp,
            publishers=publishers_of(edges),
        )


def _offsets(observation: Observation, names: list[str]) -> str:
    """Return names with how far their stamps are off, as a clause; names with the same offset are joined."""
    by_offset: dict[tuple[str, str], list[str]] = {}
    for name in names:
        offset = observation.offset(name)
        by_offset.setdefault((offset.size, offset.direction), []).append(name)
    pairs = list(by_offset.items())
    shown = [*pairs[: _MAX_OFFSETS - 1], pairs[-1]] if len(pairs) > _MAX_OFFSETS else pairs
    last = shown[-1][0][1]
    parts = [
        f"{join_names(same)} {'are ' if number == 0 else ''}{size}"
        + (f" {direction}" if direction != last or number + 1 == len(shown) else "")
        for number, ((size, direction), same) in enumerate(shown)
    ]
    return ", those of ".join(parts)


def _is_whole_hours(offset: float) -> bool:
    hours = round(abs(offset) / HOUR)
    return 1 <= hours <= _MAX_HOURS and abs(abs(offset) - hours * HOUR) < SECOND


def _clock_name(clock: str) -> str:
    return {"wall": "the system clock", "simulated": "simulated time"}.get(
        clock, "a clock that differs from the system clock"
    )
