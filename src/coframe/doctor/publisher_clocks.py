# SPDX-License-Identifier: Apache-2.0
"""The clock of each moving edge and each sensor: the offset of its stamps from their arrival, and its drift."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor.observation import Observation

__all__ = ["PublisherClock", "publisher_clocks"]


class PublisherClock(NamedTuple):
    """The stamps of one moving edge, or of one topic of sensor data.

    Attributes:
        name: The edge, such as ``odom -> base_link``, or the topic.
        publishers: The full names of the nodes that set the stamps, as far as they are known.
        clock: ``wall``, ``simulated``, or ``other 1`` and so on for clocks that are hours off both.
        offset: How far the stamps are behind the usual clock on arrival, with spread and drift.
        arrived: (N,) times of arrival in nanoseconds.
        delays: (N,) seconds from stamp to arrival, on the clock of the stamps if it is simulated time.
    """

    name: str
    publishers: tuple[str, ...]
    clock: str
    offset: ClockOffset
    arrived: NDArray[np.int64]
    delays: NDArray[np.float64]


def publisher_clocks(observation: Observation) -> list[PublisherClock]:
    """Return the clocks of an observation, the largest offset first; edges and topics without stamps are left out."""
    rows = {edge.name: (edge.publishers, edge.stamp, edge.arrived) for edge in observation.dynamic}
    rows |= {sensor.topic: (sensor.publishers, sensor.stamp, sensor.arrived) for sensor in observation.sensors}
    found = []
    for name, clock in observation.clocks.items():
        publishers, stamp, arrival_times = rows[name]
        arrival_times, stamp = arrival_times[stamp != 0], stamp[stamp != 0]
        lags = observation.lags(stamp, arrival_times)
        delays = np.asarray(arrival_times - stamp if lags is None else lags) / 1e9
        found.append(PublisherClock(name, publishers, clock, observation.offset(name), arrival_times, delays))
    return sorted(found, key=lambda each: -abs(each.offset.offset))
