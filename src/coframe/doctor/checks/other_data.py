# SPDX-License-Identifier: Apache-2.0
"""TF029: transforms that other data contradicts: gravity, an odometry topic, and the points of a lidar."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.static_command import static_command
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._mount_evidence import gravity_contradictions, points_contradictions
from coframe.doctor._odometry_evidence import odometry_contradictions
from coframe.doctor._rules import replace_mount

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF029"
# Radians. Data hardly shows whether the position of a mount without a rotation is wrong, so that users have to decide.
_TURNED = 1e-3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings only where a common mistake makes the transform agree with the other data."""
    for found in (*gravity_contradictions(observation), *points_contradictions(observation)):
        rule = replace_mount(found.edge.child, np.round(found.pose, 9))
        command = static_command(*found.edge.key, np.round(found.pose, 9).tolist())
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=found.text,
            fix=f"{found.fix} Then the mount is `{command}`.",
            edge=found.edge.key,
            topic="",
            first_stamp=found.edge.first_stamp,
            publishers=found.edge.publishers,
            repairs=(rule,) if found.edge.angle > _TURNED else (),
            choices=(rule,) if found.edge.angle <= _TURNED else (),
        )
    for edge, text, fix in odometry_contradictions(observation):
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=text,
            fix=fix,
            edge=edge.key,
            first_stamp=edge.first_stamp,
            publishers=edge.publishers,
        )
