# SPDX-License-Identifier: Apache-2.0
"""Grades of whole folders: the solution, the stubs, and the lab's scripts as they stand."""

import json
import re
import shutil

import pytest
from grades import SOLUTION, lost  # of this folder
from typer.testing import CliRunner

from coframe.cli.app import app
from coframe.course import formats
from coframe.course.assignment import assignment_of, read_assignment
from coframe.course.checking import check_class, check_folder, submissions
from coframe.course.folders import create_folder
from coframe.errors import CourseError

pytestmark = pytest.mark.timeout(300)  # nine programs run one after the other, on a machine that may be busy


@pytest.mark.slow
def test_the_solution_gets_all_points_and_bonus_points():
    report = check_folder(SOLUTION)
    assert [lost(each) for each in report["criteria"]] == [{}] * 9
    assert (report["earned"], report["bonus"]) == (100, 40)


def test_one_criterion_of_the_solution(grade):
    found = grade("static", "urdf")
    assert {file: (each["earned"], each["points"]) for file, each in found.items()} == {
        "static_tf_broadcaster.py": (20, 20),
        "arm.urdf": (10, 10),
    }


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_ten_grades_of_one_folder_are_equal(folder):
    path = folder / "dynamic_tf_broadcaster.py"
    path.write_text(path.read_text().replace("0.3 * math.sin", "0.31 * math.sin"))
    reports = [check_folder(folder, only=("static", "dynamic", "listener")) for _ in range(10)]
    assert len({json.dumps([each["earned"] for each in one["criteria"]]) for one in reports}) == 1


@pytest.mark.slow
def test_the_scripts_of_the_lab(shared, tmp_path):
    folder = shutil.copytree(shared / "lab", tmp_path / "lab")
    found = {each["file"]: each for each in check_folder(folder)["criteria"]}
    static = lost(found["static_tf_broadcaster.py"])
    assert list(static) == ["camera_link is at the right place"]
    assert "0.707" in static["camera_link is at the right place"]["cause"]
    assert list(lost(found["dynamic_tf_broadcaster.py"])) == ["nothing else moves the arm meanwhile"]
    listener = lost(found["tf_listener.py"])
    assert list(listener) == ["each pose is right at its stamp"]
    assert "use transform.header.stamp, not now()" in listener["each pose is right at its stamp"]["cause"]
    sensor = found["sensor_transform.py"]
    assert sensor["earned"] == 0
    assert sensor["problem"].endswith("it has a publisher on /scan_base_frame, but publish() is never called.")
    assert found["complete_tf_tree.py"]["earned"] == 11


@pytest.mark.slow
def test_stubs_run_and_one_sentence_for_each_says_what_is_missing(tmp_path):
    create_folder(tmp_path / "lab", 7)
    report = check_folder(tmp_path / "lab")
    assert (report["variant"], report["earned"], report["bonus"]) == (7, 0, 0)
    for criterion in report["criteria"]:
        assert re.search("publishes nothing|describes no joint yet", criterion["problem"]), criterion["problem"]
    printed = "\n".join(formats.text(report))
    assert "RViz configuration shows nothing of the robot yet" in printed
    assert "expected:" not in printed
    assert "Grade: 0 of 100" in printed


@pytest.mark.slow
def test_a_variant_of_the_solution(folder):
    """The numbers of another variant lose the points for numbers only."""
    (folder / "lab.json").write_text('{"lab": "09-02", "variant": 7}')
    found = {each["file"]: each for each in check_folder(folder, only=("static", "dynamic"))["criteria"]}
    assert len(lost(found["static_tf_broadcaster.py"])) == 2  # The lidar of this variant is at the lab's place.
    assert {"the length of the first link is right", "the length of the second link is right"} <= set(
        lost(found["dynamic_tf_broadcaster.py"])
    )


def test_variants_differ_and_are_reproducible(tmp_path):
    assert assignment_of(4711) == assignment_of(4711)
    assert len({assignment_of(seed)[1:] for seed in range(50)}) == 50
    create_folder(tmp_path / "lab", 4711)
    assert read_assignment(tmp_path / "lab") == assignment_of(4711)
    with pytest.raises(CourseError, match="already contains"):
        create_folder(tmp_path / "lab", None)
    (tmp_path / "lab" / "lab.json").write_text("[" * 100_000)
    with pytest.raises(CourseError, match="Cannot read"):
        read_assignment(tmp_path / "lab")


@pytest.mark.slow
def test_a_class_as_a_table(tmp_path):
    for name in ("ada", "bob/work", "=cmd()"):
        (tmp_path / "class" / name).mkdir(parents=True)
        shutil.copy(SOLUTION / "static_tf_broadcaster.py", tmp_path / "class" / name)
    (tmp_path / "class" / "bob" / "work" / "static_tf_broadcaster.py").write_text("1 / 0")
    table = tmp_path / "grades.csv"
    words = ["lab", "check", str(tmp_path / "class"), "--all", "-o", str(table), "--only", "static"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    rows = table.read_text().splitlines()
    assert rows[0] == "submission,grade,bonus,Static transforms,problem"
    assert rows[1].startswith("'=cmd(),20")  # A spreadsheet would run a cell that begins with an equals sign.
    assert rows[2].startswith("ada,20")
    assert rows[3].startswith("bob/work,0")
    assert "division by zero" in rows[3]
    assert len(submissions(tmp_path / "class")) == 3
    assert len(list(check_class(submissions(tmp_path / "class"), only=("urdf",)))) == 3


def test_reports_in_other_formats(folder):
    (folder / "arm.urdf").write_text("<robot")
    report = check_folder(folder, only=("urdf",))
    text = "\n".join(formats.text(report))
    assert "the description can be read" in text
    assert "Points in this part of the check: 0 of 10 bonus." in text
    scored = formats.gradescope(report)
    assert scored["score"] == 0
    assert scored["tests"][0]["status"] == "failed"
    assert "expected: " in scored["tests"][0]["output"]
    assert formats.classroom(report)["tests"][0]["status"] == "fail"


def test_the_current_folder_is_the_default_if_it_is_a_lab(tmp_path, monkeypatch):
    create_folder(tmp_path / "mine", None)
    for stub in (tmp_path / "mine").glob("*.py"):
        stub.unlink()
    for folder, expected in (
        (tmp_path / "mine", f"{tmp_path / 'mine'} contains none"),
        (tmp_path, "lab contains none"),
    ):
        monkeypatch.chdir(folder)
        assert f"coframe: {expected} of the files" in CliRunner().invoke(app, ["lab", "run"]).output


def test_errors_are_sentences(tmp_path):
    for words, expected in (
        (["lab", "check", str(tmp_path / "none")], "There is no folder"),
        (["lab", "check", str(tmp_path), "--only", "statics"], "there is no criterion statics"),
        (["lab", "check", str(tmp_path), "--all"], "No submissions"),
        (["lab", "run", str(tmp_path)], "contains none of the files"),
        (["lab", "break", "3", "--answer", "gremlins"], "is not the name of a fault"),
        (["lab", "break", "3", "--answer", "degrees"], "That is not the fault"),
    ):
        result = CliRunner().invoke(app, words)
        assert result.exit_code in {1, 2}
        assert expected in result.output
    assert "Right: " in CliRunner().invoke(app, ["lab", "break", "8", "--answer", "degrees"]).output


def test_the_handbook_is_printed_and_written_as_web_pages(tmp_path):
    contents = CliRunner().invoke(app, ["lab", "handbook"]).output
    assert "10 Finding errors" in contents
    assert "coframe lab new my_lab" in contents
    assert "Static and dynamic transforms" in CliRunner().invoke(app, ["lab", "handbook", "3"]).output
    assert CliRunner().invoke(app, ["lab", "handbook", "-o", str(tmp_path)]).exit_code == 0
    pages = {path.name: path.read_text() for path in tmp_path.glob("*.html")}
    assert len(pages) == 11
    for text in pages.values():
        for address in re.findall(r'(?:href|src)="([^"#]+)', text):
            assert (tmp_path / address).is_file()
    assert "<table>" in pages["index.html"]
    missing = CliRunner().invoke(app, ["lab", "handbook", "11"])
    assert missing.exit_code == 2
    assert "Chapters: 1 to 10." in missing.output
