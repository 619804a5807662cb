# SPDX-License-Identifier: Apache-2.0
"""``coframe lab``: creates a student's folder, runs its nodes with a simulated robot, and grades it."""

from __future__ import annotations

import csv
import json
import shlex
import sys
import threading
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import click

from coframe._files.complete_files import complete_or_absent, write_complete
from coframe._output.escaping import csv_cell
from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.options import NonNegativeDuration, duration_option
from coframe.cli.output import fail, print_bounded, printable, report_console, warn
from coframe.cli.progress import item_progress
from coframe.cli.view import open_browser, optional_viewer, port_option
from coframe.connection.connection import connect
from coframe.course import formats
from coframe.course.assignment import ASSIGNMENT_FILE
from coframe.course.checking import check_class, check_folder, submissions
from coframe.course.faults import FAULTS
from coframe.course.first_output import FirstOutput
from coframe.course.folders import create_folder
from coframe.course.handbook import chapters, contents, terminal_text, write_pages
from coframe.course.isolation import isolation_problem
from coframe.course.rubric import CRITERIA
from coframe.course.running import COMPLETE_TREE_FILES, NODE_FILES, SIMULATION, programs_of, running
from coframe.course.submitted import check_outputs
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from coframe.course.running import NamedCommand

__all__ = ["lab"]

_FIRST_OUTPUT = 8.0  # seconds within which each program should have published something
_HANDBOOK_WIDTH = 120  # columns: longer lines are hard to read
folder_argument = argument(
    "folder",
    metavar="[FOLDER]",
    type=PATH,
    required=False,
    help=f"Folder of the lab. [default: the current folder if it contains {ASSIGNMENT_FILE}, otherwise lab]",
)
variant_option = click.option(
    "--variant", metavar="SEED", type=int, help="Seed of a variant with different lengths, sensor mounts and rates."
)
lab = CommandGroup(
    "lab",
    help="Work on the lab: create a folder, run its nodes and grade them.\n\nExample: coframe lab new",
)


@lab.command(short_help="Create a folder with stubs for the lab.")
@argument(
    "folder",
    metavar="[FOLDER]",
    type=PATH,
    default=Path("lab"),
    help="Folder to create. [default: lab]",
)
@variant_option
def new(folder: Path, variant: int | None) -> None:
    """Create a folder with the files of the lab: stubs with a task in each docstring, an RViz file and a README.

    Example: coframe lab new my_lab --variant 4711
    """
    with run_to_completion():
        for path in create_folder(folder, variant):
            print(f"created {printable(str(path))}")
        command = f"coframe lab run {shlex.quote(printable(str(folder)))}"
        print(f"Next: read {printable(str(folder / 'README.md'))}, then run: {command}")


@lab.command(short_help="Run the nodes of a folder with a simulated robot.")
@folder_argument
@click.option("--complete", is_flag=True, help="Run complete_tf_tree.py instead of the two broadcasters.")
@click.option("--browser/--no-browser", default=True, help="Open the viewer in the browser.")
@port_option
@duration_option
def run(
    folder: Path | None,
    complete: bool,
    browser: bool,
    port: int | None,
    duration: NonNegativeDuration | None,
) -> None:
    """Run the nodes of a folder with simulated joints and a simulated lidar, and show them in the viewer.

    Each output line is prefixed with the name of its node. The viewer's findings show what is missing.

    Example: coframe lab run my_lab
    """
    seconds = None if duration is None else duration.seconds
    simulation = SIMULATION[1:] if complete else SIMULATION
    with run_until_interrupted():
        programs = [*programs_of(_folder(folder), COMPLETE_TREE_FILES if complete else NODE_FILES), *simulation]
        print(
            "Your nodes are running with a simulated robot. Press Ctrl-C to stop them. The viewer shows them:",
            flush=True,
        )
        _run(programs, seconds, browser=browser, port=port, names_silent=True)


@lab.command(short_help="Grade one student's folder, or a whole class.")
@folder_argument
@click.option("--all", "everyone", is_flag=True, help="Grade all folders in FOLDER, one per student.")
@click.option("--output", "-o", metavar="FILE", type=PATH, help="With --all: write the grades as a CSV table.")
@click.option(
    "--only", metavar="CRITERION", multiple=True, help=f"Check only this criterion: {', '.join(CRITERIA)}; repeatable."
)
@variant_option
@click.option("--json", "as_json", is_flag=True, help="Print the report as JSON.")
@click.option("--gradescope", metavar="FILE", type=PATH, help="Write Gradescope's results.json.")
@click.option("--classroom", metavar="FILE", type=PATH, help="Write the result for GitHub Classroom.")
@click.option(
    "--record", metavar="FOLDER", type=PATH, help="Record all topics to this folder, for inspection in the viewer."
)
@click.option(
    "--jobs",
    "-j",
    metavar="N",
    type=click.IntRange(min=1),
    default=2,
    help="With --all: number of folders to grade in parallel.",
)
def check(
    folder: Path | None,
    everyone: bool,
    output: Path | None,
    only: tuple[str, ...],
    variant: int | None,
    as_json: bool,
    gradescope: Path | None,
    classroom: Path | None,
    record: Path | None,
    jobs: int,
) -> None:
    """Grade the nodes in a folder by what they publish: up to 100 points, plus 10 for each of four extensions.

    The nodes run with a simulated clock and limits on time, memory and output. The exit code is 0 regardless of the
    grade.

    Example: coframe lab check my_lab
    """
    chosen = tuple(only or CRITERIA)
    if unknown := set(chosen) - set(CRITERIA):
        fail(f"--only: unknown criterion {', '.join(sorted(unknown))}", f"Criteria: {', '.join(CRITERIA)}.", code=2)
    formatted = ((gradescope, formats.gradescope), (classroom, formats.classroom))
    if everyone and (record or gradescope or classroom):
        fail("--gradescope, --classroom and --record apply to a single folder", "Omit them, or omit --all.", code=2)
    if output and not everyone:
        fail("-o writes the grades of a class", "Add --all, or use --json for the report of one folder.", code=2)
    with run_to_completion():
        if problem := isolation_problem():
            warn(problem)
        if everyone:
            _check_class(folder or Path("lab"), output, jobs, variant, chosen, as_json=as_json)
            return
        student = _folder(folder)
        check_outputs((record, gradescope, classroom), student)
        try:
            with item_progress("checking", len(chosen)) as progress:
                report = check_folder(student, variant=variant, only=chosen, record=record, progress=progress)
        except CourseError as error:
            _write_reports(formats.ungraded_report(str(student), str(error)), formatted)
            raise
        _write_reports(report, formatted)
        if as_json:
            print(json.dumps(report, indent=2))
            return
        for line in formats.text(report):
            print(printable(line))


def _write_reports(
    report: dict[str, Any], formatted: Iterable[tuple[Path | None, Callable[[dict[str, Any]], dict[str, Any]]]]
) -> None:
    for path, convert in formatted:
        if path is not None:
            write_complete(path, f"{json.dumps(convert(report), indent=2)}\n".encode())


@lab.command("break", short_help="Start a system with a fault to diagnose.")
@argument(
    "number", metavar="N", type=click.IntRange(min=1, max=len(FAULTS)), help=f"Number of a fault, 1 to {len(FAULTS)}."
)
@click.option("--answer", metavar="FAULT", help="Check this answer instead of starting the system.")
@click.option("--browser/--no-browser", help="Open the viewer in the browser; its findings are a hint.")
@port_option
@duration_option
def break_(
    number: int,
    answer: str | None,
    browser: bool,
    port: int | None,
    duration: NonNegativeDuration | None,
) -> None:
    """Start the robot of the lab with one of ten faults. Find it with the viewer, echo, monitor and frames.

    coframe doctor and the viewer's findings count as hints.

    Then give your answer: coframe lab break N --answer "FAULT".

    Example: coframe lab break 3
    """
    if answer is not None:
        _print_verdict(number, answer)
        return
    seconds = None if duration is None else duration.seconds
    print(f"System {number} is running in this ROS domain. What is wrong with it? Stop it with Ctrl-C.")
    print(f'Then answer with: coframe lab break {number} --answer "FAULT", where FAULT is one of:')
    print(f"  {', '.join(sorted(each.name for each in FAULTS))}", flush=True)
    with run_until_interrupted():
        _run(FAULTS[number - 1].programs, seconds, browser=browser, port=port)


@lab.command(short_help="Read the handbook of the course.")
@argument(
    "chapter",
    metavar="[CHAPTER]",
    type=click.IntRange(min=1),
    required=False,
    help="Number of the chapter. [default: the table of contents]",
)
@click.option("--output", "-o", metavar="FOLDER", type=PATH, help="Write all chapters as web pages with images.")
@click.option("--browser/--no-browser", default=True, help="With -o: open the pages in the browser.")
def handbook(
    chapter: int | None,
    output: Path | None,
    browser: bool,
) -> None:
    """Print the table of contents or a chapter of the handbook, or write the handbook as web pages.

    Example: coframe lab handbook -o handbook
    """
    with run_to_completion():
        if output is not None:
            _write_handbook(output, chapter, browser=browser)
            return
        found = {each.number: each for each in chapters()}
        if chapter is not None and chapter not in found:
            fail(f"There is no chapter {chapter}", f"Chapters: 1 to {len(found)}.", code=2)
        from rich.markdown import Markdown  # noqa: PLC0415 - only for this text

        file = contents() if chapter is None else found[chapter].file
        console = report_console()
        console.print(Markdown(terminal_text(file), hyperlinks=False), width=min(console.width, _HANDBOOK_WIDTH))
        if chapter is None:
            print(
                "Read a chapter: coframe lab handbook 1. With images, in the browser: coframe lab handbook -o handbook"
            )


def _write_handbook(folder: Path, chapter: int | None, *, browser: bool) -> None:
    first = write_pages(folder)
    page = first if chapter is None else next(folder.glob(f"{chapter:02d}_*.html"), first)
    print(page.resolve())
    if browser and sys.stdout.isatty():
        open_browser(page.resolve().as_uri())


def _folder(given: Path | None) -> Path:
    """Return the folder of the lab: the given one, the current one if it contains the lab, or lab."""
    if given is not None:
        return given
    return Path.cwd() if Path(ASSIGNMENT_FILE).is_file() else Path("lab")


def _run(
    programs: Sequence[NamedCommand],
    seconds: float | None,
    *,
    browser: bool,
    port: int | None,
    names_silent: bool = False,
) -> None:
    """Run programs and the viewer until Ctrl-C or for a given time, and print the output of the programs.

    With `names_silent`, a message about each program that publishes nothing is printed after a few seconds.
    """
    width = max(len(program.name) for program in programs)
    closed = threading.Event()  # The reader of a pipe, such as `head`, closed it.

    def write(name: str, line: str) -> None:
        try:
            print_bounded(f"{name:>{width}} | {printable(line)}")
        except BrokenPipeError:
            closed.set()

    with connect("coframe_lab") as ros, optional_viewer(ros, port, browser=browser), running(programs, write):
        if names_silent and (seconds is None or seconds > _FIRST_OUTPUT):
            first = FirstOutput(ros, programs)
            closed.wait(_FIRST_OUTPUT)
            for name, sentence in first.missing():
                write(name, sentence)
            first.close()
            seconds = None if seconds is None else seconds - _FIRST_OUTPUT
        closed.wait(seconds)
    if closed.is_set():
        raise BrokenPipeError


def _print_verdict(number: int, answer: str) -> None:
    names = [each.name for each in FAULTS]
    if answer not in names:
        fail(f"{answer!r} is not the name of a fault", f"Faults: {', '.join(sorted(names))}.", code=2)
    fault = FAULTS[number - 1]
    if answer != fault.name:
        fail("The answer is wrong.", "Start the system again, and run coframe doctor in a second terminal.")
    print(f"Right: {fault.explanation}")


def _check_class(
    folder: Path, output: Path | None, jobs: int, variant: int | None, only: tuple[str, ...], *, as_json: bool
) -> None:
    """Grade the folders of a class, print a table or all reports, and write the table as CSV."""
    folders = submissions(folder)
    reports: dict[str, dict[str, Any]] = {}
    with (
        item_progress("checking", len(folders)) as progress,
        closing(check_class(folders, jobs=jobs, variant=variant, only=only)) as results,
    ):
        for name, result in results:
            reports[name] = result if isinstance(result, dict) else formats.ungraded_report(name, str(result))
            progress(len(reports))
    rows = [formats.csv_row(name, reports[name]) for name in sorted(reports)]
    columns = list(dict.fromkeys(column for row in rows for column in row if column != "problem"))
    if output is not None:
        with complete_or_absent(output) as part, _open_table(part) as file:
            writer = csv.DictWriter(file, [*columns, "problem"], restval=0.0)
            writer.writeheader()
            writer.writerows({key: csv_cell(value) for key, value in row.items()} for row in rows)
    if as_json:
        print(json.dumps({name: reports[name] for name in sorted(reports)}, indent=2))
    else:
        _print_table(rows, columns)


def _open_table(path: Path) -> TextIO:
    """Open a file for a table; names of submissions may contain invalid UTF-8."""
    return path.open("w", encoding="utf-8", newline="", errors="backslashreplace")


def _print_table(rows: Sequence[dict[str, Any]], columns: Sequence[str]) -> None:
    from rich.table import Table  # noqa: PLC0415 - only for this table

    table = Table(box=None, pad_edge=False, header_style="dim")
    for column in columns:
        table.add_column(column, justify="left" if column == "submission" else "right")
    for row in rows:
        cells = (row.get(column, 0.0) for column in columns)
        table.add_row(*("" if cell is None else printable(str(cell)) for cell in cells))
    report_console().print(table)
