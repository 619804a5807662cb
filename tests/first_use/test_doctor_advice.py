"""The doctor's advice for people without ROS: what a finding says must be possible with coframe alone."""

import ast
import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

import coframe
from coframe.cli.app import app
from coframe.doctor import codes, page
from coframe.errors import PackageError
from coframe.robots import Packages

SOURCES = Path(coframe.__file__).parent
ADVISING = [
    *sorted((SOURCES / "doctor").rglob("*.py")),
    *sorted((SOURCES / "analysis").rglob("*.py")),
    *sorted((SOURCES / "robots").rglob("*.py")),
    *sorted((SOURCES / "explanation").rglob("*.py")),
    SOURCES / "lookup_hints.py",
    SOURCES / "errors.py",
]
NEEDS_ROS = re.compile(
    r"\bros2 (?:bag|run|launch|topic|node|param|service|interface|doctor|pkg)\b|\bros(?:run|launch|topic|node|bag) "
    r"|\bsourc(?:e|ing) (?:the|a|your) workspace|setup\.(?:ba|z)?sh|\bcolcon\b|check_urdf|view_frames|\brqt_"
    r"|\bapt(?:-get)? install",
    re.IGNORECASE,
)


def texts(source):
    """Yield the string literals of a module that are not docstrings."""
    tree = ast.parse(source)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield node.value


@pytest.mark.parametrize("code", codes())
def test_no_page_needs_a_ros_installation(code):
    assert not NEEDS_ROS.findall(page(code).text)


@pytest.mark.parametrize("file", ADVISING, ids=lambda file: file.relative_to(SOURCES).as_posix())
def test_no_finding_and_no_hint_needs_a_ros_installation(file):
    found = [text for text in texts(file.read_text("utf-8")) if NEEDS_ROS.search(text)]
    assert found == []


@pytest.mark.parametrize(
    "url",
    [
        "package://none/arm.stl",
        "package://parts/none.stl",
        "package://parts/../secret.stl",
        "package://../a",
        "http://a/b",
    ],
)
def test_every_problem_with_a_package_url_names_the_variable(url, tmp_path, monkeypatch):
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path))
    (tmp_path / "parts").mkdir()
    (tmp_path / "secret.stl").write_bytes(b"")
    with pytest.raises(PackageError) as caught:
        Packages().resolve(url)
    assert "COFRAME_PACKAGE_PATH" in caught.value.hint


@pytest.mark.parametrize("url", ["package://none/arm.stl", "package://parts/none.stl"])
def test_the_viewer_names_the_variable_for_a_missing_mesh(url, tmp_path, monkeypatch):
    from coframe.viewer.robots.robot_message import make_mesh_table

    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path))
    (tmp_path / "parts").mkdir()
    assert "COFRAME_PACKAGE_PATH" in make_mesh_table(None, []).url_or_problem(url)[1]


def test_all_codes_are_listed_with_their_titles():
    result = CliRunner().invoke(app, ["doctor", "--list"])
    assert result.exit_code == 0
    assert result.output.splitlines() == [f"{code}  {page(code).title}" for code in codes()]
    as_json = json.loads(CliRunner().invoke(app, ["doctor", "--list", "--json"]).output)
    assert as_json == [{"code": code, "title": page(code).title} for code in codes()]
