# SPDX-License-Identifier: Apache-2.0
"""Base class of the rules that edit a recording, and what they share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from coframe.errors import EditError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._survey import Survey

    Step = Callable[[EditedMessage], bool]

__all__ = ["Insertion", "Rule", "split_pair"]


class Insertion(NamedTuple):
    """A message that a rule adds at the beginning of the recording.

    Attributes:
        topic: Name of the topic.
        data: A TFMessage in CDR.
    """

    topic: str
    data: bytes


class Rule(ABC):
    """One change to a recording, such as renaming a frame.

    Rules are applied one after the other: each one finds the names that the rules before it have written.

    Attributes:
        name: The name in recipes and, after two dashes, on the command line.
        form: How the value is written, for help texts and errors.
        text: The value.
        changes: How many of the things that :attr:`unit` names were changed so far.
        unit: What is counted, in the singular.
    """

    name: ClassVar[str]
    form: ClassVar[str]
    unit: ClassVar[str] = "message"
    verb: ClassVar[str] = "changed"

    def __init__(self, text: str) -> None:
        self.text = text
        self.changes = 0

    def prepare(self, survey: Survey) -> None:
        """Prepare the rule before the first message. The survey contains the names after earlier rules.

        Raises:
            EditError: The rule cannot be applied to this recording.
        """
        del survey

    def topic(self, name: str) -> str | None:
        """Return the new name of a topic, or None if it is dropped."""
        return name

    def frame(self, name: str) -> str:
        """Return the new name of a frame."""
        return name

    def start(self, first: int) -> int:
        """Return the new start of a recording that starts at a receive time, in nanoseconds."""
        return first

    @abstractmethod
    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that edits each message on a topic, or None if the rule does not change them.

        The function returns False to drop the message.
        """

    def insertions(self) -> Iterator[Insertion]:
        """Yield the messages to add at the beginning."""
        yield from ()

    def remarks(self) -> Iterator[str]:
        """Yield remarks for the user after the last message."""
        yield from ()

    def nearest(self, survey: Survey) -> str:
        """Return a hint with names from the input, for a rule that matched nothing."""
        del survey
        return ""

    def __str__(self) -> str:
        return f"{self.name} {self.text}"


def split_pair(text: str, form: str) -> tuple[str, str]:
    """Return the two parts of ``a=b``.

    Raises:
        EditError: The text has another form.
    """
    old, equals, new = (part.strip() for part in text.partition("="))
    if not (old and equals and new) or "\0" in text:
        raise EditError(f"{text[:60]!r} does not have the form {form}")
    return old, new
