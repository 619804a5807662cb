# SPDX-License-Identifier: Apache-2.0
"""Measurement: the contents of a recording or a running system that a contract refers to."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from coframe.bags import from_yaml
from coframe.bags.namespaces import ALL_TRANSFORMS
from coframe.doctor.recorded import observe_chosen
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe._sources.sources import Location
    from coframe.bags import Recording
    from coframe.bags.namespaces import TransformChoice
    from coframe.connection.listener_config import ListenerConfig
    from coframe.doctor.observation import Observation

__all__ = ["MeasuredTopic", "Measurement", "Pace", "measure_live", "measure_recording", "pace_of"]


@dataclass(frozen=True)
class Pace:
    """How regularly something was published.

    Attributes:
        messages: The number of messages.
        rate: Messages per second from the first one to the last one, or None for fewer than two.
        max_gap: The longest time between two messages, and from the last one to the end, in nanoseconds, or None if
            it is unknown.
        median: The median time between two messages, or None for fewer than two.
    """

    messages: int
    rate: float | None = None
    max_gap: int | None = None
    median: int | None = None


@dataclass(frozen=True)
class MeasuredTopic:
    """A topic, its pace, the frame of its messages, and the QoS of all its publishers. Unknown values are None.

    The frame is that of the first message, and "" if the message names none.
    """

    name: str
    type: str
    pace: Pace
    frame: str | None
    reliable: bool | None
    transient_local: bool | None


@dataclass(frozen=True)
class Measurement:
    """The observations by namespace, and the topics by name."""

    observations: dict[str, Observation]
    topics: dict[str, MeasuredTopic]


def measure_recording(
    path: Location,
    choice: TransformChoice = ALL_TRANSFORMS,
    *,
    progress: Callable[[int, int], object] | None = None,
) -> Measurement:
    """Measure a recording.

    Args:
        path: A file, the folder of a rosbag2 recording, or its URL.
        choice: The transforms to read, and the prefix of their frames.
        progress: Called repeatedly with the number of bytes read and the total number.

    Raises:
        RecordingError: The recording cannot be read.
    """
    topics: dict[str, MeasuredTopic] = {}
    observations = observe_chosen(
        path, choice, progress=progress, examine=lambda recording: topics.update(_recorded_topics(recording))
    )
    return Measurement(observations, topics)


def measure_live(config: ListenerConfig, seconds: float, topics: Iterable[str]) -> Measurement:
    """Measure the running system.

    Args:
        config: The topics of the transforms, and the domain.
        seconds: The duration of the measurement.
        topics: The names of the topics of the contract, whose messages are counted.

    Raises:
        WireError: The graph cannot be joined.
    """
    from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - recordings need no middleware

    with LiveObserver(config, also=tuple(topics)) as observer:
        observer.listen(seconds)
        observer.listen_for_statics()
        observation = observer.observe()
        end = time.time_ns()
        arrivals: dict[str, list[NDArray[np.int64]]] = {}
        for sensor in observation.sensors:
            arrivals.setdefault(sensor.topic, []).append(sensor.arrived)
        measured = {}
        for name, facts in observation.topics.items():
            pace = Pace(facts.messages, facts.messages * SECOND / facts.observed if facts.observed else None)
            if name in arrivals:
                pace = pace_of(np.sort(np.concatenate(arrivals[name])), end)
            offers = [(one.reliable, one.transient_local) for one in observer.publishers(name)]
            measured[name] = MeasuredTopic(name, facts.type, pace, None, *_common(offers))
    return Measurement({"": observation}, measured)


def pace_of(arrival_times: NDArray[np.int64], end: int) -> Pace:
    """Return the pace of messages from their arrival times, (N,) sorted, until an end."""
    if not len(arrival_times):
        return Pace(0)
    steps = np.diff(arrival_times)
    max_gap = int(max(steps.max(initial=0), end - arrival_times[-1]))
    if not len(steps) or arrival_times[-1] == arrival_times[0]:
        return Pace(len(arrival_times), None, max_gap)
    return Pace(
        len(arrival_times),
        len(steps) * SECOND / int(arrival_times[-1] - arrival_times[0]),
        max_gap,
        int(np.median(steps)),
    )


def _recorded_topics(recording: Recording) -> dict[str, MeasuredTopic]:
    offered_qos: dict[str, list[tuple[bool, bool]]] = {}
    for channel in recording.channels():
        for each in from_yaml(channel.offered_qos):
            offered_qos.setdefault(channel.topic, []).append((each.reliable, each.transient_local))
    end = recording.received_end
    return {
        name: MeasuredTopic(
            name,
            topic.type,
            pace_of(np.sort(recording.received(name)), end),
            recording.frame(recording.first_frame(name).lstrip("/")),
            *_common(offered_qos.get(name, [])),
        )
        for name, topic in recording.topics.items()
    }


def _common(offers: list[tuple[bool, bool]]) -> tuple[bool | None, bool | None]:
    """Return whether all publishers are reliable, and whether all are transient local."""
    if not offers:
        return None, None
    return all(reliable for reliable, _ in offers), all(latched for _, latched in offers)
