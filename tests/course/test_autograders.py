# SPDX-License-Identifier: Apache-2.0
"""The packages for Gradescope and GitHub Classroom, run as these services run them: only the folders differ."""

import base64
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the nodes of a folder speak DDS")

from grades import SOLUTION  # of this folder

from coframe.course.autograder import write_autograder

ROOT = Path(__file__).parents[2]
FULL, BONUS = 100, 40
WRONG = "dynamic_tf_broadcaster.py"  # two facts of 2.5 points are lost with the whole angle instead of half of it
LOST = 5
pytestmark = [
    pytest.mark.slow,
    pytest.mark.timeout(900),
    pytest.mark.skipif(sys.platform != "linux", reason="the services run Linux"),
]


def run(*command, cwd, path=(), **environment):
    """Run a command of the service, which finds no Python of this test environment."""
    given = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}
    given["PATH"] = os.pathsep.join([*map(str, path), os.environ["PATH"]])
    command = [str(part) for part in command]
    result = subprocess.run(
        command, capture_output=True, text=True, cwd=cwd, env={**given, **environment}, timeout=600, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel of this checkout, or that of COFRAME_TEST_WHEEL."""
    if given := os.environ.get("COFRAME_TEST_WHEEL"):
        return Path(given).resolve()
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT, cwd=folder)
    (built,) = folder.glob("coframe-*.whl")
    return built


@pytest.fixture(scope="module")
def tools(tmp_path_factory):
    """The commands of an image in which the packages of the system are already installed."""
    folder = tmp_path_factory.mktemp("tools")
    (folder / "apt-get").write_text("#!/bin/sh\n")
    (folder / "apt-get").chmod(0o755)
    (folder / f"python3.{sys.version_info.minor}").symlink_to(Path(sys.base_prefix, "bin", "python3").resolve())
    return folder


def submit(folder):
    shutil.copytree(SOLUTION, folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def make_wrong(folder):
    text = (folder / WRONG).read_text()
    assert "/ 2" in text
    (folder / WRONG).write_text(text.replace("/ 2", "/ 1"))
    (folder / "time_travel.py").unlink()


def failed(tests, *, good):
    return {test["name"] for test in tests if test["status"] != good}


def test_gradescope_grades_a_right_and_a_wrong_submission(wheel, tools, tmp_path):
    root = tmp_path / "autograder"
    archive, *_ = write_autograder("gradescope", tmp_path / "upload", wheel)
    (root / "source").mkdir(parents=True)
    with zipfile.ZipFile(archive) as file:
        file.extractall(root / "source")
    for name in ("setup.sh", "run_autograder"):
        text = (root / "source" / name).read_text()
        assert "/autograder/" in text
        text = text.replace("/autograder/", f"{root}/").replace("/opt/lab", f"{tmp_path}/lab")
        (root / "source" / name).write_text(text)
    run("bash", "setup.sh", cwd=root / "source", path=[tools])
    submission = submit(root / "submission")
    run("bash", "source/run_autograder", cwd=root)
    right = json.loads((root / "results" / "results.json").read_text())
    assert right["score"] == FULL + BONUS
    assert sum(test["max_score"] for test in right["tests"]) == FULL
    assert not failed(right["tests"], good="passed")
    make_wrong(submission)
    run("bash", "source/run_autograder", cwd=root)
    wrong = json.loads((root / "results" / "results.json").read_text())
    assert not any("time travel" in test["name"] for test in wrong["tests"]), "it was not attempted"
    lost = [test for test in wrong["tests"] if test["status"] == "failed"]
    assert sum(test["max_score"] for test in lost) == LOST
    assert wrong["score"] == sum(test["score"] for test in wrong["tests"])
    assert all("sin(q / 2)" in test["output"] for test in lost)


def test_the_steps_of_classroom_grade_a_wrong_submission(wheel, tools, tmp_path):
    repository = submit(tmp_path / "repository")
    workflow, _ = write_autograder("classroom", repository, wheel)
    make_wrong(repository)
    temporary, output = tmp_path / "temporary", tmp_path / "output"
    temporary.mkdir()
    python = tmp_path / "python"  # what actions/setup-python puts on the PATH
    run(tools / f"python3.{sys.version_info.minor}", "-m", "venv", python, cwd=tmp_path)
    yaml = pytest.importorskip("yaml")
    service = {"GITHUB_WORKSPACE": str(repository), "RUNNER_TEMP": str(temporary), "GITHUB_OUTPUT": str(output)}
    steps = yaml.safe_load(workflow.read_text())["jobs"]["lab"]["steps"]
    for script in [step["run"] for step in steps if "run" in step]:
        run("bash", "-e", "-c", script, cwd=repository, path=[python / "bin"], **service)
    name, _, encoded = output.read_text().strip().partition("=")
    assert name == "result"
    result = json.loads(base64.b64decode(encoded))
    assert result["status"] == "fail"
    assert len(failed(result["tests"], good="pass")) == LOST / 2.5
