# SPDX-License-Identifier: Apache-2.0
"""TF008: stamps that are ahead of the clock or far behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import shift
from coframe.doctor.wrong_stamps import MIN_LEAD, MIN_MESSAGES, is_ahead, is_ahead_by_design, is_behind
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF008"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per dynamic edge, and one per sensor whose stamps were never set."""
    starts_at_zero = observation.clock is not None and bool((observation.clock.stamp == 0).any())
    for edge in observation.dynamic:
        if edge.is_unset and not starts_at_zero:
            yield _unset_stamps(edge)
            continue
        lags = observation.lags(edge.stamp, edge.arrived)
        if lags is None or edge.count < MIN_MESSAGES:
            continue
        if is_ahead(lags):
            yield _stamps_ahead(edge, lags, observation.offset(edge.name))
        elif is_behind(lags):
            yield _stamps_behind(edge, lags, observation.offset(edge.name))
    for sensor in observation.sensors:
        unset = int(np.count_nonzero(sensor.stamp == 0))
        # A few stamps of 0 are normal, because simulations begin at 0.
        if unset >= MIN_MESSAGES and unset > 0.05 * len(sensor.stamp):
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"the stamp was never set: {unset} of {len(sensor.stamp)} messages have the stamp 0",
                fix="In the node of the sensor, add the line: msg.header.stamp = self.get_clock().now().to_msg()",
                harm="tf2 interprets time 0 as the latest: the data is transformed with the pose at the time of the "
                "lookup, not of the measurement.",
                topic=sensor.topic,
                frames=frozenset({sensor.frame}),
                first_stamp=0,
                publishers=(sensor.publisher,) if sensor.publisher else (),
            )


def _unset_stamps(edge: Edge) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"the stamp was never set: {edge.unset_count} of {edge.count} transforms have the stamp 0",
        fix="Add the line: t.header.stamp = self.get_clock().now().to_msg(). If the line exists, the node has "
        "use_sim_time:=true but no simulation publishes /clock, so its time stays 0.",
        harm="A transform with the stamp 0 belongs to the year 1970: lookups at now() or at the stamp of a sensor "
        "message fail, even with a long timeout.",
        edge=edge.key,
        first_stamp=0,
        publishers=edge.publishers,
    )


def _stamps_ahead(edge: Edge, lags: NDArray[np.int64], offset: ClockOffset) -> Finding:
    most = -int(lags.min())
    usual = is_ahead_by_design(edge, lags)
    row = int(np.argmax(lags < -MIN_LEAD))
    return Finding(
        code=CODE,
        severity=Severity.NOTE if usual else Severity.WARNING,
        text=f"{np.count_nonzero(lags < 0)} of {edge.count} stamps are ahead of the clock on arrival, by up to "
        f"{duration(most)}; the median is {offset.size} {offset.direction} the clock"
        + ("; this is usual for localization and for constant transforms that are repeated" if usual else ""),
        fix="No change is needed if this is the transform_tolerance of the localization or the period of an old "
        "static_transform_publisher."
        if usual
        else "Use the time of the measurement as stamp: t.header.stamp = self.get_clock().now().to_msg(). With several "
        "machines, synchronize their clocks (chronyc tracking).",
        edge=edge.key,
        first_stamp=int(edge.stamp[row]),
        publishers=edge.publishers,
        choices=() if usual else (shift(edge.key, offset.offset),),
    )


def _stamps_behind(edge: Edge, lags: NDArray[np.int64], offset: ClockOffset) -> Finding:
    timeout = np.ceil(lags.max() / (100 * MILLISECOND)) / 10
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"its stamps are {offset.size} {offset.direction} the clock on arrival, at most "
        f"{duration(int(lags.max()))}",
        fix="Publish the transform as soon as it is measured, with the stamp of the measurement; with several "
        "machines, synchronize their clocks (chronyc tracking). Consumers have to wait for it: "
        f"lookup_transform(..., timeout=Duration(seconds={timeout:g})).",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
        choices=(shift(edge.key, offset.offset),),
    )
