# SPDX-License-Identifier: Apache-2.0
"""The output of ``coframe doctor --system``."""

from __future__ import annotations

import dataclasses
import json
from typing import TYPE_CHECKING, Any

from click.exceptions import Exit

from coframe.cli.output import one_line, report_console
from coframe.system.advice import advise
from coframe.system.report import collect
from coframe.system.sections import sections

if TYPE_CHECKING:
    from coframe.system import SystemFinding, SystemReport

__all__ = ["examine_system"]

_STYLES = {"error": "bold red", "warning": "yellow", "note": "cyan"}


def examine_system(domain: int | None, listen: float, *, as_json: bool) -> None:
    """Print the system report, and end the command with exit code 0 or 1."""
    report = collect(domain, listen=listen)
    advice = advise(report)
    if as_json:
        print(json.dumps({**_as_data(report), "findings": [dataclasses.asdict(item) for item in advice]}, indent=2))
    else:
        console = report_console()
        for title, lines in sections(report):
            console.print(title, style="bold", markup=False)
            for line in lines:
                console.print(f"  {one_line(line)}", markup=False, highlight=False)
        _print_advice(advice)
    raise Exit(1 if any(item.severity != "note" for item in advice) else 0)


def _as_data(report: SystemReport) -> dict[str, Any]:
    data: dict[str, Any] = json.loads(json.dumps(dataclasses.asdict(report), default=str))
    return data


def _print_advice(advice: list[SystemFinding]) -> None:
    console = report_console()
    console.print("Findings", style="bold")
    if not advice:
        console.print("  none")
    for item in advice:
        console.print(
            f"  {item.severity}: {one_line(item.text)}", style=_STYLES[item.severity], markup=False, highlight=False
        )
        if item.action:
            console.print(f"    {one_line(item.action)}", markup=False, highlight=False)
