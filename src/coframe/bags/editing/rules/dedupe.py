# SPDX-License-Identifier: Apache-2.0
"""The rule ``dedupe``: messages and transforms that are recorded twice are left out once."""

from __future__ import annotations

from collections import OrderedDict
from hashlib import blake2b
from typing import TYPE_CHECKING

from coframe._output.formatting import count
from coframe.bags.editing._rule import Rule

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step

__all__ = ["Dedupe"]

MAX_REMEMBERED = 1000  # last messages on a topic, and last transforms of a child frame, that are compared
_MAX_EDGES = 1000


class Dedupe(Rule):
    """``dedupe``: messages with a stamp, and transforms, that repeat an earlier one on their topic.

    Messages without a stamp and static transforms stay: they are repeated on purpose. A transform with the stamp of
    an earlier one but another pose stays as well, because which of them is right is not known.
    """

    name = "dedupe"
    form = ""
    unit = "duplicate"
    verb = "removed"

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self._seen_contents: OrderedDict[Hashable, OrderedDict[Hashable, Hashable]] = OrderedDict()
        self._different_count = 0

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that drops repeated messages or transforms."""
        if topic.is_static:
            return None
        if topic.has_transforms:
            return lambda message: self._transforms(topic.name, message)
        if topic.stamps is None or not topic.stamps.is_leading:
            return None
        return lambda message: self._message(topic, message)

    def _message(self, topic: EditedTopic, message: EditedMessage) -> bool:
        data = message.data
        if topic.stamps is None or not topic.stamps.first(data):
            return True
        if self._is_new(topic.name, (topic.channel.type, blake2b(data, digest_size=16).digest()), None):
            return True
        self.changes += 1
        return False

    def _transforms(self, topic: str, message: EditedMessage) -> bool:
        transforms = message.transforms()
        kept_transforms = [
            transform
            for transform in transforms
            if not transform.stamp
            or self._is_new((topic, transform.child), (transform.stamp, transform.parent), transform.pose)
        ]
        if len(kept_transforms) == len(transforms):
            return True
        self.changes += len(transforms) - len(kept_transforms)
        message.set_transforms(kept_transforms)
        return bool(kept_transforms)

    def _is_new(self, key: Hashable, what: Hashable, value: Hashable) -> bool:
        """Store a message, and return whether it differs from all earlier messages."""
        seen = self._seen_contents.setdefault(key, OrderedDict())
        if len(self._seen_contents) > _MAX_EDGES:
            self._seen_contents.popitem(last=False)
        if what in seen:
            self._different_count += seen[what] != value
            return seen[what] != value
        seen[what] = value
        if len(seen) > MAX_REMEMBERED:
            seen.popitem(last=False)
        return True

    def remarks(self) -> Iterator[str]:
        """Yield how many transforms contradict an earlier one."""
        if self._different_count:
            yield (
                f"dedupe: {count(self._different_count, 'transform')} with the stamp of another one, but another pose, "
                "stayed: the rule drop-publisher removes one of two publishers"
            )
