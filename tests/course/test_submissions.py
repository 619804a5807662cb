# SPDX-License-Identifier: Apache-2.0
"""Submissions whose files and folders are not what they seem: links, special files, names, modules of the teacher."""

import csv
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner
from grades import SOLUTION  # of this folder

from coframe.cli.app import app
from coframe.course import checking
from coframe.course.checking import check_folder
from coframe.course.class_folder import submissions
from coframe.course.submitted import check_submitted
from coframe.errors import CourseError

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs links and named pipes")

STATIC, URDF = "static_tf_broadcaster.py", "arm.urdf"
# As the script of coframe does, this starts without the current folder on its path.
START = "import os; os.environ.update({!r}); from coframe.cli import main; main()"


def coframe_command(*words, **variables):
    """Return a command of coframe that starts with more variables."""
    return [sys.executable, "-I", "-c", START.format(variables), *words]


@pytest.fixture
def classroom(tmp_path):
    """A class in which Alice has solved the lab, and Mallory has an empty folder."""
    for name in ("alice", "mallory"):
        (tmp_path / "class" / name).mkdir(parents=True)
    shutil.copy(SOLUTION / URDF, tmp_path / "class" / "alice")
    return tmp_path / "class"


def grades(classroom):
    """Return the bonus points and the problem of each submission, as the table of the class contains them."""
    table = classroom.parent / "grades.csv"
    words = ["lab", "check", "--all", str(classroom), "--only", "urdf", "-o", str(table)]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    with table.open(encoding="utf-8", newline="") as lines:
        return {row["submission"]: (float(row["bonus"]), row["problem"]) for row in csv.DictReader(lines)}


LINKS = {
    "to the class": lambda mallory: (mallory / "x").symlink_to(".."),
    "to a class mate": lambda mallory: (mallory / "x").symlink_to("../alice"),
    "below a folder": lambda mallory: [(mallory / "a").mkdir(), (mallory / "a" / "x").symlink_to("../../alice")],
    "to a file": lambda mallory: (mallory / URDF).symlink_to("../alice/arm.urdf"),
    "to an absolute path": lambda mallory: (mallory / URDF).symlink_to(mallory.parent / "alice" / URDF),
    "by a folder": lambda mallory: [
        (mallory / "x").symlink_to("../alice"),
        (mallory / URDF).symlink_to("x/arm.urdf"),
    ],
    "instead of the folder": lambda mallory: [mallory.rmdir(), mallory.symlink_to("alice")],
}


def test_a_link_does_not_take_the_grade_of_someone_else(classroom):
    for name, make in LINKS.items():
        (classroom / name).mkdir()
        make(classroom / name)
    found = grades(classroom)
    assert found.pop("alice") == (10, "")
    assert {name: points for name, (points, _) in found.items()} == dict.fromkeys(["mallory", *LINKS], 0)
    assert "is a link to another folder" in found["instead of the folder"][1]


def test_a_hard_link_belongs_to_no_one(classroom):
    """Nobody can tell whose file it is, so neither gets points until it is replaced by copies."""
    os.link(classroom / "alice" / URDF, classroom / "mallory" / URDF)
    found = grades(classroom)
    assert found["mallory"][0] == found["alice"][0] == 0
    report = check_folder(classroom / "mallory", only=("urdf",))
    assert "another name of the same file is outside the folder" in report["criteria"][0]["facts"][0]["observed"]


def test_links_inside_a_folder_are_followed(tmp_path):
    (tmp_path / "work").mkdir()
    (tmp_path / "work" / "node.py").write_text("x")
    (tmp_path / "node.py").symlink_to("work/node.py")
    os.link(tmp_path / "work" / "node.py", tmp_path / "same.py")
    assert check_submitted(tmp_path / "node.py") == tmp_path / "work" / "node.py"
    assert check_submitted(tmp_path / "same.py") == tmp_path / "same.py"


SPECIAL = {
    "pipe": (os.mkfifo, "a named pipe"),
    "folder": (Path.mkdir, "a folder, not a file"),
    "device": (lambda path: path.symlink_to("/dev/zero"), "outside the folder"),
    "loop": (lambda path: path.symlink_to(path.name), "Too many levels"),
    "nothing": (lambda path: path.symlink_to("missing"), "No such file"),
    "process": (lambda path: path.symlink_to("/proc/self/environ"), "outside the folder"),
    "large": (lambda path: path.write_bytes(bytes(2 << 20)), "larger than the maximum of 1 MiB"),
    "sparse": (lambda path: [path.touch(), os.truncate(path, 1 << 40)], "cannot be read"),
}


@pytest.mark.parametrize("name", SPECIAL)
@pytest.mark.parametrize("file", ["lab.json", "lab.rviz", STATIC, "arm.urdf.xacro", URDF])
def test_special_files_are_named_and_not_read(file, name, tmp_path):
    make, sentence = SPECIAL[name]
    make(tmp_path / file)
    with pytest.raises(CourseError, match=sentence):
        check_submitted(tmp_path / file)


@pytest.mark.slow
@pytest.mark.parametrize("name", SPECIAL)
def test_a_grade_says_what_a_special_file_is(name, tmp_path):
    for file in (STATIC, "lab.rviz", URDF):
        SPECIAL[name][0](tmp_path / file)
    start = time.monotonic()
    report = check_folder(tmp_path, only=("static", "visualization", "urdf"))
    assert time.monotonic() - start < 60
    assert (report["earned"], report["bonus"]) == (0, 0)
    for criterion, fact in ((0, 0), (1, 0), (2, 0)):
        found = report["criteria"][criterion]
        assert SPECIAL[name][1] in found["problem"] + found["facts"][fact]["observed"]


def test_names_of_folders_are_text(classroom):
    for name in ("=cmd()\nline", "a:b\\slash", "-o"):
        shutil.copytree(classroom / "alice", classroom / name)
    if sys.platform == "linux":
        (classroom / os.fsdecode(b"\xff\xfe")).mkdir()
    found = grades(classroom)
    assert [points for points, _ in found.values()].count(10) == 4
    assert len(found) == 6 if sys.platform == "linux" else 5


def test_the_search_for_files_is_bounded(classroom, tmp_path):
    for number in range(500):
        (classroom / "mallory" / str(number) / "a").mkdir(parents=True)
    start = time.monotonic()
    assert submissions(classroom, tmp_path / "scratch")["alice"].folder == classroom / "alice"
    assert time.monotonic() - start < 10


def test_a_description_includes_only_files_of_its_folder(classroom):
    pytest.importorskip("xacro")
    text = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="x"><xacro:include filename="{}"/></robot>'
    lab = next(Path(path) for path in __import__("coframe").__path__ if Path(path, "lab").is_dir()) / "lab"
    included = {
        "absolute": classroom / "alice" / URDF,
        "relative": "../alice/arm.urdf",
        "solution": lab / "two_link_arm.urdf.xacro",
        "own": "own.urdf",
    }
    for name, path in included.items():
        (classroom / name).mkdir()
        (classroom / name / "arm.urdf.xacro").write_text(text.format(path))
    shutil.copy(classroom / "alice" / URDF, classroom / "own" / "own.urdf")
    found = grades(classroom)
    assert {name: found[name][0] for name in included} == {"absolute": 0, "relative": 0, "solution": 0, "own": 10}
    assert "contains solutions" in found["solution"][1]


def test_expressions_of_a_description_are_confined(classroom, tmp_path):
    """xacro evaluates Python, and its restrictions can be evaded."""
    pytest.importorskip("xacro")
    (tmp_path / "secret.yaml").write_text("x: SECRET")
    text = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="${xacro.load_yaml(\'%s\')}"/>'
    (classroom / "mallory" / "arm.urdf.xacro").write_text(text % (tmp_path / "secret.yaml"))
    report = check_folder(classroom / "mallory", only=("urdf",))
    assert "No such file" in str(report) or "Permission denied" in str(report)
    assert "SECRET" not in str(report)


# Each of these modules of the standard library is imported by coframe or by what it starts.
SHADOWING = "import os, sys\nwith open({proof!r}, 'a') as file: file.write(__file__)\nraise SystemExit('SHADOWED')\n"
MODULES = (
    "json",
    "typing",
    "types",
    "copy",
    "queue",
    "signal",
    "subprocess",
    "sandbox",
    "numpy",
    "sitecustomize",
    "xacro",
)


@pytest.fixture
def shadowed(tmp_path):
    """A folder of a student in which modules have the names of others, and a file that they write if they run."""
    folder, proof = tmp_path / "student", tmp_path / "proof"
    folder.mkdir()
    for name in MODULES:
        (folder / f"{name}.py").write_text(SHADOWING.format(proof=str(proof)))
    for name in (STATIC, URDF, "tf_listener.py"):
        shutil.copy(SOLUTION / name, folder)
    (folder / "lab.json").write_text('{"lab": "09-02", "variant": null}')
    return folder, proof


@pytest.mark.slow
@pytest.mark.parametrize("variables", [{}, {"PYTHONPATH": ""}, {"PYTHONPATH": "/nowhere:"}], ids=str)
def test_the_grader_imports_nothing_from_the_current_folder(variables, shadowed):
    folder, proof = shadowed
    words = ["lab", "check", "--json", "--only", "urdf", "--record", str(folder.parent / "run")]
    command = coframe_command(*words, **variables)
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=110, check=False)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["bonus"] == 10
    assert not proof.exists(), proof.read_text()


def test_tools_and_libraries_are_not_searched_in_the_folder_of_a_student(shadowed):
    """An empty element of these variables means the current folder."""
    folder, proof = shadowed
    (folder / "unshare").write_text(f"#!/bin/sh\necho ran >> {proof}\n")
    (folder / "unshare").chmod(0o755)
    start = "from coframe.course.isolation import isolated_environment, isolation_problem; isolation_problem();"
    start += "import json, pathlib; print(json.dumps(isolated_environment(0, pathlib.Path('/tmp'))))"
    variables = {"PATH": f":.:{os.environ['PATH']}:", "LD_LIBRARY_PATH": "lib:/opt/x:", "AMENT_PREFIX_PATH": ":"}
    command = [sys.executable, "-I", "-c", f"import os; os.environ.update({variables!r}); {start}"]
    found = json.loads(subprocess.check_output(command, cwd=folder, timeout=60))
    assert (found["LD_LIBRARY_PATH"], found["AMENT_PREFIX_PATH"]) == ("/opt/x", "")
    assert found["PATH"] == os.environ["PATH"]
    assert not proof.exists()


@pytest.mark.parametrize("option", ["--gradescope", "--classroom", "--record"])
def test_a_report_in_the_folder_of_a_student_does_not_replace_another_file(option, folder, tmp_path, monkeypatch):
    kept = tmp_path / "kept"
    kept.write_text("KEPT")
    (folder / "result").symlink_to(kept)
    (folder / "out").symlink_to(tmp_path)
    monkeypatch.chdir(folder)
    for path in ("result", "out/kept", folder / "result"):
        result = CliRunner().invoke(app, ["lab", "check", ".", "--only", "urdf", option, str(path)])
        assert (result.exit_code, kept.read_text()) == (1, "KEPT")
        assert "outside the student's folder" in result.output


@pytest.mark.slow
@pytest.mark.parametrize("words", [["break", "4"], ["run", "--no-browser"]], ids=["break", "run"])
@pytest.mark.usefixtures("domain_id")
def test_the_simulation_imports_nothing_from_the_current_folder(words, shadowed):
    folder, proof = shadowed
    (folder / STATIC).unlink()
    (folder / "tf_listener.py").write_text(
        "import sys; sys.path.pop(0); print('STARTED', flush=True); import time; time.sleep(30)"
    )
    command = coframe_command("lab", *words, "--duration", "6")
    result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=110, check=False)
    assert result.returncode == 0, result.stderr
    assert "ended with exit code" not in result.stdout
    assert not proof.exists(), proof.read_text()


@pytest.mark.slow
def test_criteria_that_are_done_count_when_the_time_is_over(folder, monkeypatch):
    (folder / "dynamic_tf_broadcaster.py").write_text("import time\ntime.sleep(600)")
    over = []
    monkeypatch.setattr(checking, "time", Clock(over))
    report = check_folder(folder, only=("static", "dynamic", "urdf"), progress=lambda done: done and over.append(1))
    assert [(each["earned"], each["points"]) for each in report["criteria"]] == [(20, 20), (0, 25), (0, 10)]
    assert report["criteria"][1]["problem"] == "Not checked: the check took more than 1200 s."
    assert report["notices"][-1].endswith(
        "These criteria were not checked: Dynamic transforms, Extension: URDF. The other points count."
    )
    assert report["variant"] is None


class Clock:
    """A clock that is an hour late when the list is not empty."""

    def __init__(self, over):
        self.over = over

    def monotonic(self):
        return time.monotonic() + 3600 * bool(self.over)


@pytest.mark.slow
def test_the_points_of_the_rubric_are_those_of_the_criteria(tmp_path):
    from coframe.course.rubric import RUBRIC

    report = check_folder(tmp_path)
    found = [(each["name"], each["file"], each["points"], each["bonus"]) for each in report["criteria"]]
    assert found == list(RUBRIC.values())
