"""What could not be read, as sentences; a million damaged messages make one of them."""

from __future__ import annotations

__all__ = ["Problems"]

_MOST = 200
_LONGEST = 1000


class Problems:
    """Collects sentences, each with how often it was said."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}
        self._left_out = 0

    def add(self, sentence: str, times: int = 1) -> None:
        """Notes a sentence, 0 times if it is told once in any case; in the end only that there were more of them."""
        # Names in recordings may hold anything, and sentences end up in terminals.
        sentence = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in sentence[:_LONGEST])
        if sentence not in self._counts and len(self._counts) >= _MOST:
            self._left_out += times
            return
        self._counts[sentence] = self._counts.get(sentence, 0) + times

    def sentences(self) -> list[str]:
        """All of them, in the order in which they came up first."""
        said = [text if count <= 1 else f"{text} ({count} times)" for text, count in self._counts.items()]
        return [*said, f"{self._left_out} more problems of other kinds"] if self._left_out else said
