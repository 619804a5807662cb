# SPDX-License-Identifier: Apache-2.0
"""Filters of output, and the comparison of output with expected lines."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from launch_testing._matching import build_line_match, build_text_match

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = [
    "basic_output_filter",
    "expect_output",
    "get_default_filtered_patterns",
    "get_default_filtered_prefixes",
]


def get_default_filtered_prefixes() -> list[str]:
    """Return the beginnings of lines that debuggers and processes at their end write."""
    return ["pydev debugger: CRITICAL WARNING: This version of python seems to be incorrectly compiled", "Ctrl-C"]


def get_default_filtered_patterns() -> list[str]:
    """Return regular expressions of lines that are not output of the tested program."""
    return []


def basic_output_filter(
    filtered_prefixes: Iterable[str] | None = None, filtered_patterns: Iterable[str] | None = None
) -> Callable[[str], str]:
    """Return a function that removes lines from an output.

    Args:
        filtered_prefixes: Beginnings of lines that are removed; by default those of `get_default_filtered_prefixes`.
        filtered_patterns: Regular expressions for the beginnings of lines that are removed.
    """
    prefixes = tuple(get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes)
    patterns = get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns
    compiled = [re.compile(each) for each in patterns]

    def keep(output: str) -> str:
        lines = output.splitlines(keepends=True)
        return "".join(
            line for line in lines if not line.startswith(prefixes) and not any(each.match(line) for each in compiled)
        )

    return keep


def expect_output(
    text: str | None = None,
    *,
    expected_text: Any = None,
    expected_lines: Any = None,
    lines: Sequence[str] | None = None,
    strict: bool = False,
) -> bool:
    """Return whether an output is as expected.

    Args:
        text: The output; or pass its `lines`.
        expected_text: A text, a compiled regular expression, a list of them, or a function of the output.
        expected_lines: The expected lines: texts, regular expressions or functions of a line.
        lines: The lines of the output.
        strict: Whether the whole output must match; otherwise it may contain more.

    Raises:
        ValueError: Neither or both kinds of an argument are given.
    """
    if (text is None) == (lines is None):
        raise ValueError("Pass either text or lines as the output.")
    if (expected_text is None) == (expected_lines is None):
        raise ValueError("Pass either expected_text or expected_lines.")
    if expected_text is not None:
        whole = text if text is not None else "\n".join(lines or ())
        return build_text_match(expected_text, strict=strict)(whole) is not None
    given = list(lines) if lines is not None else (text or "").splitlines()
    return build_line_match(expected_lines, strict=strict)(given) is not None
