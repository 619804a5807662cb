# SPDX-License-Identifier: Apache-2.0
"""``coframe doctor BAG --fix OUT``: writes a repaired copy of a recording, and examines it."""

from __future__ import annotations

import shlex
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import click
from click.exceptions import Exit

from coframe._files.temporary_folders import temporary_folder
from coframe._output.formatting import count
from coframe.bags import repair
from coframe.bags.editing import DamagedRecordingError, Recipe
from coframe.bags.editing import edit as edit_recording
from coframe.cli.bag_edit import print_report
from coframe.cli.output import fail, one_line, printable
from coframe.cli.progress import reading_progress, task_progress
from coframe.doctor.rendering.text import headline
from coframe.doctor.repair_plan import plan_repair

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe._sources.sources import Readable
    from coframe.bags.editing import EditReport
    from coframe.doctor import Report
    from coframe.doctor.repair_plan import RepairPlan

__all__ = ["fix_recording", "print_recipe"]


def print_recipe(reports: dict[str, Report]) -> None:
    """Print the recipe of the safe repairs, and as comments the choices that other problems need."""
    plan = plan_repair(reports.values())
    print(printable(str(plan.recipe)), end="")
    for line in _choices(plan):
        print(one_line(f"# {line}"))


def fix_recording(
    bag: Readable,
    target: Path,
    reports: dict[str, Report],
    examine: Callable[[Path], dict[str, Report]],
    *,
    yes: bool,
) -> NoReturn:
    """Repair a recording, and end the command with exit code 0 if the copy is healthy, otherwise 1.

    Args:
        bag: The recording.
        target: The copy to write.
        reports: The reports about the recording.
        examine: Prints the reports about the copy, and returns them.
        yes: Whether to apply the recipe without asking.
    """
    if target.exists() or target.is_symlink():
        fail(f"{target} already exists and is not overwritten", "Choose another name.")
    if not isinstance(bag, Path):
        fail(f"{bag} cannot be repaired: it is not on this machine", f"Copy it first: coframe bag convert {bag} FOLDER")
    plan = plan_repair(reports.values())
    with ExitStack() as closing:
        source, damage = _open_readable(bag, plan.recipe, closing)
        if not len(plan.recipe) and not damage:
            is_healthy = all(report.healthy for report in reports.values())
            print("nothing to repair" if is_healthy else "no finding has one safe repair; nothing was written")
            _print_choices(plan)
            raise Exit(0 if is_healthy else 1)
        for line in damage:
            print(one_line(f"damaged: {line}"))
        if len(plan.recipe):
            print(f"\nrecipe:\n{printable(str(plan.recipe))}", end="")
            for rule in edit_recording(source, None, plan.recipe).rules:
                print(one_line(f"would be done: {rule.rule}: {rule.text}"))
        _ask(target, yes=yes)
        report = _write(source, target, plan.recipe)
        print()
        print_report(report)
        print(f"\n{printable(str(target))}:")
        found = examine(target)
        _print_choices(plan_repair(found.values()))
    raise Exit(0 if all(report.healthy for report in found.values()) else 1)


def _open_readable(bag: Path, recipe: Recipe, closing: ExitStack) -> tuple[Path, list[str]]:
    """Return the recording, or a copy of the readable part of a damaged one, and lists of damage and repairs."""
    try:
        with reading_progress() as progress:
            edit_recording(bag, None, recipe, progress=progress)
    except DamagedRecordingError as error:
        folder = Path(closing.enter_context(temporary_folder("coframe-fixed-")))
        with task_progress() as steps:
            found = repair(bag, folder / "readable", progress=steps)
        copied = [f"in the copy: {change}" for change in found.changes]
        return folder / "readable", [str(error), *found.problems, *copied]
    return bag, []


def _write(source: Path, target: Path, recipe: Recipe) -> EditReport:
    with reading_progress() as progress:
        return edit_recording(source, target, recipe, progress=progress)


def _ask(target: Path, *, yes: bool) -> None:
    """Ask whether to write the copy; end the command if the answer is no, or if there is no terminal."""
    if yes:
        return
    if not sys.stdin.isatty():
        fail("there is no terminal on which to ask", "Add --yes to apply the recipe.", code=2)
    if not click.confirm(f"Write the repaired copy {printable(str(target))}?"):
        raise Exit(1)


def _print_choices(plan: RepairPlan) -> None:
    if len(plan.recipe):
        print("\nRun the command again on the copy: what it repairs was hidden by another problem.")
    lines = _choices(plan)
    if lines:
        print(f"\n{count(len(plan.choices), 'finding')} without one safe repair:")
    for line in lines:
        print(one_line(line))


def _quote_rule(rule: str) -> str:
    """Return a rule with the quoting that a shell needs."""
    name, _, value = rule.partition(" ")
    return rule if name in {"set-static", "replace-mount"} or not value else f"{name} {shlex.quote(value)}"


def _choices(plan: RepairPlan) -> list[str]:
    """Return what the findings without one safe repair need, one line each."""
    lines = []
    for finding, options in plan.choices:
        lines.append(headline(finding))
        if options:
            lines += [f"  choose: --{_quote_rule(option)}" for option in options]
        else:
            lines.append(f"  cannot be repaired in a recording: {finding.fix}")
    return lines
