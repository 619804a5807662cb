# SPDX-License-Identifier: Apache-2.0
"""TF017: a recording without static transforms."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF017"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield a finding if there are several trees but no static transforms."""
    if observation.live or observation.static or len(observation.trees) < 2:
        return
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text="the recording has no static transforms, and the dynamic ones form "
        f"{len(observation.trees)} separate trees",
        fix="Record /tf_static too: `coframe record /tf /tf_static ...`; read a split recording as the whole folder, "
        "not one of its later files. With this recording, publish the static transforms during replay: "
        "`coframe static ...`, or start robot_state_publisher.",
        choices=("set-static FILE",),
    )
