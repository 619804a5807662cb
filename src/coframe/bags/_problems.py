# SPDX-License-Identifier: Apache-2.0
"""Problems found in a recording, as messages. Equal ones are counted."""

from __future__ import annotations

__all__ = ["Problems"]

_MAX_SENTENCES = 200
_MAX_LENGTH = 1000


class Problems:
    """Collects messages and counts how often each occurs."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}
        self._omitted = 0

    def add(self, sentence: str, times: int = 1) -> None:
        """Add a problem. Once there are too many different ones, others are only counted.

        Args:
            sentence: The message.
            times: The number of occurrences, or 0 for a message that is shown without a count.
        """
        # Names in recordings may contain control characters, and the messages are printed on terminals.
        sentence = sentence[:_MAX_LENGTH]
        if not sentence.isprintable():
            sentence = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in sentence)
        if sentence not in self._counts and len(self._counts) >= _MAX_SENTENCES:
            self._omitted += times
            return
        self._counts[sentence] = self._counts.get(sentence, 0) + times

    def sentences(self) -> list[str]:
        """Return all messages, in the order in which they first occurred."""
        counted = [text if count <= 1 else f"{text} ({count} times)" for text, count in self._counts.items()]
        return [*counted, f"{self._omitted} more problems of other kinds"] if self._omitted else counted
