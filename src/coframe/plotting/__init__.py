# SPDX-License-Identifier: Apache-2.0
"""Plots over time of poses, fields of messages, rates and delays, as SVG, PNG and interactive HTML."""

from coframe.errors import PlotError
from coframe.plotting._figure import FIGURE_FORMATS, Figure, Series, figure_format
from coframe.plotting.evaluation import evaluate, trajectory_curves
from coframe.plotting.expressions import (
    FieldExpression,
    PoseExpression,
    TimingExpression,
    parse_expression,
)

__all__ = [
    "FIGURE_FORMATS",
    "FieldExpression",
    "Figure",
    "PlotError",
    "PoseExpression",
    "Series",
    "TimingExpression",
    "evaluate",
    "figure_format",
    "parse_expression",
    "trajectory_curves",
]
