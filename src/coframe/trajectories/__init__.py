# SPDX-License-Identifier: Apache-2.0
"""Trajectory files (TUM, KITTI, EuRoC, CSV), and the comparison of an estimated trajectory with a reference."""

from coframe.errors import TrajectoryError
from coframe.trajectories._alignment import ALIGNMENTS, Alignment, align
from coframe.trajectories._association import associate
from coframe.trajectories._comparison import (
    PLANES,
    Comparison,
    Delta,
    PoseErrors,
    Statistics,
    compare_trajectories,
    parse_delta,
)
from coframe.trajectories._offsets import BodyOffset, TimeShift
from coframe.trajectories._reading import READABLE_FORMATS, read_trajectory
from coframe.trajectories._resampling import resample
from coframe.trajectories.formats import FORMATS, format_of, write_trajectory

__all__ = [
    "ALIGNMENTS",
    "FORMATS",
    "PLANES",
    "READABLE_FORMATS",
    "Alignment",
    "BodyOffset",
    "Comparison",
    "Delta",
    "PoseErrors",
    "Statistics",
    "TimeShift",
    "TrajectoryError",
    "align",
    "associate",
    "compare_trajectories",
    "format_of",
    "parse_delta",
    "read_trajectory",
    "resample",
    "write_trajectory",
]
