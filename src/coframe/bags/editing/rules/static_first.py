# SPDX-License-Identifier: Apache-2.0
"""The rule ``static-first``: static transforms that come late are also written at the beginning."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.editing._rule import Insertion, Rule
from coframe.bags.editing._transform_bytes import join_transforms

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.bags.editing._message import EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import FoundTransform, Survey

__all__ = ["StaticFirst"]


class StaticFirst(Rule):
    """``static-first``: write static transforms first, so that lookups before their arrival succeed."""

    name = "static-first"
    form = ""
    unit = "transform"
    verb = "also written at the beginning"

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self._late_statics: dict[tuple[str, bytes], list[FoundTransform]] = {}

    def prepare(self, survey: Survey) -> None:
        """Find the static transforms that come late."""
        for transform in survey.static_transforms():
            if transform.received > survey.span[0]:
                self._late_statics.setdefault((transform.topic, transform.header), []).append(transform)

    def step(self, topic: EditedTopic) -> Step | None:
        """Return None, because the recorded messages are not changed."""
        del topic
        return None

    def insertions(self) -> Iterator[Insertion]:
        """Yield the messages to add."""
        for (topic, header), found in self._late_statics.items():
            self.changes += len(found)
            for transform in found:
                transform.transform.parent, transform.transform.child = (
                    transform.parent.encode(),
                    transform.child.encode(),
                )
            yield Insertion(topic, join_transforms([transform.transform for transform in found], header))
