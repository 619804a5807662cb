"""TF017: a recording without its static transforms."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF017"


def find(observation: Observation) -> Iterator[Finding]:
    """Where moving transforms do not make one tree and there are no static ones at all."""
    if observation.live or observation.static or len(observation.trees) < 2:
        return
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"no static transform was recorded, and the moving ones make {len(observation.trees)} separate trees",
        fix="Record /tf_static as well: ros2 bag record /tf /tf_static ...; of a split "
        "recording read "
        "the whole folder, not a later file alone. For this one, send the mounts beside it while it is played: "
        "coframe static ..., or start its robot_state_publisher.",
    )
