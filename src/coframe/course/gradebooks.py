# SPDX-License-Identifier: Apache-2.0
"""Grades in the files that the gradebooks of Moodle and Canvas import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.course.roster import Roster, Student

__all__ = ["ASSIGNMENT", "StudentGrade", "Table", "canvas_table", "moodle_table"]

ASSIGNMENT = "Lab 09-02"
_IDENTIFIERS = ("identifier", "bezeichner", "teilnehmer/in", "identifikator")
_GRADE_COLUMNS = ("grade", "bewertung")
_FEEDBACK_COLUMNS = ("feedback comments", "feedback als kommentar")
_CANVAS_COLUMNS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")


class StudentGrade(NamedTuple):
    """The grade of a student: points, or None without a submission, and a short feedback."""

    student: Student
    points: float | None
    feedback: str = ""


class Table(NamedTuple):
    """A table for a CSV file: its columns, and its rows."""

    columns: list[str]
    rows: list[dict[str, Any]]


def moodle_table(roster: Roster, grades: Iterable[StudentGrade]) -> Table:
    """Return a table that Moodle imports.

    If the roster is the grading worksheet of an assignment, it is filled in ("Upload grading worksheet"). Otherwise the
    table is for the import of the gradebook, which finds students by e-mail address or ID number.
    """
    worksheet = _worksheet_columns(roster)
    if worksheet is None:
        columns = ["ID number", "Full name", "Email address", ASSIGNMENT, "Feedback"]
        return Table(columns, [_gradebook_row(columns, each) for each in grades])
    grade_column, feedback_column = worksheet
    rows = []
    for each in grades:
        row = dict(each.student.row)
        if each.points is not None:
            row[grade_column] = f"{each.points:.2f}"
            if feedback_column:
                row[feedback_column] = each.feedback
        rows.append(row)
    return Table(list(roster.columns), rows)


def _gradebook_row(columns: list[str], grade: StudentGrade) -> dict[str, Any]:
    student = grade.student
    points = "" if grade.points is None else f"{grade.points:.2f}"
    return dict(zip(columns, (student.number, student.name, student.email, points, grade.feedback), strict=True))


def _worksheet_columns(roster: Roster) -> tuple[str, str] | None:
    """Return the columns for the grade and the feedback in a grading worksheet, or None if the roster is none."""
    columns_by_name = {column.strip().casefold(): column for column in roster.columns}
    grade = next((columns_by_name[name] for name in _GRADE_COLUMNS if name in columns_by_name), "")
    is_worksheet = grade and any(name in columns_by_name for name in _IDENTIFIERS)
    return (
        (grade, next((columns_by_name[name] for name in _FEEDBACK_COLUMNS if name in columns_by_name), ""))
        if is_worksheet
        else None
    )


def canvas_table(roster: Roster, grades: Iterable[StudentGrade], column: str = ASSIGNMENT) -> Table:
    """Return a table that the gradebook of Canvas imports.

    Args:
        roster: The students; best the exported gradebook, whose numbers Canvas needs to find the students.
        grades: The grades.
        column: The assignment: its column in the exported gradebook, such as "Lab 09-02 (1234)", or the beginning of
            it. A new name creates a new assignment.
    """
    chosen = next((name for name in roster.columns if name == column or name.startswith(f"{column} (")), column)
    columns = [*_CANVAS_COLUMNS, chosen]
    points = dict.fromkeys(columns, "") | {"Student": "    Points Possible", chosen: "100"}
    rows = [points, *(_canvas_row(chosen, each) for each in grades)]
    return Table(columns, rows)


def _canvas_row(column: str, grade: StudentGrade) -> dict[str, Any]:
    student = grade.student
    row = {name: student.row.get(name, "") for name in _CANVAS_COLUMNS}
    row |= {"Student": row["Student"] or student.name, "ID": row["ID"] or student.participant}
    row |= {"SIS User ID": row["SIS User ID"] or student.number}
    row |= {"SIS Login ID": row["SIS Login ID"] or student.login or student.email}
    return {**row, column: "" if grade.points is None else f"{grade.points:g}"}
