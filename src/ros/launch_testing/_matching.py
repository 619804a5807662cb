# SPDX-License-Identifier: Apache-2.0
"""Matchers for text, lines and the output of processes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["build_line_match", "build_text_match", "output_contains", "remove_ansi_escape_sequences"]

_STREAMS = ("stdout", "stderr")

_ANSI_ESCAPE = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|[@-Z\\-_])")


def remove_ansi_escape_sequences(string: str) -> str:
    """Remove colors and other control sequences of terminals."""
    return _ANSI_ESCAPE.sub("", string)


def build_text_match(expected_text: Any, *, strict: bool = False) -> Callable[[str], tuple[int, int] | None]:
    """Return a function that finds the expected text in a string and returns its start and end, or None.

    Args:
        expected_text: A text, a compiled regular expression, a list of them that follow one another, or a function of
            the text that returns whether it matches.
        strict: Whether the whole text must match.

    Raises:
        ValueError: `expected_text` has another type.
    """
    if isinstance(expected_text, str):
        wanted = _normalize_text(expected_text)
        return lambda text: _find_patterns(wanted, _normalize_text(text), strict)
    if isinstance(expected_text, re.Pattern):
        search = expected_text.fullmatch if strict else expected_text.search
        return lambda text: found.span() if (found := search(_normalize_text(text))) is not None else None
    if isinstance(expected_text, list | tuple):
        matches = [build_text_match(each) for each in expected_text]
        return lambda text: _find_in_order(matches, _normalize_text(text), strict)
    if callable(expected_text):
        return lambda text: (0, len(text)) if expected_text(text) else None
    raise ValueError(
        "The expected output must be a string, a regular expression, a list of them or a function, not "
        f"{expected_text!r}."
    )


def build_line_match(expected_lines: Any, *, strict: bool = False) -> Callable[[Sequence[str]], tuple[int, int] | None]:
    """Return a function that finds the expected lines in a list of lines, as start and end or None.

    Args:
        expected_lines: A list of texts, regular expressions or functions of a line; or one of these.
        strict: Whether these must be all lines.
    """
    if isinstance(expected_lines, str | re.Pattern):
        expected_lines = [expected_lines]
    if callable(expected_lines):
        return lambda lines: (0, len(lines)) if expected_lines(lines) else None
    # A line that is given as a text is the whole line.
    matches = [build_text_match(each, strict=isinstance(each, str | re.Pattern)) for each in expected_lines]

    def find(lines: Sequence[str]) -> tuple[int, int] | None:
        count = len(matches)
        starts = [0] if strict else range(len(lines) - count + 1)
        if strict and len(lines) != count:
            return None
        for start in starts:
            if all(match(line) is not None for match, line in zip(matches, lines[start:], strict=False)):
                return start, start + count
        return None

    return find


def output_contains(
    proc_output: Any,
    processes: Iterable[ExecuteLocal],
    expected_output: Any,
    stream: str,
    *,
    output_filter: Callable[[str], str] | None,
    strip_ansi_escape_sequences: bool,
) -> bool:
    """Return whether the output of any of the processes matches.

    Raises:
        ValueError: `output_filter` is not a function, or there is no such stream.
    """
    if output_filter is not None and not callable(output_filter):
        raise ValueError("output_filter is not callable")
    if stream not in _STREAMS:
        raise ValueError(f"'{stream}' is not a stream of a process, expected 'stdout' or 'stderr'")
    matches = build_text_match(expected_output)
    for process in processes:
        parts = [event.text for event in proc_output[process] if getattr(event, f"from_{stream}")]
        text = b"".join(parts).decode(errors="replace")
        if strip_ansi_escape_sequences:
            text = remove_ansi_escape_sequences(text)
        if output_filter is not None:
            text = output_filter(text)
        if matches(text) is not None:
            return True
    return False


def _normalize_text(text: str) -> str:
    return text.replace("\r\n", "\n")


def _find_patterns(wanted: str, text: str, strict: bool) -> tuple[int, int] | None:
    if strict:
        return (0, len(text)) if text == wanted else None
    start = text.find(wanted)
    return None if start < 0 else (start, start + len(wanted))


def _find_in_order(
    matches: list[Callable[[str], tuple[int, int] | None]], text: str, strict: bool
) -> tuple[int, int] | None:
    first, position = None, 0
    for match in matches:
        found = match(text[position:])
        if found is None:
            return None
        first = position + found[0] if first is None else first
        position += found[1]
    span = (first or 0, position)
    return None if strict and span != (0, len(text)) else span
