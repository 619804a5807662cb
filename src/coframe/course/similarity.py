# SPDX-License-Identifier: Apache-2.0
"""Compare the programs of a class: which submissions share more code than their tasks explain.

Programs are compared as sequences of Python tokens in which names, numbers and texts are replaced, so that renaming and
other comments change nothing. Sequences that are also in the stubs of the lab do not count. The result is a reason to
look at two files, not a proof.
"""

from __future__ import annotations

import io
import keyword
import tokenize
from collections import Counter
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from coframe.course.folders import stub_texts
from coframe.course.rubric import RUBRIC
from coframe.course.submitted import read_submitted
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

__all__ = ["Similarity", "similarities"]

_LENGTH = 16  # tokens of a compared sequence
_MIN_SEQUENCES = 30  # shorter programs are too much alike
_MAX_TOKENS = 50_000  # of a file
_LAYOUT = {tokenize.COMMENT, tokenize.NL, tokenize.ENCODING, tokenize.ENDMARKER, tokenize.INDENT, tokenize.DEDENT}


class Similarity(NamedTuple):
    """Two submissions with similar code.

    Attributes:
        first, second: The names of the submissions.
        file: The file.
        share: The share of the shorter program that is also in the other one, from 0 to 1.
        same_names: Whether even the names of variables and methods are the same.
    """

    first: str
    second: str
    file: str
    share: float
    same_names: bool


def similarities(folders: Mapping[str, Path], minimum: float = 0.6) -> list[Similarity]:
    """Return the pairs of submissions with similar programs, the most similar ones first.

    Args:
        folders: The folders of the submissions by their names.
        minimum: The minimum share.
    """
    found = []
    for file in dict.fromkeys(row.file for row in RUBRIC.values() if row.file.endswith(".py")):
        stub = [sequence for text in stub_texts(file) for sequence in _sequences(_tokens(text))]
        programs = {name: _Program.of(folder / file, stub) for name, folder in folders.items()}
        usable = {name: each for name, each in programs.items() if each is not None}
        for (first, one), (second, other) in combinations(usable.items(), 2):
            share = one.share(other)
            if share >= minimum:
                found.append(Similarity(first, second, file, round(share, 3), one.names == other.names))
    return sorted(found, key=lambda each: (-each.share, each.first, each.second, each.file))


class _Program(NamedTuple):
    sequences: Counter[int]
    names: tuple[str, ...]

    @classmethod
    def of(cls, file: Path, stub: Iterable[int]) -> _Program | None:
        """Return the program in a file without the sequences of the stub, or None if it cannot be compared."""
        try:
            text = read_submitted(file)
        except (OSError, CourseError):
            return None
        tokens = _tokens(text)
        own = Counter(_sequences(tokens))
        for sequence in set(stub):
            del own[sequence]
        if own.total() < _MIN_SEQUENCES:
            return None
        return cls(own, tuple(name for name, is_name in tokens if is_name))

    def share(self, other: _Program) -> float:
        """Return the share of the sequences of the shorter program that both have."""
        return (self.sequences & other.sequences).total() / min(self.sequences.total(), other.sequences.total())


def _tokens(text: str) -> list[tuple[str, bool]]:
    """Return the tokens of a program, and whether each is a name; up to the first one that is not Python."""
    found: list[tuple[str, bool]] = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type not in _LAYOUT and len(found) < _MAX_TOKENS:
                is_name = token.type == tokenize.NAME and not keyword.iskeyword(token.string)
                found.append((token.string, is_name))
    except (tokenize.TokenError, SyntaxError, ValueError):
        pass  # The tokens before the error are compared.
    return found


def _sequences(tokens: list[tuple[str, bool]]) -> list[int]:
    """Return the hash of each sequence of tokens, in which names and texts are replaced by placeholders."""
    normalized_tokens = ["name" if is_name else "text" if text[:1] in "\"'" else text for text, is_name in tokens]
    return [
        hash(tuple(normalized_tokens[start : start + _LENGTH])) for start in range(len(normalized_tokens) - _LENGTH + 1)
    ]
