# SPDX-License-Identifier: Apache-2.0
"""The option --max-gap of commands that write poses: between detections that are far apart, none are invented."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import click

from coframe.bags.tables.columns import PoseSource, column, column_list
from coframe.buffer.gaps import MAX_GAP
from coframe.cli.options import PositiveDuration
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from coframe.bags.tables import Column, TableQuery

__all__ = ["GAP_EFFECTS", "limit_pose_gaps", "pose_gap_option", "pose_names", "table_gap_option"]

GAP_EFFECTS = {"omit": "they are omitted", "nan": "they are NaN"}
_DEFAULT = f"{MAX_GAP // MILLISECOND}ms"

pose_gap_option = click.option(
    "--max-gap",
    metavar="DURATION",
    type=PositiveDuration,
    default=_DEFAULT,
    help="Maximum interval between two transforms of a recording for interpolation.",
)
table_gap_option = click.option(
    "--max-gap",
    metavar="DURATION",
    type=PositiveDuration,
    help=f"Maximum interval for interpolation, between two messages or two transforms. [default: {_DEFAULT} for poses "
    "of frames, and no limit for messages]",
)


def limit_pose_gaps(query: TableQuery) -> TableQuery:
    """Return the query of a table; without ``--max-gap``, the poses of frames have the default limit."""
    if query.max_gap is not None:
        return query
    return replace(query, columns=[_limited(column(each)) for each in column_list(query.columns)])


def pose_names(query: TableQuery) -> set[str]:
    """Return the names of the columns with poses of frames."""
    columns = map(column, column_list(query.columns))
    return {each.label for each in columns if isinstance(each.parsed, PoseSource)}


def _limited(requested: Column) -> Column:
    return replace(requested, max_gap=MAX_GAP) if isinstance(requested.parsed, PoseSource) else requested
