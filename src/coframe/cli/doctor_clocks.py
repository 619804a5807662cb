# SPDX-License-Identifier: Apache-2.0
"""``coframe doctor --clocks``: the offset and the drift of each publisher's clock, as numbers and as a plot."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from coframe._output.escaping import display_name
from coframe._output.formatting import duration
from coframe.cli.output import report_console
from coframe.cli.plot import check_figure_package, save_figure
from coframe.doctor.publisher_clocks import publisher_clocks
from coframe.plotting import Figure, Series

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor.observation import Observation
    from coframe.doctor.publisher_clocks import PublisherClock

__all__ = ["show_clocks"]


def show_clocks(observations: dict[str, Observation], plot: Path | None, *, as_json: bool) -> None:
    """Print the clocks of observations by namespace, and write the plot of their delays.

    Args:
        observations: The observations by namespace.
        plot: The file of the plot, or None.
        as_json: Whether JSON is printed instead of a table.
    """
    if plot is not None:
        check_figure_package(plot)
    clocks = {name: publisher_clocks(observation) for name, observation in observations.items()}
    every = [(_label(name, clock.name, len(clocks)), clock) for name, rows in clocks.items() for clock in rows]
    if as_json:
        print(json.dumps([_as_data(label, clock) for label, clock in every], indent=2))
    elif every:
        report_console().print(_table(every))
    else:
        print("There are no stamps: no dynamic transforms and no sensor data.")
    if plot is not None:
        panel = "delay from stamp to arrival (s)"
        series = [Series(label, clock.arrived, clock.delays, panel) for label, clock in every]
        save_figure(Figure("clocks", series), plot)


def _label(namespace: str, name: str, namespaces: int) -> str:
    return f"{namespace or '/'}: {name}" if namespaces > 1 else name


def _table(rows: list[tuple[str, PublisherClock]]) -> Table:
    table = Table(box=None, pad_edge=False)
    for title in ("stamps of", "clock", "offset", "+-", "drift", "publisher"):
        table.add_column(title, justify="right" if title in {"offset", "+-", "drift"} else "left")
    for label, clock in rows:
        offset = clock.offset
        table.add_row(
            Text(display_name(label)),
            clock.clock,
            f"{duration(abs(offset.offset))} {_direction(offset)}",
            duration(offset.spread),
            "-" if offset.drift is None else f"{offset.drift:.3g} ppm",
            Text(", ".join(map(display_name, clock.publishers))),
        )
    return table


def _direction(offset: ClockOffset) -> str:
    return "ahead" if offset.offset < 0 else "behind"


def _as_data(label: str, clock: PublisherClock) -> dict[str, object]:
    return {
        "stamps_of": label,
        "clock": clock.clock,
        "offset_ns": round(clock.offset.offset),
        "spread_ns": round(clock.offset.spread),
        "drift_ppm": clock.offset.drift,
        "publishers": list(clock.publishers),
    }
