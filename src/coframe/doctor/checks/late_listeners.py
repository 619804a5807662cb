# SPDX-License-Identifier: Apache-2.0
"""TF025: slow listeners, with lookups that keep failing or messages received in bursts."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration
from coframe.doctor._finding import Finding, Severity
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation, ObservedLogLine

__all__ = ["CODE", "find", "lookup_advice"]

CODE = "TF025"
_MIN_TRANSFORMS = 3
_MIN_PAUSE = 500 * MILLISECOND
_WAIT = (
    "Request the latest transform: lookup_transform(target, source, rclpy.time.Time()), or wait for the requested "
    "time: lookup_transform(target, source, stamp, timeout=Duration(seconds=0.1))."
)
# Messages of tf2, and the line to change.
_KNOWN_FAILURES = (
    (re.compile(r"would require extrapolation (?:into the future|at time)", re.IGNORECASE), _WAIT),
    (
        re.compile(r"would require extrapolation into the past", re.IGNORECASE),
        "Request a newer time, or use a longer cache: tf2_ros.Buffer(cache_time=Duration(seconds=30)).",
    ),
    (
        re.compile(r"passed to lookupTransform argument \w+ does not exist", re.IGNORECASE),
        "Check the spelling of the frame in lookup_transform(...); `coframe echo TARGET SOURCE` lists the frames.",
    ),
    (
        re.compile(r"not part of the same tree|unconnected trees|could not find a connection", re.IGNORECASE),
        "Start the publisher of the missing transform; TF001 and `coframe echo TARGET SOURCE` name it.",
    ),
)


def find(observation: Observation) -> Iterator[Finding]:
    """Yield the errors that nodes log, and in recordings bursts of messages."""
    yield from _logged_errors(observation)
    if not observation.live:
        yield from _bursts(observation)


def lookup_advice(text: str) -> str:
    """Return what to do about a failed lookup, given the text of tf2's exception, or "" if it is not known."""
    return next((advice for pattern, advice in _KNOWN_FAILURES if pattern.search(text)), "")


def _logged_errors(observation: Observation) -> Iterator[Finding]:
    """Yield lookups that still fail at the end; during startup, some lookups always fail."""
    middle = observation.start + observation.duration // 2
    by_kind: dict[tuple[str, int], list[ObservedLogLine]] = {}
    for line in observation.log:
        for number, (pattern, _) in enumerate(_KNOWN_FAILURES):
            if pattern.search(line.text):
                by_kind.setdefault((line.node, number), []).append(line)
                break
    for (node, number), lines in by_kind.items():
        if len(lines) >= _MIN_TRANSFORMS and lines[-1].arrived > middle:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{node} logged {len(lines)} failed lookups, the last one: {_truncate(lines[-1].text)}",
                fix=f"In {node}: {_KNOWN_FAILURES[number][1]}",
                topic="/rosout",
                frames=frozenset(frame for frame in observation.frames if frame in _names(lines[-1].text)),
                publishers=(node,),
            )


def _bursts(observation: Observation) -> Iterator[Finding]:
    """Yield a simultaneous pause of all edges followed by a burst of the delayed messages: the recorder was blocked."""
    edges = [edge for edge in observation.dynamic if edge.count > 10 and edge.period < _MIN_PAUSE / 5]
    if not edges:
        return
    arrival_times = np.sort(np.concatenate([edge.arrived for edge in edges]))
    stamps = np.concatenate([edge.stamp for edge in edges])[
        np.argsort(np.concatenate([edge.arrived for edge in edges]), kind="stable")
    ]
    pauses = np.flatnonzero(np.diff(arrival_times) > _MIN_PAUSE)
    for row in pauses.tolist():
        pause = int(arrival_times[row + 1] - arrival_times[row])
        # The stamps of the messages that arrive within a tenth of the pause after it cover most of the pause.
        burst = stamps[row + 1 :][arrival_times[row + 1 :] < arrival_times[row + 1] + pause // 10]
        if len(burst) > 3 and int(burst.max() - burst.min()) > pause // 2:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"no transform was received for {duration(pause)}, followed by a burst of {len(burst)} "
                f"transforms that "
                "had been published in the meantime: the recorder or its network connection was blocked",
                fix="Record fewer topics (`coframe record /tf /tf_static ...`), or use a faster disk. In this part "
                "of the recording, lookups by receive time are wrong; lookups by stamp are correct.",
                first_stamp=int(burst.min()),
            )
            return


def _names(text: str) -> set[str]:
    return set(re.findall(r"[\w/.-]+", text))


def _truncate(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 160 else f"{line[:157]}..."
