# SPDX-License-Identifier: Apache-2.0
"""A class: its roster, its submissions as learning platforms deliver them, and the files for gradebooks."""

import csv
import json
import re
import shutil
import stat
import zipfile

import pytest
from click.testing import CliRunner
from grades import SOLUTION  # of this folder

from coframe.cli.app import app
from coframe.course.assignment import read_assignment
from coframe.course.autograder import write_autograder
from coframe.course.class_folder import MAX_EXTRACTED, submissions
from coframe.course.class_journal import Journal, fingerprint
from coframe.course.gradebooks import StudentGrade, canvas_table, moodle_table
from coframe.course.roster import read_roster
from coframe.course.similarity import similarities
from coframe.errors import CourseError

URDF = "arm.urdf"
ROSTER = """name,email,id,variant
Ada Lovelace,ada@example.org,1001,7
Jürgen Müßig,jm@example.org,12345,
Zoë Ångström,zoe@example.org,12346,
Bob Missing,bob@example.org,12347,
"""
WORKSHEET = """Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,Feedback comments
Participant 12345,Jürgen Müßig,jm@example.org,Submitted for grading - late,,100.00,Yes,
Participant 12346,Zoë Ångström,zoe@example.org,Submitted for grading,,100.00,Yes,
Participant 12347,Bob Missing,bob@example.org,No submission,,100.00,Yes,
"""
GRADEBOOK = """Student,ID,SIS User ID,SIS Login ID,Section,Lab 09-02 (777),Quiz (778)
    Points Possible,,,,,100,10
"Müßig, Jürgen",42,s42,jm,A,,5
"Lovelace, Ada",43,s43,ada,A,,6
"""


def lab_zip(path, names=(URDF,), folder="lab/"):
    """Write a zip file with files of the solution."""
    with zipfile.ZipFile(path, "w") as archive:
        for name in names:
            archive.write(SOLUTION / name, f"{folder}{name}")


def roster_of(text, tmp_path, encoding="utf-8"):
    (tmp_path / "roster.csv").write_bytes(text.encode(encoding))
    return read_roster(tmp_path / "roster.csv")


def grade(folder, tmp_path, *words):
    """Grade a class, and return the rows of its table and the output."""
    table = tmp_path / "grades.csv"
    result = CliRunner().invoke(app, ["lab", "check", "--all", str(folder), "--only", "urdf", "-o", str(table), *words])
    assert result.exit_code == 0, result.output
    with table.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines)), result.output


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
def test_a_roster_is_read_as_spreadsheets_write_it(encoding, tmp_path):
    students = roster_of(ROSTER, tmp_path, encoding).students
    assert [each.key for each in students] == ["ada_lovelace", "jurgen_mussig", "zoe_angstrom", "bob_missing"]
    assert students[0].variant == 7
    assert len({each.variant for each in students}) == 4
    semicolons = roster_of(ROSTER.replace(",", ";"), tmp_path).students
    assert [each[:7] for each in semicolons] == [each[:7] for each in students]


def test_a_roster_that_cannot_be_used_is_explained(tmp_path):
    for text, sentence in (
        ("a,b\n1,2\n", "has no column with names; its columns: a, b"),
        ("name\nAda\nAda\n", "several students with the same name: ada"),
        ("", "has no column with names; its columns: none"),
    ):
        with pytest.raises(CourseError, match=re.escape(sentence)):
            roster_of(text, tmp_path)
    same = roster_of("name,email\nKim Lee,kim1@x.org\nKim Lee,kim2@x.org\n", tmp_path).students
    assert [each.key for each in same] == ["kim_lee_kim1", "kim_lee_kim2"]


def test_submissions_are_found_by_all_that_names_a_student(tmp_path):
    roster = roster_of(ROSTER, tmp_path)
    for name in ("Ada Lovelace", "lovelaceada", "ada_lovelace", "ada@example.org", "1001", "Lovelace, Ada"):
        assert roster.find(name).name == "Ada Lovelace", name
    assert roster.find("Jürgen Müßig_999_assignsubmission_file_").name == "Jürgen Müßig"
    assert roster.find("unknown person") is None
    assert roster_of(WORKSHEET, tmp_path).find("Other Name_12346_assignsubmission_file_").name == "Zoë Ångström"
    canvas = roster_of(GRADEBOOK, tmp_path)
    assert [each.participant for each in canvas.students] == ["42", "43"]  # not the row with the possible points
    assert canvas.find("mussigjurgen_42").name == "Müßig, Jürgen"


def test_each_student_gets_a_folder_or_a_zip_file_with_a_variant(tmp_path):
    roster = roster_of(ROSTER, tmp_path)
    words = ["lab", "new", str(tmp_path / "folders"), "--roster", str(tmp_path / "roster.csv")]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    for student in roster.students:
        assert read_assignment(tmp_path / "folders" / student.key).variant == student.variant
    assert CliRunner().invoke(app, words).exit_code == 1  # Nothing is overwritten.
    words[2] = str(tmp_path / "archives")
    assert CliRunner().invoke(app, [*words, "--zip"]).exit_code == 0
    with zipfile.ZipFile(tmp_path / "archives" / "ada_lovelace.zip") as archive:
        assert json.loads(archive.read("ada_lovelace/lab.json"))["variant"] == 7


@pytest.fixture
def delivered(tmp_path):
    """A class as Moodle and Canvas deliver it, with repeated and late attempts."""
    place = tmp_path / "class"
    moodle = place / "Jürgen Müßig_12345_assignsubmission_file_"
    moodle.mkdir(parents=True)
    lab_zip(moodle / "my lab.zip")
    nested = place / "Zoë Ångström_12346_assignsubmission_file_" / "sub mission" / "lab"
    nested.mkdir(parents=True)
    shutil.copy(SOLUTION / URDF, nested)
    (place / "Zoë Ångström_12346_assignsubmission_file_" / "__MACOSX").mkdir()
    lab_zip(place / "ada_lovelace.zip")
    (place / "doejane_51_900_arm.urdf").write_text("<robot")
    (place / "doejane_LATE_51_901_arm-1.urdf").write_bytes((SOLUTION / URDF).read_bytes())
    lab_zip(place / "poejoe_52_902_lab.zip", folder="")
    return place


def test_submissions_are_found_as_platforms_deliver_them(delivered, tmp_path):
    found = submissions(delivered, tmp_path / "scratch")
    assert sorted(found) == [
        "Jürgen Müßig_12345_assignsubmission_file_",
        "Zoë Ångström_12346_assignsubmission_file_",
        "ada_lovelace",
        "doejane_51",
        "poejoe_52",
    ]
    assert all((each.folder / URDF).is_file() for each in found.values())
    assert (found["doejane_51"].attempts, found["doejane_51"].is_late) == (2, True)
    shutil.make_archive(str(tmp_path / "download"), "zip", delivered)
    assert sorted(submissions(tmp_path / "download.zip", tmp_path / "again")) == sorted(found)


@pytest.mark.slow
def test_a_class_is_graded_resumed_and_exported(delivered, tmp_path):
    (tmp_path / "roster.csv").write_text(ROSTER, encoding="utf-8")
    files = {name: tmp_path / f"{name}.csv" for name in ("moodle", "canvas", "similarity")}
    options = [word for name, path in files.items() for word in (f"--{name}", str(path))]
    options += ["--roster", str(tmp_path / "roster.csv"), "--feedback", str(tmp_path / "feedback")]
    rows, _ = grade(delivered, tmp_path, *options)
    by_student = {row["student"]: row for row in rows if row["student"]}
    assert {name: row["attempts"] for name, row in by_student.items()} == {
        "Ada Lovelace": "1",
        "Jürgen Müßig": "1",
        "Zoë Ångström": "1",
        "Bob Missing": "0",
    }
    # The solution has the lab's numbers, but each student of the roster has a variant.
    assert all(0 < float(by_student[name]["bonus"]) < 10 for name in ("Ada Lovelace", "Jürgen Müßig", "Zoë Ångström"))
    assert by_student["Bob Missing"]["problem"] == "There is no submission."
    others = {row["submission"]: row for row in rows if not row["student"]}
    assert others["doejane_51"]["late"] == "yes"
    assert others["poejoe_52"]["problem"].startswith("This submission is of none of the students")
    assert float(others["poejoe_52"]["bonus"]) == 10
    check_moodle_import(files["moodle"])
    check_canvas_import(files["canvas"])
    page = (tmp_path / "feedback" / "ada_lovelace.html").read_text(encoding="utf-8")
    assert "Ada Lovelace" in page
    assert page.count("<svg") >= 3  # the bars, and the figure of a chapter
    journal = tmp_path / "grades.jsonl"
    before = journal.read_text()
    shutil.rmtree(delivered / "Zoë Ångström_12346_assignsubmission_file_" / "sub mission")
    again, _ = grade(delivered, tmp_path, *options, "--resume")
    assert journal.read_text().startswith(before)
    assert journal.read_text().count("\n") == before.count("\n") + 1  # Only the changed submission was graded again.
    assert [row["submission"] for row in again] == [row["submission"] for row in rows]


def check_moodle_import(path):
    """Check a file by the rules of the import of Moodle's gradebook: a column that identifies users, and numbers."""
    with path.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert len({row["Email address"] for row in rows}) == len(rows) == 4
    for row in rows:
        assert "@" in row["Email address"]
        assert row["Lab 09-02"] == "" or 0 <= float(row["Lab 09-02"]) <= 140
    assert next(row for row in rows if row["Full name"] == "Bob Missing")["Lab 09-02"] == ""


def check_canvas_import(path):
    """Check a file by the rules of Canvas: five columns that identify students, the points in the second row."""
    with path.open(encoding="utf-8", newline="") as lines:
        table = list(csv.reader(lines))
    assert table[0][:5] == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
    assert table[1][0].strip() == "Points Possible"
    assert all(len(row) == len(table[0]) for row in table)
    assert all(row[0] and (row[5] == "" or float(row[5]) >= 0) for row in table[2:])


def test_one_folder_for_all_students_does_not_fit_the_variants_of_a_roster(tmp_path):
    for name in ("Ada Lovelace", "Zoë Ångström", "Bob Missing"):
        (tmp_path / "class" / name).mkdir(parents=True)
    (tmp_path / "roster.csv").write_text(ROSTER, encoding="utf-8")
    words = ("--roster", str(tmp_path / "roster.csv"))
    rows, output = grade(tmp_path / "class", tmp_path, *words)
    assert "3 of 3 submissions have a different variant in lab.json than in the roster" in output
    assert {row["variant"] for row in rows} == {
        str(each.variant) for each in read_roster(tmp_path / "roster.csv").students
    }
    rows, output = grade(tmp_path / "class", tmp_path, *words, "--no-roster-variants")
    assert "different variant" not in output
    assert [row["variant"] for row in rows[:3]] == ["", "", ""]


def test_the_worksheets_of_platforms_are_filled_in(tmp_path):
    moodle = roster_of(WORKSHEET, tmp_path)
    table = moodle_table(
        moodle, [StudentGrade(moodle.students[0], 87.5, "good"), StudentGrade(moodle.students[2], None)]
    )
    assert table.columns == list(moodle.columns)
    assert table.rows[0] == dict(moodle.students[0].row) | {"Grade": "87.50", "Feedback comments": "good"}
    assert table.rows[1] == dict(moodle.students[2].row)  # A student without a submission keeps an empty grade.
    canvas = roster_of(GRADEBOOK, tmp_path)
    table = canvas_table(canvas, [StudentGrade(canvas.students[0], 12.0)], "Lab 09-02")
    assert table.columns[-1] == "Lab 09-02 (777)"  # with the number, so that no new assignment is created
    assert table.rows[1]["ID"] == "42"
    assert table.rows[1]["Lab 09-02 (777)"] == "12"


def hostile(path, entries):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for entry, content in entries:
            archive.writestr(entry, content)


def test_zip_files_are_not_trusted(tmp_path):
    place = tmp_path / "class"
    place.mkdir()
    link = zipfile.ZipInfo("arm.urdf")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    hostile(place / "link.zip", [(link, "/etc/passwd")])
    hostile(place / "outside.zip", [("../../escaped", "x"), ("/absolute", "x"), ("ok.py", "x")])
    hostile(place / "bomb.zip", [("arm.urdf", bytes(MAX_EXTRACTED + 1))])
    hostile(place / "many.zip", [(f"{number}.txt", "") for number in range(3000)])
    (place / "broken.zip").write_bytes(b"PK\3\4 nothing")
    found = submissions(place, tmp_path / "scratch")
    assert not list(tmp_path.glob("escaped*"))
    assert not any(path.is_symlink() for path in (tmp_path / "scratch").rglob("*"))
    assert "maximum of 50 MB" in found["bomb"].problem
    assert "3000 files" in found["many"].problem
    assert "not a zip file" in found["broken"].problem
    assert (found["link"].problem, found["outside"].problem) == ("", "")


def test_a_damaged_journal_keeps_its_complete_lines(tmp_path):
    journal = Journal(tmp_path / "grades.jsonl")
    assert journal.results() == {}
    journal.add("ada", "key", {"earned": 3})
    with journal.path.open("a") as file:
        file.write('{"submission": "bob", "key": "k", "rep')
    assert journal.results() == {"ada": {"key": "key", "report": {"earned": 3}}}
    (tmp_path / "lab").mkdir()
    first = fingerprint(tmp_path / "lab", [1])
    (tmp_path / "lab" / "x").write_text("x")
    assert len({first, fingerprint(tmp_path / "lab", [1]), fingerprint(tmp_path / "lab", [2])}) == 3


def test_copied_programs_are_found_even_if_names_and_comments_differ(tmp_path):
    for name in ("ada", "bob", "chen", "stub"):
        (tmp_path / name).mkdir()
    text = (SOLUTION / "dynamic_tf_broadcaster.py").read_text()
    (tmp_path / "ada" / "dynamic_tf_broadcaster.py").write_text(text)
    changed = "# my own work\n" + text.replace("followed", "obeys").replace("angles", "values").replace("make", "build")
    (tmp_path / "bob" / "dynamic_tf_broadcaster.py").write_text(changed)
    (tmp_path / "chen" / "dynamic_tf_broadcaster.py").write_text((SOLUTION / "sensor_transform.py").read_text())
    CliRunner().invoke(app, ["lab", "new", str(tmp_path / "stub" / "lab")])
    shutil.copy(tmp_path / "stub" / "lab" / "dynamic_tf_broadcaster.py", tmp_path / "stub")
    found = similarities({name: tmp_path / name for name in ("ada", "bob", "chen", "stub")})
    assert [(each.first, each.second, each.share > 0.95, each.same_names) for each in found] == [
        ("ada", "bob", True, False)
    ]


@pytest.fixture
def wheel(tmp_path):
    path = tmp_path / "coframe-1.2-cp311-cp311-linux_x86_64.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("coframe/__init__.py", "")
    return path


def test_autograders_contain_all_that_they_need(wheel, tmp_path):
    archive_path, *_ = write_autograder("gradescope", tmp_path / "g", wheel, 7)
    with zipfile.ZipFile(archive_path) as archive:
        assert set(archive.namelist()) == {"setup.sh", "run_autograder", wheel.name}
        for name in ("setup.sh", "run_autograder"):
            assert archive.getinfo(name).external_attr >> 16 & 0o111, "Gradescope executes it"
            assert archive.read(name).startswith(b"#!/usr/bin/env bash\n")
        assert f"/autograder/source/{wheel.name}[all]".encode() in archive.read("setup.sh")
        assert b"python3.11" in archive.read("setup.sh")
        assert b"--variant=7 --gradescope /autograder/results/results.json" in archive.read("run_autograder")
    workflow, copied = write_autograder("classroom", tmp_path / "c", wheel)
    yaml = pytest.importorskip("yaml")
    steps = yaml.safe_load(workflow.read_text())["jobs"]["lab"]["steps"]
    assert any(f".github/classroom/{wheel.name}" in step.get("run", "") for step in steps)
    assert copied.read_bytes() == wheel.read_bytes()
    assert steps[-1]["env"]["LAB_RESULTS"] == "${{ steps.lab.outputs.result }}"
    dockerfile, _ = write_autograder("docker", tmp_path / "d", wheel)
    assert "FROM python:3.11-slim" in dockerfile.read_text()
    for option in ("seccomp", "apparmor", "systempaths"):  # each of them forbids mounts or /proc in a namespace
        assert f"--security-opt {option}=unconfined" in dockerfile.read_text()
    with pytest.raises(CourseError, match="already exists"):
        write_autograder("docker", tmp_path / "d", wheel)
    with pytest.raises(CourseError, match="is not a wheel of coframe"):
        write_autograder("docker", tmp_path / "e", tmp_path / "numpy-1.whl")


@pytest.mark.parametrize(
    ("platform", "tags", "problem"),
    [
        ("gradescope", "cp311-cp311-manylinux_2_28_aarch64", "gradescope runs Linux with glibc on x86_64"),
        ("gradescope", "cp311-cp311-musllinux_1_2_x86_64", "runs Linux with glibc"),
        ("classroom", "cp311-cp311-linux_aarch64", "classroom runs Linux with glibc on x86_64"),
        ("classroom", "cp311-cp311-macosx_11_0_x86_64", "classroom runs Linux"),
        ("docker", "cp311-cp311-manylinux_2_28_armv7l", "on x86_64 or aarch64"),
        ("docker", "pp310-pypy310_pp73-linux_x86_64", "the graders run CPython"),
        ("docker", "cp313-cp313t-linux_x86_64", "with ABI cp313t"),
        ("docker", 'cp313-cp313-linux_x86_64"$(id)"', "is not a wheel of coframe"),
        ("docker", "cp311-cp311-manylinux_2_28_aarch64", ""),
        ("gradescope", "cp311-cp311-manylinux_2_17_x86_64.manylinux2014_x86_64", ""),
        ("gradescope", "cp311-abi3-manylinux_2_28_x86_64", ""),
    ],
)
def test_a_wheel_must_fit_the_grader(wheel, tmp_path, platform, tags, problem):
    given = wheel.rename(tmp_path / f"coframe-1.2-{tags}.whl")
    result = CliRunner().invoke(app, ["lab", "autograder", platform, "-o", str(tmp_path / "o"), "--wheel", str(given)])
    assert (result.exit_code, (tmp_path / "o").exists()) == ((1, False) if problem else (0, True)), result.output
    assert problem in " ".join(result.output.split())
    assert "C library" not in result.output


def test_a_wheel_of_this_machine_or_of_another_project_is_noticed(wheel, tmp_path):
    words = ["lab", "autograder", "docker", "-o", str(tmp_path / "o"), "--wheel", str(wheel)]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0
    assert "may need the C library of the machine that built it" in " ".join(result.output.split())
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("numpy/__init__.py", "")
    other = CliRunner().invoke(app, [*words[:4], str(tmp_path / "p"), *words[5:]])
    assert (other.exit_code, (tmp_path / "p").exists()) == (1, False)
    assert "is not a wheel of coframe" in " ".join(other.output.split())


def test_options_of_a_class_need_each_other(tmp_path):
    for words, sentence in (
        (["--roster", "x.csv"], "--roster: only for a class"),
        (["--all", "--moodle", "x.csv"], "need the students"),
        (["--all", "--resume"], "continues an earlier run"),
        (["--all", "--record", "x"], "--record: only for a single folder"),
    ):
        result = CliRunner().invoke(app, ["lab", "check", str(tmp_path), *words])
        assert result.exit_code == 2
        assert sentence in result.output
