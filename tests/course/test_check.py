# SPDX-License-Identifier: Apache-2.0
"""Grades of whole folders: the solution, the stubs, and the lab's scripts as they stand."""

import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import urllib.request
from pathlib import Path

import pytest
from click.testing import CliRunner
from grades import SOLUTION, lost  # of this folder

import coframe
from coframe.cli.app import app
from coframe.course import formats
from coframe.course.assignment import assignment_of, read_assignment
from coframe.course.checking import check_folder
from coframe.course.class_folder import submissions
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
def test_a_recorded_grade_is_the_same_and_can_be_opened(folder, tmp_path):
    path = folder / "tf_listener.py"
    path.write_text(path.read_text().replace('"base_link", "end_effector", Time', '"end_effector", "base_link", Time'))
    only = ("static", "urdf", "listener")
    report = check_folder(folder, only=only, record=tmp_path / "run")
    assert [each["problem"] for each in report["criteria"]] == [""] * 3
    assert [each["earned"] for each in report["criteria"]] == [20, 10, 10]
    bag = coframe.open_bag(tmp_path / "run")
    poses = [each.message for each in bag.messages("/end_effector_pose")]
    assert len(poses) > 30
    assert {pose.header.frame_id for pose in poses} == {"end_effector"}  # the fault, as the teacher sees it
    assert ("base_link", "link1") in {(edge.parent, edge.child) for edge in bag.buffer.edges()}
    viewer = coframe.show(bag)
    with urllib.request.urlopen(viewer.url) as page:
        assert page.status == 200
    viewer.close()


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
    assert list(static) == ["camera_link is at the correct position"]
    assert "0.707" in static["camera_link is at the correct position"]["cause"]
    assert "no other publisher moves the arm at the same time" in lost(found["dynamic_tf_broadcaster.py"])
    listener = lost(found["tf_listener.py"])
    assert list(listener) == ["each pose is correct at its stamp"]
    assert "use transform.header.stamp, not now()" in listener["each pose is correct at its stamp"]["cause"]
    sensor = found["sensor_transform.py"]
    assert sensor["earned"] == 0
    assert sensor["problem"].endswith("it has a publisher on /scan_base_frame, but publish() is never called.")
    assert found["complete_tf_tree.py"]["earned"] == 10.86  # its arm has other lengths than that of step 2


@pytest.mark.slow
def test_stubs_run_and_one_sentence_for_each_says_what_is_missing(tmp_path):
    create_folder(tmp_path / "lab", 7)
    report = check_folder(tmp_path / "lab")
    assert (report["variant"], report["earned"], report["bonus"]) == (7, 0, 0)
    for criterion in report["criteria"]:
        assert re.search("publishes nothing|does not describe any joints yet", criterion["problem"]), criterion[
            "problem"
        ]
    printed = "\n".join(formats.text(report))
    assert "RViz configuration does not show the robot yet" in printed
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
    (tmp_path / "class" / "ada" / "lab.json").write_text('{"lab": "09-02", "variant": null}')
    table = tmp_path / "grades.csv"
    words = ["lab", "check", str(tmp_path / "class"), "--all", "-o", str(table), "--only", "static"]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    rows = table.read_text().splitlines()
    assert rows[0] == "submission,variant,grade,bonus,Static transforms,problem"
    assert rows[1].startswith("'=cmd(),,20")  # A spreadsheet would run a cell that begins with an equals sign.
    assert rows[2].startswith("ada,,20")
    assert rows[3].startswith("bob,,0")
    assert "division by zero" in rows[3]


@pytest.fixture
def small_class(tmp_path):
    """The submissions of a class, as they come out of archives."""
    (tmp_path / "class").mkdir()
    for name in ("ada", "bob/lab", "bob/old", "chen", "__MACOSX/ada", ".git"):
        (tmp_path / "class" / name).mkdir(parents=True)
    for name in ("ada/arm.urdf", "bob/lab/arm.urdf"):
        shutil.copy(SOLUTION / "arm.urdf", tmp_path / "class" / name)
    (tmp_path / "class" / "bob" / "old" / "notes.py").write_text("")
    (tmp_path / "class" / "__MACOSX" / "ada" / "._static_tf_broadcaster.py").write_bytes(bytes(10))
    return tmp_path / "class"


def test_each_student_has_one_row(small_class, tmp_path):
    assert list(submissions(small_class, tmp_path / "scratch")) == ["ada", "bob", "chen"]
    (small_class / "chen" / "lab.json").write_text("[")
    table = tmp_path / "grades.csv"
    words = ["lab", "check", str(small_class), "--all", "--only", "urdf", "--json", "-o", str(table)]
    result = CliRunner().invoke(app, words)
    reports = json.loads(result.stdout)
    assert {name: each["bonus"] for name, each in reports.items()} == {"ada": 10, "bob": 10, "chen": 0}
    rows = table.read_text().splitlines()
    assert [row.split(",")[0] for row in rows] == ["submission", "ada", "bob", "chen"]
    assert "lab.json" in rows[3]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGINT")
def test_ctrl_c_ends_the_grades_of_a_class(tmp_path):
    for number in range(6):
        (tmp_path / "class" / str(number)).mkdir(parents=True)
        (tmp_path / "class" / str(number) / "static_tf_broadcaster.py").write_text("while True: pass")
    words = [sys.executable, "-m", "coframe.cli", "lab", "check", tmp_path / "class", "--all", "--json"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    running = f"{tmp_path}/class/1/static_tf_broadcaster.py".encode()
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not any(running in each for each in command_lines()):
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=30)  # Six grades would take 45 s or more after this moment.
    assert (process.returncode, output) == (130, b""), errors
    assert b"Traceback" not in errors
    assert not any(str(tmp_path).encode() in each for each in command_lines())


@pytest.mark.skipif(sys.platform != "linux", reason="finds processes in /proc")
def test_a_grade_ends_with_the_process_that_wants_it(folder, eventually):
    (folder / "static_tf_broadcaster.py").write_text("while True: pass")
    words = [sys.executable, "-m", "coframe.cli", "lab", "check", folder, "--only", "static"]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    ours = str(folder).encode()
    eventually(lambda: any(ours in each and b"static_tf_broadcaster.py" in each for each in command_lines()))
    process.kill()
    process.wait()
    killed_at = time.monotonic()
    eventually(lambda: not any(ours in each for each in command_lines()))
    assert time.monotonic() - killed_at < 5.0, "it ended because it was complete"


def command_lines():
    time.sleep(0.1)  # callers repeat it, and the processes of the test need the processor
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            found.append(path.read_bytes())
    return found


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
    (folder / "arm.urdf").unlink()
    report = check_folder(folder, only=("urdf",))
    assert formats.gradescope(report)["tests"] == formats.classroom(report)["tests"] == []  # It was not attempted.


def test_a_folder_that_cannot_be_graded_has_a_report(folder, tmp_path):
    (folder / "lab.json").write_text("[")
    files = [tmp_path / "gradescope.json", tmp_path / "classroom.json"]
    words = ["lab", "check", str(folder), "--gradescope", str(files[0]), "--classroom", str(files[1])]
    assert CliRunner().invoke(app, words).exit_code == 1
    scored, result = (json.loads(file.read_text()) for file in files)
    assert (scored["score"], result["tests"][0]["score"], result["tests"][0]["max_score"]) == (0, 0, 100)
    assert "lab.json" in scored["output"]
    assert "lab.json" in result["tests"][0]["message"]


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
        (["lab", "check", str(tmp_path), "--only", "statics"], "unknown criterion statics"),
        (["lab", "check", str(tmp_path), "--all"], "No submissions"),
        (["lab", "check", str(tmp_path), "--all", "--gradescope", "x.json"], "only for a single folder"),
        (["lab", "check", str(tmp_path), "-o", "x.csv"], "only for a class"),
        (["lab", "run", str(tmp_path)], "contains none of the files"),
        (["lab", "break", "3", "--answer", "gremlins"], "does not name one fault"),
        (["lab", "break", "3", "--answer", "degrees"], "The answer is wrong"),
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
    assert len(pages) == 13
    for text in pages.values():
        for address in re.findall(r'(?:href|src)="([^"#]+)', text):
            assert (tmp_path / address).is_file()
    assert "<table>" in pages["index.html"]
    committed = Path(__file__).parents[2] / "docs/handbook/notebooks"
    notebooks, expected = (
        {path.name: path.read_text() for path in folder.iterdir()} for folder in (tmp_path / "notebooks", committed)
    )
    assert notebooks == expected
    missing = CliRunner().invoke(app, ["lab", "handbook", "13"])
    assert missing.exit_code == 2
    assert "Chapters: 1 to 12." in missing.output


@pytest.mark.slow
def test_an_error_of_a_program_names_its_line_and_is_the_cause_of_all_lost_points(folder, grade):
    path = folder / "static_tf_broadcaster.py"
    text = path.read_text().replace("q.x, q.y, q.z, q.w = rotation", "q.x = 0")  # fails inside the class of the message
    path.write_text(text)
    number = next(number for number, line in enumerate(text.splitlines(), 1) if "q.x = 0" in line)
    (found,) = grade("static").values()
    assert f"in line {number} of static_tf_broadcaster.py: AssertionError: The 'x' field must be" in found["problem"]
    (cause,) = {fact["cause"] for fact in lost(found).values()}
    assert cause.startswith("the program exited with an error in line")
    assert "likely cause" not in "\n".join(
        formats.text({"criteria": [found], "notices": [], "points": 100, "earned": 0})
    )


@pytest.mark.skipif(sys.platform != "linux", reason="finds the process of the grade in /proc")
def test_a_grade_whose_process_is_killed_says_how_it_ended(folder):
    """For example by a system that runs out of memory."""

    def kill(done):
        if done:
            children = Path(f"/proc/self/task/{threading.get_native_id()}/children").read_text().split()
            os.kill(int(children[-1]), signal.SIGKILL)

    report = check_folder(folder, only=("static", "dynamic"), progress=kill)
    killed = "The check was ended by signal 9 (Killed), as a system does that runs out of memory. These criteria"
    assert any(notice.startswith(killed) for notice in report["notices"])
    assert report["criteria"][1]["problem"].startswith("Not checked: the check was ended by signal 9 (Killed)")
