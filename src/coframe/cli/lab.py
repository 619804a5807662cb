# SPDX-License-Identifier: Apache-2.0
"""``coframe lab``: creates a student's folder, runs its nodes with a simulated robot, and grades it."""

from __future__ import annotations

import contextlib
import json
import shlex
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from coframe._files.complete_files import write_complete
from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.lab_class import ClassOptions, grade_class
from coframe.cli.lifecycle import run_to_completion, run_until_interrupted
from coframe.cli.options import NonNegativeDuration, duration_option
from coframe.cli.output import fail, print_bounded, printable, report_console, warn
from coframe.cli.progress import item_progress
from coframe.cli.view import open_browser, optional_viewer, port_option
from coframe.connection.connection import connect
from coframe.course import formats
from coframe.course.assignment import ASSIGNMENT_FILE, recorded_language
from coframe.course.autograder import PLATFORMS, needs_newest_glibc, write_autograder
from coframe.course.checking import check_folder
from coframe.course.faults import FAULTS, draw, named_fault
from coframe.course.feedback import FEEDBACK_FORMATS
from coframe.course.first_output import FirstOutput
from coframe.course.folders import create_class, create_folder
from coframe.course.gradebooks import ASSIGNMENT
from coframe.course.handbook import chapters, contents, terminal_text, write_pages
from coframe.course.isolation import isolation_problem
from coframe.course.roster import read_roster
from coframe.course.rubric import CRITERIA
from coframe.course.running import COMPLETE_TREE_FILES, NODE_FILES, programs_of, running, simulation
from coframe.course.submitted import check_outputs
from coframe.course.translation.catalogue import languages
from coframe.course.translation.language import choose_language
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from coframe.course.running import NamedCommand
    from coframe.course.translation.language import Language

__all__ = ["lab"]

# Each program should have published something within this time after the last node joined, in seconds.
_FIRST_OUTPUT, _MAX_STARTUP = 8.0, 60.0
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
roster_option = click.option(
    "--roster",
    metavar="FILE",
    type=PATH,
    help="CSV file with the students: columns name, email, id, variant; or the worksheet of Moodle, or of Canvas.",
)
language_option = click.option(
    "--language",
    metavar="CODE",
    help=f"Language of the course: {', '.join(languages())}. "
    "[default: $COFRAME_LANGUAGE, that of the folder, or the locale]",
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
@roster_option
@click.option("--zip", "as_zip", is_flag=True, help="With --roster: create a zip file per student, not a folder.")
@language_option
def new(folder: Path, variant: int | None, roster: Path | None, as_zip: bool, language: str | None) -> None:
    """Create a folder with the files of the lab: stubs with a task in each docstring, an RViz file and a README.

    With --roster, FOLDER gets a folder for each student, each with a variant of its own.

    Example: coframe lab new my_lab --variant 4711
    """
    with run_to_completion(), _in_language(language) as chosen:
        if roster is None and as_zip:
            raise _MisuseError("--zip applies to a class", hint="Add --roster, or omit --zip.")
        if roster is not None and variant is not None:
            raise _MisuseError("--variant and --roster exclude each other", hint="The variants are in the roster.")
        if roster is not None:
            students = read_roster(roster)
            places = create_class(folder, students, as_zip=as_zip, language=chosen)
            for student, place in zip(students.students, places, strict=True):
                print(f"created {printable(str(place))} for {printable(student.name)}, variant {student.variant}")
            return
        for path in create_folder(folder, variant, chosen):
            print(chosen.text(f"created {printable(str(path))}"))
        command = f"coframe lab run {shlex.quote(printable(str(folder)))}"
        print(chosen.text(f"Next: read {printable(str(folder / 'README.md'))}, then run: {command}"))


@lab.command(short_help="Run the nodes of a folder with a simulated robot.")
@folder_argument
@click.option("--complete", is_flag=True, help="Run complete_tf_tree.py instead of the two broadcasters.")
@click.option("--joints", is_flag=True, help="Also publish joint states, which the arm has to follow.")
@click.option("--gripper", is_flag=True, help="Mount the lidar on the moving gripper instead of the base.")
@click.option("--browser/--no-browser", default=True, help="Open the viewer in the browser.")
@port_option
@duration_option
def run(
    folder: Path | None,
    complete: bool,
    joints: bool,
    gripper: bool,
    browser: bool,
    port: int | None,
    duration: NonNegativeDuration | None,
) -> None:
    """Run the nodes of a folder with a simulated lidar, and show them in the viewer.

    The arm moves as step 2 simulates it. With --joints, it has to follow the joint states of the robot: if it jumps
    between two poses, its simulation continues next to them. Each output line has the name of its node. The
    viewer's findings show what is missing.

    Example: coframe lab run my_lab
    """
    seconds = None if duration is None else duration.seconds
    student = _folder(folder)
    with run_until_interrupted(), _in_language(None, recorded_language(student)) as language:
        if complete and joints:
            raise _MisuseError("--joints applies to step 2", hint="Omit it, or omit --complete.")
        programs = programs_of(student, COMPLETE_TREE_FILES if complete else NODE_FILES)
        programs += simulation(joints=joints, gripper=gripper)
        sentence = "Your nodes are running with a simulated robot. Press Ctrl-C to stop them. The viewer shows them:"
        print(language.text(sentence), flush=True)
        _run(programs, seconds, browser=browser, port=port, silence_language=language)


@lab.command(short_help="Grade one student's folder, or a whole class.")
@folder_argument
@click.option("--all", "everyone", is_flag=True, help="Grade all folders and zip files in FOLDER, one per student.")
@click.option("--output", "-o", metavar="FILE", type=PATH, help="With --all: write the grades as a CSV table.")
@click.option(
    "--only", metavar="CRITERION", multiple=True, help=f"Check only this criterion: {', '.join(CRITERIA)}; repeatable."
)
@variant_option
@roster_option
@click.option(
    "--no-roster-variants",
    is_flag=True,
    help="With --roster: use the variants in lab.json, or --variant, and not those of the roster.",
)
@click.option("--resume", is_flag=True, help="With -o: keep the results of an earlier run for unchanged submissions.")
@click.option("--moodle", metavar="FILE", type=PATH, help="With --roster: write the grades for Moodle's gradebook.")
@click.option("--canvas", metavar="FILE", type=PATH, help="With --roster: write the grades for Canvas's gradebook.")
@click.option(
    "--column",
    metavar="NAME",
    default=ASSIGNMENT,
    help="With --canvas: column of the assignment.",
)
@click.option("--feedback", metavar="FOLDER", type=PATH, help="With --all: write a file for each student to FOLDER.")
@click.option(
    "--feedback-format",
    metavar="FORMAT",
    type=click.Choice(FEEDBACK_FORMATS),
    default=FEEDBACK_FORMATS[0],
    help="With --feedback: html, with figures, or txt.",
)
@click.option("--similarity", metavar="FILE", type=PATH, help="With --all: write pairs of similar programs as CSV.")
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
@language_option
def check(
    folder: Path | None,
    everyone: bool,
    output: Path | None,
    only: tuple[str, ...],
    variant: int | None,
    roster: Path | None,
    no_roster_variants: bool,
    resume: bool,
    moodle: Path | None,
    canvas: Path | None,
    column: str,
    feedback: Path | None,
    feedback_format: str,
    similarity: Path | None,
    as_json: bool,
    gradescope: Path | None,
    classroom: Path | None,
    record: Path | None,
    jobs: int,
    language: str | None,
) -> None:
    """Grade the nodes in a folder by what they publish: up to 100 points, plus 10 for each of four extensions.

    The nodes run with a simulated clock and limits on time, memory and output. The exit code is 0 regardless of the
    grade. With --all, each grade is written as soon as it is known, and Ctrl-C keeps what is finished.

    Example: coframe lab check my_lab
    """
    chosen = tuple(only or CRITERIA)
    formatted = ((gradescope, formats.gradescope), (classroom, formats.classroom))
    for_one: dict[str, object] = {"--record": record, "--gradescope": gradescope, "--classroom": classroom}
    for_class: dict[str, object] = {"--roster": roster, "--resume": resume, "--moodle": moodle, "--canvas": canvas}
    for_class |= {"--feedback": feedback, "--similarity": similarity, "-o": output}
    student = _folder(folder)
    with run_to_completion(), _in_language(language, "" if everyone else recorded_language(student)) as spoken:
        _check_criteria(chosen)
        if everyone:
            _check_class_options(for_one, for_class, no_roster_variants=no_roster_variants)
        else:
            _check_options_of_one(for_class, no_roster_variants=no_roster_variants)
        if problem := isolation_problem():
            warn(spoken.text(problem))
        if everyone:
            grade_class(
                ClassOptions(
                    folder or Path("lab"), output, jobs, variant, chosen, roster, resume, moodle, canvas, column,
                    feedback, feedback_format, similarity, as_json, language, no_roster_variants,
                )
            )  # fmt: skip
            return
        check_outputs((record, gradescope, classroom), student)
        try:
            with item_progress("checking", len(chosen)) as progress:
                report = check_folder(student, variant=variant, only=chosen, record=record, progress=progress)
        except CourseError as error:
            _write_reports(formats.ungraded_report(str(student), str(error)), formatted, spoken)
            raise
        _write_reports(report, formatted, spoken)
        if as_json:
            print(json.dumps(report, indent=2))
            return
        for line in formats.text(report, spoken):
            print(printable(line))


def _check_criteria(chosen: Iterable[str]) -> None:
    if unknown := set(chosen) - set(CRITERIA):
        raise _MisuseError(
            f"--only: unknown criterion {', '.join(sorted(unknown))}", hint=f"Criteria: {', '.join(CRITERIA)}."
        )


def _check_class_options(for_one: dict[str, object], for_class: dict[str, object], *, no_roster_variants: bool) -> None:
    """Raise an error if options for one folder are given with --all, or if one option lacks another one."""
    if given := [name for name, value in for_one.items() if value]:
        raise _MisuseError(f"{', '.join(given)}: only for a single folder", hint="Omit it, or omit --all.")
    if (for_class["--moodle"] or for_class["--canvas"]) and not for_class["--roster"]:
        raise _MisuseError("--moodle and --canvas need the students", hint="Add --roster FILE.")
    if no_roster_variants and not for_class["--roster"]:
        raise _MisuseError("--no-roster-variants applies to a roster", hint="Add --roster FILE, or omit it.")
    if for_class["--resume"] and not for_class["-o"]:
        raise _MisuseError("--resume continues an earlier run", hint="Add -o with the file of that run.")


def _check_options_of_one(for_class: dict[str, object], *, no_roster_variants: bool) -> None:
    """Raise an error if options for a class are given for one folder."""
    options = {**for_class, "--no-roster-variants": no_roster_variants}
    if given := [name for name, value in options.items() if value]:
        raise _MisuseError(
            f"{', '.join(given)}: only for a class", hint="Add --all, or use --json for the report of one folder."
        )


def _write_reports(
    report: dict[str, Any],
    formatted: Iterable[tuple[Path | None, Callable[[dict[str, Any], Language], dict[str, Any]]]],
    language: Language,
) -> None:
    for path, convert in formatted:
        if path is not None:
            write_complete(path, f"{json.dumps(convert(report, language), indent=2)}\n".encode())


@lab.command(short_help="Write a package that grades submissions elsewhere.")
@argument("platform", metavar="PLATFORM", type=click.Choice(sorted(PLATFORMS)), help="gradescope, classroom or docker.")
@click.option("--output", "-o", metavar="FOLDER", type=PATH, required=True, help="Folder for the files of the package.")
@click.option("--wheel", metavar="FILE", type=PATH, required=True, help="Wheel of coframe, which the package installs.")
@variant_option
@language_option
def autograder(platform: str, output: Path, wheel: Path, variant: int | None, language: str | None) -> None:
    """Write a complete autograder for Gradescope or GitHub Classroom, or a Docker image that grades a class.

    Example: coframe lab autograder gradescope -o autograder --wheel dist/coframe-1.0-cp312-cp312-linux_x86_64.whl
    """
    with run_to_completion(), _in_language(language) as chosen:
        for path in write_autograder(platform, output, wheel, variant, chosen):
            print(f"created {printable(str(path))}")
        if needs_newest_glibc(wheel):
            warn(
                f"{printable(wheel.name)} may need the C library of the machine that built it, and the grader's may be "
                "older. make wheels names the wheel after the oldest one on which it runs"
            )


@lab.command("break", short_help="Start a system with a fault to diagnose.")
@argument(
    "number",
    metavar="[N]",
    type=click.IntRange(min=1, max=len(FAULTS)),
    required=False,
    help=f"Number of a fault, 1 to {len(FAULTS)}; omit it with --random.",
)
@click.option("--random", "seed", metavar="SEED", help="Draw the fault that belongs to this text, for an examination.")
@click.option("--answer", metavar="FAULT", help="Check this answer instead of starting the system.")
@language_option
@click.option("--browser/--no-browser", help="Open the viewer in the browser; its findings are a hint.")
@port_option
@duration_option
def break_(
    number: int | None,
    seed: str | None,
    answer: str | None,
    language: str | None,
    browser: bool,
    port: int | None,
    duration: NonNegativeDuration | None,
) -> None:
    """Start the robot of the lab with one of its faults. Find it with the viewer, echo, monitor and frames.

    coframe doctor and the viewer's findings count as hints.

    Then give your answer in your own words: coframe lab break N --answer "FAULT".

    Example: coframe lab break 3
    """
    seconds = None if duration is None else duration.seconds
    with run_until_interrupted(), _in_language(language, recorded_language(_folder(None))) as spoken:
        if (number is None) is (seed is None):
            raise _MisuseError("give either a number or --random SEED", hint=f"Numbers: 1 to {len(FAULTS)}.")
        chosen = draw(seed or "") if number is None else number
        words = f"--random {shlex.quote(seed or '')}" if number is None else f"{number}"
        if answer is not None:
            _print_verdict(chosen, answer, spoken)
            return
        print(spoken.text(f"System {words} is running in this ROS domain. What is wrong with it? Stop it with Ctrl-C."))
        print(spoken.text(f'Then answer with: coframe lab break {words} --answer "FAULT", where FAULT is one of:'))
        print(f"  {_fault_names(spoken)}", flush=True)
        _run(FAULTS[chosen - 1].programs, seconds, browser=browser, port=port)


@lab.command(short_help="Read the handbook of the course.")
@argument(
    "chapter",
    metavar="[CHAPTER]",
    type=click.IntRange(min=1),
    required=False,
    help="Number of the chapter. [default: the table of contents]",
)
@click.option("--output", "-o", metavar="FOLDER", type=PATH, help="Write all chapters as web pages with images.")
@click.option("--slides", is_flag=True, help="With -o: also write slides.html, a slide for each section.")
@click.option("--browser/--no-browser", default=True, help="With -o: open the pages in the browser.")
@language_option
def handbook(
    chapter: int | None,
    output: Path | None,
    slides: bool,
    browser: bool,
    language: str | None,
) -> None:
    """Print the table of contents or a chapter of the handbook, or write the handbook as web pages.

    Example: coframe lab handbook -o handbook
    """
    with run_to_completion(), _in_language(language, recorded_language(_folder(None))) as spoken:
        if output is not None:
            _write_handbook(output, chapter, spoken, slides=slides, browser=browser)
            return
        if slides:
            raise _MisuseError("--slides writes a file", hint="Add -o FOLDER.")
        found = {each.number: each for each in chapters()}
        if chapter is not None and chapter not in found:
            raise _MisuseError(f"There is no chapter {chapter}", hint=f"Chapters: 1 to {len(found)}.")
        from rich.markdown import Markdown  # noqa: PLC0415 - only for this text

        file = contents() if chapter is None else found[chapter].file
        console = report_console()
        console.print(
            Markdown(terminal_text(file, spoken), hyperlinks=False), width=min(console.width, _HANDBOOK_WIDTH)
        )
        if chapter is None:
            hint = (
                "Read a chapter: coframe lab handbook 1. With images, in the browser: coframe lab handbook -o handbook"
            )
            print(spoken.text(hint))


def _write_handbook(folder: Path, chapter: int | None, language: Language, *, slides: bool, browser: bool) -> None:
    first = write_pages(folder, slides=slides, language=language)
    page = first if chapter is None else next(folder.glob(f"{chapter:02d}_*.html"), first)
    print(page.resolve())
    if browser and sys.stdout.isatty():
        open_browser(page.resolve().as_uri())


class _MisuseError(CourseError):
    """Options or arguments that do not fit together."""


@contextlib.contextmanager
def _in_language(code: str | None, recorded: str = "") -> Iterator[Language]:
    """Choose the language of a command, in which its errors are raised, too."""
    language = choose_language(code, recorded)
    try:
        yield language
    except _MisuseError as error:
        fail(language.text(str(error)), language.text(error.hint), code=2)
    except CourseError as error:
        raise CourseError(language.text(str(error)), hint=language.text(error.hint)) from None


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
    silence_language: Language | None = None,
) -> None:
    """Run programs and the viewer until Ctrl-C or for a given time, and print the output of the programs.

    With `silence_language`, a message in it about each program that publishes nothing is printed after a few seconds.
    """
    width = max(len(program.name) for program in programs)
    closed = threading.Event()  # The reader of a pipe, such as `head`, closed it.

    def write(name: str, line: str) -> None:
        try:
            print_bounded(f"{name:>{width}} | {printable(line)}")
        except BrokenPipeError:
            closed.set()

    with connect("coframe_lab") as ros, optional_viewer(ros, port, browser=browser), running(programs, write):
        if silence_language and (seconds is None or seconds > _FIRST_OUTPUT):
            started = time.monotonic()
            first = FirstOutput(ros, programs)
            first.wait(closed, _FIRST_OUTPUT, _MAX_STARTUP if seconds is None else min(seconds, _MAX_STARTUP))
            for name, sentence in first.missing():
                write(name, silence_language.text(sentence))
            first.close()
            seconds = None if seconds is None else max(0.0, seconds - (time.monotonic() - started))
        closed.wait(seconds)
    if closed.is_set():
        raise BrokenPipeError


def _fault_names(language: Language) -> str:
    return ", ".join(sorted(language.text(each.name) for each in FAULTS))


def _print_verdict(number: int, answer: str, language: Language) -> None:
    given, fault = named_fault(answer, language), FAULTS[number - 1]
    if given is None:
        raise _MisuseError(f"{answer!r} does not name one fault", hint=f"Faults: {_fault_names(language)}.")
    if given is not fault:
        hint = "Start the system again, and run coframe doctor in a second terminal."
        fail(language.text("The answer is wrong."), language.text(hint))
    print(language.text(f"Right: {fault.explanation}"))
