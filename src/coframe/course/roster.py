# SPDX-License-Identifier: Apache-2.0
"""The students of a class: read from a CSV file, and found by the names of their submissions.

The file can be written by hand, with the columns name, email, id and variant, or come from a learning platform: the
grading worksheet of Moodle, or the exported gradebook of Canvas. Grades can be written back into the same file.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
import zlib
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.regular_files import read_regular
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

__all__ = ["Roster", "Student", "read_roster"]

_MAX_BYTES = 10 << 20
_MAX_STUDENTS = 10_000
_MAX_KEY = 60  # characters of the name of a folder
_VARIANTS = 1 << 20
# What a column contains, and its names in files of teachers, Moodle (English and German) and Canvas, in lower case.
_COLUMNS = {
    "name": ("name", "full name", "student", "vollständiger name", "student name"),
    "first": ("first name", "firstname", "vorname"),
    "last": ("last name", "lastname", "surname", "nachname"),
    "email": ("email", "e-mail", "email address", "e-mail-adresse", "mail"),
    "number": ("id number", "idnumber", "sis user id", "student id", "matrikelnummer", "id-nummer"),
    "login": ("login", "sis login id", "username", "login id", "anmeldename"),
    "participant": ("identifier", "teilnehmer/in", "bezeichner", "identifikator"),
    "variant": ("variant", "seed"),
    "status": ("status",),
}
_MOODLE_FOLDER = re.compile(r"(?P<name>.+)_(?P<number>\d+)_assignsubmission_[a-z]+_?")
_CANVAS_NAME = re.compile(r"(?P<name>.+)_(?P<number>\d+)")
_POINTS_ROW = "points possible"  # the second row of a gradebook of Canvas


class Student(NamedTuple):
    """A student.

    Attributes:
        key: The name of the student's folder: unique, in lower case, without special characters.
        name: The full name.
        email: The e-mail address, or "".
        number: The number of the student at the university, or "".
        login: The login, or "".
        participant: The number of the student on the learning platform, or "".
        variant: The variant of the assignment.
        is_late: Whether the learning platform reports a late submission.
        row: The row of the file.
    """

    key: str
    name: str
    email: str
    number: str
    login: str
    participant: str
    variant: int
    is_late: bool
    row: Mapping[str, str]


class Roster(NamedTuple):
    """The students of a class.

    Attributes:
        students: The students in the order of the file.
        columns: The columns of the file.
        points: The row with the possible points, in the second line of a gradebook of Canvas, or None.
    """

    students: tuple[Student, ...]
    columns: tuple[str, ...]
    points: Mapping[str, str] | None = None

    def find(self, submission: str) -> Student | None:
        """Return the student of a submission, given the name of its folder or file, or None if no student matches.

        The names of Moodle and Canvas contain the number of the student on the platform, which is preferred.
        """
        match = _MOODLE_FOLDER.fullmatch(submission) or _CANVAS_NAME.fullmatch(submission)
        if match is not None:
            by_number = [each for each in self.students if each.participant == match["number"]]
            if len(by_number) == 1:
                return by_number[0]
        letters = _letters(match["name"] if match else submission)
        found = [each for each in self.students if letters in _identities(each)]
        return found[0] if len(found) == 1 else None


def read_roster(path: Path) -> Roster:
    """Return the students in a CSV file, separated by commas, semicolons or tabs.

    Raises:
        CourseError: The file cannot be read, has no column with names, or two students with the same key.
    """
    try:
        text = _decode(read_regular(path, _MAX_BYTES))
    except OSError as error:
        raise CourseError(f"Cannot read {path}: {error.strerror}.", hint=_HINT) from None
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=_delimiter(text), restval="")
    try:
        rows = [{key: value or "" for key, value in row.items() if isinstance(key, str)} for row in reader]
    except csv.Error as error:
        raise CourseError(f"{path} is not a CSV file: {error}.", hint=_HINT) from None
    columns = tuple(reader.fieldnames or ())
    found = _find_columns(columns)
    if not ({"name", "email"} & found.keys() or {"first", "last"} <= found.keys()):
        raise CourseError(f"{path} has no column with names; its columns: {', '.join(columns) or 'none'}.", hint=_HINT)
    if len(rows) > _MAX_STUDENTS:
        raise CourseError(f"{path} has more than {_MAX_STUDENTS} students.", hint="Split it into several files.")
    points = next((row for row in rows[:1] if _POINTS_ROW in "".join(row.values()).casefold()), None)
    students = _make_keys_distinct([_student(row, found) for row in rows if row is not points and any(row.values())])
    keys = [each.key for each in students]
    if twice := sorted({key for key in keys if keys.count(key) > 1}):
        raise CourseError(
            f"{path} has several students with the same name: {', '.join(twice)}.",
            hint="Add a column email, or a column id with different numbers.",
        )
    return Roster(tuple(students), columns, points)


_HINT = "The first line names the columns, for example: name,email,id,variant."


def _decode(content: bytes) -> str:
    """Return the text of a file that spreadsheets may have written in another encoding."""
    for encoding in ("utf-8-sig", "utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "cp1252"):
        try:
            return content.decode(encoding)
        except UnicodeDecodeError:
            continue
    return content.decode("utf-8", errors="replace")


def _delimiter(text: str) -> str:
    first = text.partition("\n")[0]
    return max(",;\t", key=first.count)


def _find_columns(columns: Iterable[str]) -> dict[str, str]:
    """Return the column of each kind of content."""
    columns_by_name = {column.strip().casefold(): column for column in columns}
    found = {
        kind: next(columns_by_name[name] for name in names if name in columns_by_name)
        for kind, names in _COLUMNS.items()
        if any(name in columns_by_name for name in names)
    }
    if "id" in columns_by_name:  # In a gradebook of Canvas, it is the number on the platform.
        found.setdefault("participant" if "student" in columns_by_name else "number", columns_by_name["id"])
    return found


def _student(row: Mapping[str, str], columns: Mapping[str, str]) -> Student:
    def value(kind: str) -> str:
        return row.get(columns[kind], "").strip() if kind in columns else ""

    name = value("name") or f"{value('first')} {value('last')}".strip() or value("email")
    email, number, login = value("email"), value("number"), value("login")
    participant = re.sub(r"^\D*", "", value("participant"))
    key = _key(name) or _key(_other_name(email, login, number, participant))
    given = value("variant")
    variant = int(given) if re.fullmatch(r"-?\d{1,18}", given) else zlib.crc32(key.encode()) % _VARIANTS
    is_late = any(word in value("status").casefold() for word in ("late", "verspätet", "overdue"))
    return Student(key, name, email, number, login, participant, variant, is_late, row)


def _other_name(email: str, login: str, number: str, participant: str) -> str:
    """Return what identifies a student if the name is ambiguous."""
    return email.partition("@")[0] or login or number or participant


def _make_keys_distinct(students: list[Student]) -> list[Student]:
    """Return the students, with longer keys for those with the same name."""
    keys = [each.key for each in students]
    return [
        each
        if keys.count(each.key) == 1
        else each._replace(key=_key(f"{each.key} {_other_name(each.email, each.login, each.number, each.participant)}"))
        for each in students
    ]


def _key(text: str) -> str:
    """Return a text as the name of a folder: letters without accents, digits and underscores.

    Example:
        >>> _key("Jürgen Müßig")
        'jurgen_mussig'
    """
    ascii_text = unicodedata.normalize("NFKD", text.replace("ß", "ss")).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "_", ascii_text.casefold()).strip("_")[:_MAX_KEY]


def _letters(text: str) -> str:
    """Return the letters and digits of a name, to compare names as different platforms write them."""
    return "".join(char for char in unicodedata.normalize("NFC", text).casefold() if char.isalnum())


def _identities(student: Student) -> set[str]:
    """Return everything by which a submission may be named after a student."""
    words = student.name.replace(",", " ").split()
    names = {student.name, " ".join([*words[-1:], *words[:-1]]), " ".join([*words[1:], *words[:1]])}
    names |= {
        student.key,
        student.email,
        student.email.partition("@")[0],
        student.number,
        student.login,
        student.participant,
    }
    return {_letters(each) for each in names if each}
