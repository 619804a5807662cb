# SPDX-License-Identifier: Apache-2.0
"""TF027: data that the report does not cover, because it exceeds the doctor's limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import duration, join_names
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF027"
_ADVICE = "Observe for a shorter --duration, or record with `coframe record` and examine the recording."


def find(observation: Observation) -> Iterator[Finding]:
    """Yield messages, topics and transforms that were not examined."""
    if observation.messages_ignored:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{observation.messages_ignored} messages were ignored, because they exceed the maximum number of "
            f"frame names",
            fix="Find the publisher that keeps creating frame names. This report covers only earlier messages.",
            harm="Every buffer grows with each new frame name, for as long as its process runs.",
        )
    if observation.topics_ignored:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"{observation.topics_ignored} topics were not examined, because they exceed the maximum number of "
            f"topics",
            fix="Find the node that keeps creating topics. This report covers only earlier topics.",
            harm="Every participant stores each announced topic, for as long as it is published.",
        )
    if observation.transforms_since:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"only the transforms of the last {duration(observation.end - observation.transforms_since)} were "
            "examined, because more exceed the memory limit",
            fix=_ADVICE,
            harm="This report does not contain problems that ended before that time.",
        )
    if observation.incomplete:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"some messages of {join_names(observation.incomplete)} were not examined, because they exceed the "
            f"memory limit",
            fix=_ADVICE,
            harm="This report does not contain problems with these messages.",
        )
