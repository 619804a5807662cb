"""TF025: listeners that come too late: look-ups that fail again and again, messages that come in heaps."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import LogLine, Observation

__all__ = ["CODE", "find"]

CODE = "TF025"
_LEAST = 3
_STALL = 500_000_000
_NEXT = (
    "Ask for the latest: lookup_transform(target, source, rclpy.time.Time()), or wait for the time that is wanted: "
    "lookup_transform(target, source, stamp, timeout=Duration(seconds=0.1))."
)
# tf2's words, and the line to change.
_FAILURES = (
    (re.compile(r"would require extrapolation (?:into the future|at time)", re.IGNORECASE), _NEXT),
    (
        re.compile(r"would require extrapolation into the past", re.IGNORECASE),
        "Ask for a newer time, or keep more: tf2_ros.Buffer(cache_time=Duration(seconds=30)).",
    ),
    (
        re.compile(r"passed to lookupTransform argument \w+ does not exist", re.IGNORECASE),
        "Check the frame's spelling in lookup_transform(...); `coframe echo TARGET SOURCE` lists those that there are.",
    ),
    (
        re.compile(r"not part of the same tree|unconnected trees|could not find a connection", re.IGNORECASE),
        "Start the publisher of the missing link; TF001 and `coframe echo TARGET SOURCE` name it.",
    ),
)


def find(observation: Observation) -> Iterator[Finding]:
    """What nodes complain of, and heaps."""
    yield from _complaints(observation)
    if not observation.live:
        yield from _heaps(observation)


def _complaints(observation: Observation) -> Iterator[Finding]:
    """Look-ups that still fail when listening ends: at the start of a system some always do."""
    middle = observation.start + observation.duration // 2
    by_kind: dict[tuple[str, int], list[LogLine]] = {}
    for line in observation.log:
        for number, (pattern, _) in enumerate(_FAILURES):
            if pattern.search(line.text):
                by_kind.setdefault((line.node, number), []).append(line)
                break
    for (node, number), lines in by_kind.items():
        if len(lines) >= _LEAST and lines[-1].arrived > middle:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{node} complains {len(lines)} times, the last time: {_short(lines[-1].text)}",
                fix=f"In {node}: {_FAILURES[number][1]}",
                topic="/rosout",
                frames=frozenset(frame for frame in observation.frames if frame in _names(lines[-1].text)),
                publishers=(node,),
            )


def _heaps(observation: Observation) -> Iterator[Finding]:
    """All links silent at once, and then all that was sent meanwhile: the recorder did not come to listen."""
    edges = [edge for edge in observation.dynamic if edge.count > 10 and edge.period < _STALL / 5]
    if not edges:
        return
    arrived = np.sort(np.concatenate([edge.arrived for edge in edges]))
    stamps = np.concatenate([edge.stamp for edge in edges])[
        np.argsort(np.concatenate([edge.arrived for edge in edges]), kind="stable")
    ]
    pauses = np.flatnonzero(np.diff(arrived) > _STALL)
    for row in pauses.tolist():
        pause = int(arrived[row + 1] - arrived[row])
        # What came within a tenth of the pause after it was stamped over most of the pause.
        heap = stamps[row + 1 :][arrived[row + 1 :] < arrived[row + 1] + pause // 10]
        if len(heap) > 3 and int(heap.max() - heap.min()) > pause // 2:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"nothing came for {duration(pause)}, and then {len(heap)} transforms at once that had been sent "
                "meanwhile: the recorder, or the network to it, was held up",
                fix="Record less (ros2 bag record /tf /tf_static ...), to a faster disk, or with a larger cache "
                "(--max-cache-size); look-ups by receipt time are wrong there, by stamp they are right.",
                first_stamp=int(heap.min()),
            )
            return


def _names(text: str) -> set[str]:
    return set(re.findall(r"[\w/.-]+", text))


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 160 else f"{line[:157]}..."
