# SPDX-License-Identifier: Apache-2.0
"""Filters for the output of ROS commands."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

import launch_testing.tools
from coframe._files.regular_files import read_regular_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["basic_output_filter", "get_rmw_output_filter"]

MAX_FILTER_BYTES = 1 << 20


def get_rmw_output_filter(rmw_implementation: str, filter_type: str) -> list[str]:
    """Return the prefixes or patterns of lines that a middleware writes.

    Args:
        rmw_implementation: Name of the middleware's package, such as ``rmw_cyclonedds_cpp``.
        filter_type: ``prefixes`` or ``patterns``; they are in the files ``rmw_output_prefixes.txt`` and
            ``rmw_output_patterns.txt`` of the package.

    Raises:
        ValueError: There is no such kind of filters.
    """
    if filter_type not in {"prefixes", "patterns"}:
        raise ValueError(f"Invalid filter type '{filter_type}', expected one of: prefixes, patterns")
    spec = importlib.util.find_spec(rmw_implementation) if rmw_implementation else None
    folders = list(spec.submodule_search_locations or ()) if spec is not None else []
    for folder in folders:
        file = Path(folder, f"rmw_output_{filter_type}.txt")
        if file.is_file():
            return read_regular_text(file, MAX_FILTER_BYTES).splitlines()
    return []


def basic_output_filter(
    filtered_prefixes: Iterable[str] | None = None,
    filtered_patterns: Iterable[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Callable[[str], str]:
    """Return a function that removes lines from an output.

    Args:
        filtered_prefixes: Beginnings of lines that are removed, or None for those of debuggers.
        filtered_patterns: Regular expressions for the beginnings of lines that are removed.
        filtered_rmw_implementation: Name of a middleware's package whose lines are also removed.
    """
    prefixes = launch_testing.tools.get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes
    patterns = launch_testing.tools.get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns
    rmw = filtered_rmw_implementation or ""
    return launch_testing.tools.basic_output_filter(
        [*prefixes, *get_rmw_output_filter(rmw, "prefixes")], [*patterns, *get_rmw_output_filter(rmw, "patterns")]
    )
