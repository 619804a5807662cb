# SPDX-License-Identifier: Apache-2.0
"""``coframe lab check --all``: grades a class, and writes the grades as they are known."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.complete_files import write_complete
from coframe._files.temporary_folders import temporary_folder
from coframe._output.escaping import csv_cell
from coframe.cli.output import printable, report_console, warn
from coframe.cli.progress import item_progress
from coframe.course import formats
from coframe.course.assignment import read_assignment, recorded_language
from coframe.course.checking import check_class
from coframe.course.class_folder import Submission, submissions
from coframe.course.class_journal import Journal, fingerprint
from coframe.course.feedback import feedback
from coframe.course.gradebooks import StudentGrade, Table, canvas_table, moodle_table
from coframe.course.roster import Roster, Student, read_roster
from coframe.course.similarity import similarities
from coframe.course.submitted import check_outputs
from coframe.course.translation.language import choose_language
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from coframe.course.translation.language import Language
__all__ = ["ClassOptions", "grade_class"]

_MISSING = "There is no submission."
_MIN_SUBMISSIONS = 3  # to which the roster is compared


class ClassOptions(NamedTuple):
    """The options of ``coframe lab check --all``.

    Attributes:
        folder: The folder of the class, or a zip file of it.
        output: The CSV file for the grades, or None.
        jobs: Number of submissions to grade in parallel.
        variant: The variant of all submissions, or None.
        only: The criteria to check.
        roster: The students, or None.
        resume: Whether to keep the results of an earlier run.
        moodle: The file for Moodle's gradebook, or None.
        canvas: The file for Canvas's gradebook, or None.
        column: The column of the assignment in Canvas.
        feedback: The folder for the feedback to each student, or None.
        feedback_format: One of FEEDBACK_FORMATS.
        similarity: The CSV file for similar programs, or None.
        as_json: Whether to print all reports.
        language: The code of the language of the feedback, or None for that of each folder.
        no_roster_variants: Whether the variants are those in lab.json, or `variant`, and not those of the roster.
    """

    folder: Path
    output: Path | None
    jobs: int
    variant: int | None
    only: tuple[str, ...]
    roster: Path | None
    resume: bool
    moodle: Path | None
    canvas: Path | None
    column: str
    feedback: Path | None
    feedback_format: str
    similarity: Path | None
    as_json: bool
    language: str | None
    no_roster_variants: bool


def grade_class(options: ClassOptions) -> None:
    """Grade the submissions of a class, and write all files."""
    roster = None if options.roster is None else read_roster(options.roster)
    with temporary_folder("coframe-class-") as scratch:
        grading = _Grading(options, roster, submissions(options.folder, Path(scratch)))
        if problem := grading.variants_warning(choose_language(options.language)):
            warn(problem)
        try:
            grading.run()
        finally:
            grading.write_files()
    if options.as_json:
        print(json.dumps(dict(sorted(grading.reports.items())), indent=2))
    else:
        _print_table(grading.table())


class _Grading:
    """The grading of a class: its reports so far, and the files that are made from them."""

    def __init__(self, options: ClassOptions, roster: Roster | None, submissions: dict[str, Submission]) -> None:
        self.options = options
        self.roster = roster
        self.submissions = submissions
        self.reports: dict[str, dict[str, Any]] = {}
        self.students = {name: None if roster is None else roster.find(name) for name in submissions}
        self.variants = {name: self._variant(name) for name in submissions}
        self.journal = None if options.output is None else Journal(options.output.with_suffix(".jsonl"))
        outputs = (options.output, options.moodle, options.canvas, options.similarity, options.feedback)
        for each in submissions.values():
            check_outputs(outputs, each.folder)

    def _variant(self, name: str) -> int | None:
        student = self.students[name]
        return self.options.variant if student is None or self.options.no_roster_variants else student.variant

    def variants_warning(self, language: Language) -> str:
        """Return a warning if most submissions have another variant in lab.json than in the roster, or ""."""
        known = [name for name, student in self.students.items() if student is not None]
        other = [name for name in known if not self._has_variant(name)]
        if self.options.no_roster_variants or len(known) < _MIN_SUBMISSIONS or 2 * len(other) <= len(known):
            return ""
        return language.text(
            f"{len(other)} of {len(known)} submissions have a different variant in lab.json than in the roster, whose "
            "variants count. If the students did not get the folders of coframe lab new --roster, add "
            "--no-roster-variants."
        )

    def _has_variant(self, name: str) -> bool:
        """Return whether a submission has the variant with which it is graded, or none that can be read."""
        try:
            found = read_assignment(self.submissions[name].folder)
        except CourseError:
            return True
        return found.variant == self.variants[name]

    def run(self) -> None:
        """Grade what is not yet known. Each result is written when it is known."""
        left = dict(self.submissions)
        if self.journal is not None:
            if self.options.resume:
                known = self.journal.results()
                self.reports = {
                    name: known[name]["report"]
                    for name in left
                    if name in known and known[name]["key"] == self._key(name)
                }
                left = {name: each for name, each in left.items() if name not in self.reports}
            else:
                self.journal.clear()
        self.write_table()
        with item_progress("checking", len(self.submissions)) as progress:
            progress(len(self.reports))

            def done(name: str, result: dict[str, Any] | CourseError, is_complete: bool) -> None:
                report = result if isinstance(result, dict) else formats.ungraded_report(name, str(result))
                if not is_complete:
                    report["notices"] = [*report["notices"], formats.UNFINISHED_NOTICE]
                self.reports[name] = report
                if self.journal is not None and is_complete:
                    self.journal.add(name, self._key(name), report)
                self.write_table()
                progress(len(self.reports))

            check_class(left, done, jobs=self.options.jobs, variants=self.variants, only=self.options.only)

    def _key(self, name: str) -> str:
        """Return what identifies the result of a submission: its files, its variant and the criteria."""
        each = self.submissions[name]
        return fingerprint(each.folder, [self.variants[name], *self.options.only, each.problem])

    def table(self) -> Table:
        """Return the grades: a row for each submission, and for each student of the roster."""
        rows = [self._row(name) for name in sorted(self.reports)]
        if self.roster is not None:
            present = {student.key for student in self.students.values() if student is not None}
            rows += [_missing_row(each) for each in self.roster.students if each.key not in present]
        columns = list(dict.fromkeys(column for row in rows for column in row if column != "problem"))
        return Table([*columns, "problem"], rows)

    def _row(self, name: str) -> dict[str, Any]:
        row = formats.csv_row(name, self.reports[name])
        if self.roster is None:
            return row
        student, submission = self.students[name], self.submissions[name]
        late = submission.is_late or (student is not None and student.is_late)
        problem = row.pop("problem")
        if student is None:
            problem = f"This submission is of none of the students of the roster. {problem}".strip()
        who = {"student": "", "email": "", "number": ""} if student is None else _who(student)
        return {**row, **who, "late": "yes" if late else "", "attempts": submission.attempts, "problem": problem}

    def write_table(self) -> None:
        """Write the table of grades, if a file is given."""
        if self.options.output is not None:
            table = self.table()
            _write_csv(self.options.output, table._replace(columns=table.columns or ["submission", "problem"]))

    def write_files(self) -> None:
        """Write the files for gradebooks, the feedback, and the similar programs."""
        options = self.options
        grades = self._student_grades()
        if self.roster is not None and options.moodle is not None:
            _write_csv(options.moodle, moodle_table(self.roster, grades))
        if self.roster is not None and options.canvas is not None:
            _write_csv(options.canvas, canvas_table(self.roster, grades, options.column))
        if options.feedback is not None:
            self._write_feedback(options.feedback)
        if options.similarity is not None:
            folders = {name: each.folder for name, each in self.submissions.items() if not each.problem}
            found = [each._asdict() for each in similarities(folders)]
            _write_csv(options.similarity, Table(["first", "second", "file", "share", "same_names"], found))

    def _student_grades(self) -> list[StudentGrade]:
        """Return the grade of each student of the roster, whose best submission counts."""
        by_key: dict[str, tuple[str, dict[str, Any]]] = {}
        for name, report in self.reports.items():
            student = self.students[name]
            if student is not None and report["earned"] >= by_key.get(student.key, (name, report))[1]["earned"]:
                by_key[student.key] = name, report
        students = () if self.roster is None else self.roster.students
        return [
            StudentGrade(each, total(by_key[each.key][1]), self._total_line(*by_key[each.key]))
            if each.key in by_key
            else StudentGrade(each, None)
            for each in students
        ]

    def _total_line(self, name: str, report: dict[str, Any]) -> str:
        return formats.total_line(report, self._language(name))

    def _language(self, name: str) -> Language:
        """Return the language of the feedback for a submission."""
        return choose_language(self.options.language, recorded_language(self.submissions[name].folder))

    def _write_feedback(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        for name, report in self.reports.items():
            student = self.students[name]
            title, key = (name, name) if student is None else (student.name, student.key)
            text = feedback(title, report, self.options.feedback_format, self._language(name))
            path = folder / f"{_safe_name(key)}.{self.options.feedback_format}"
            write_complete(path, text.encode(errors="backslashreplace"))


def total(report: dict[str, Any]) -> float:
    """Return the points of a report with those of the extensions."""
    return float(round(report["earned"] + report["bonus"], 2))


def _who(student: Student) -> dict[str, Any]:
    return {"student": student.name, "email": student.email, "number": student.number}


def _missing_row(student: Student) -> dict[str, Any]:
    row = {"submission": "", "variant": student.variant, "grade": 0.0, "bonus": 0.0}
    return {**row, **_who(student), "late": "", "attempts": 0, "problem": _MISSING}


def _safe_name(name: str) -> str:
    """Return the name of a submission as the name of a file."""
    return "".join(char if char.isalnum() or char in "-_." else "_" for char in name).lstrip(".") or "_"


def _write_csv(path: Path, table: Table) -> None:
    """Write a table; names of submissions may contain invalid UTF-8, and formulas of spreadsheets."""
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, table.columns, restval=0.0, extrasaction="ignore")
    writer.writeheader()
    writer.writerows({key: csv_cell(value) for key, value in row.items()} for row in table.rows)
    write_complete(path, text.getvalue().encode("utf-8", errors="backslashreplace"))


def _print_table(table: Table) -> None:
    from rich.table import Table as RichTable  # noqa: PLC0415 - only for this table

    columns = _narrow([column for column in table.columns if column != "problem"], table.rows)
    drawn = RichTable(box=None, pad_edge=False, header_style="dim")
    for column in columns:
        is_text = column in {"submission", "student"}
        drawn.add_column(column, justify="left" if is_text else "right", overflow="fold" if is_text else "ellipsis")
    for row in table.rows:
        cells = (row.get(column, 0.0) for column in columns)
        drawn.add_row(*("" if cell is None else printable(str(cell)) for cell in cells))
    report_console().print(drawn)


def _narrow(columns: Sequence[str], rows: Iterable[dict[str, Any]]) -> list[str]:
    """Return the columns that fit the terminal: names and grades first, then the criteria in their order."""
    kept, left = [], report_console().width
    found = list(rows)
    for column in columns:
        width = max([len(column), *(len(printable(str(row.get(column, "")))) for row in found)]) + 1
        if column in {"submission", "grade", "bonus"} or width <= left:
            kept.append(column)
            left -= width
    return kept
