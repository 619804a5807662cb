"""TF008: stamps that are ahead of the clock, or far behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF008"
_MS = 1_000_000
_AHEAD = 20 * _MS
_BEHIND = 500 * _MS
# Localization tells map -> odom ahead of time, by its transform_tolerance.
_TOLERANCE = 2_000 * _MS
_LEAST = 5


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a moving link, and one a sensor whose stamps are not set."""
    for edge in observation.dynamic:
        lags = observation.lags(edge.stamp, edge.arrived)
        if lags is None or edge.count < _LEAST:
            continue
        if np.mean(lags < -_AHEAD) > 0.05:
            yield _ahead(edge, lags)
        elif np.median(lags) > _BEHIND:
            yield _behind(edge, lags)
    for sensor in observation.sensors:
        unset = int(np.count_nonzero(sensor.stamp == 0))
        # A simulation begins at 0.
        if unset >= _LEAST and unset > 0.05 * len(sensor.stamp):
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{unset} of {len(sensor.stamp)} messages have the stamp 0: it was never set",
                fix="In the sensor's node: msg.header.stamp = self.get_clock().now().to_msg()",
                harm="tf2 reads the time 0 as the latest one: as if the sensor had measured where it is now.",
                topic=sensor.topic,
                frames=frozenset({sensor.frame}),
                first_stamp=0,
                publishers=(sensor.publisher,) if sensor.publisher else (),
            )


def _ahead(edge: Edge, lags: np.ndarray[tuple[int, ...], np.dtype[np.int64]]) -> Finding:
    most, middle = -int(lags.min()), -float(np.median(lags))
    usual = most <= _TOLERANCE and (edge.constant or edge.child.rpartition("/")[2] == "odom")
    row = int(np.argmax(lags < -_AHEAD))
    return Finding(
        code=CODE,
        severity=Severity.NOTE if usual else Severity.WARNING,
        text=f"{np.count_nonzero(lags < 0)} of {edge.count} stamps are ahead of the clock when they arrive, by up to "
        f"{duration(most)}, median {duration(middle)}"
        + ("; that is usual for localization and for mounts that are sent again and again" if usual else ""),
        fix="Nothing, if it is the localization's transform_tolerance or the period of an old "
        "static_transform_publisher."
        if usual
        else "Stamp with the time of the measurement: t.header.stamp = self.get_clock().now().to_msg(); on two "
        "machines, "
        "set their clocks right (chronyc tracking).",
        edge=edge.key,
        first_stamp=int(edge.stamp[row]),
        publishers=edge.publishers,
    )


def _behind(edge: Edge, lags: np.ndarray[tuple[int, ...], np.dtype[np.int64]]) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"arrives {duration(float(np.median(lags)))} after its stamp (median; at most "
        f"{duration(int(lags.max()))})",
        fix="Send the transform as soon as it is measured, with the measurement's stamp; on two machines, set their "
        "clocks right (chronyc tracking). Who needs it must wait as long: "
        f"lookup_transform(..., timeout=Duration(seconds={np.ceil(lags.max() / 1e8) / 10:g})).",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )
