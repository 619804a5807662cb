# SPDX-License-Identifier: Apache-2.0
"""The notebooks of the handbook: current, executed by a real kernel, and their 3D views drawn by a real browser."""

import subprocess
import sys
from pathlib import Path

import notebooks
import pytest

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "docs" / "handbook" / "notebooks"
FRAMES = {
    "01_why_frames": {"base_link", "lidar_link", "link1"},
    "02_rotations": {"target", "source"},
    "03_static_and_dynamic": {"odom", "base_link", "lidar_link"},
    "04_lookup_transform": {"base_link", "camera_link"},
    "05_time": {"odom", "base_link"},
    "06_sensors": {"base_link", "lidar_link"},
    "07_complete_tree": {"map", "odom", "base_link"},
    "08_urdf": {"base_link", "link1", "tip"},
    "09_time_travel": {"odom", "base_link", "end_effector"},
    "10_finding_errors": {"base_link", "link1", "link2", "end_effector", "end_efector", "camera_link"},
}
WITHOUT_VIEWER = {"11_motion_between_frames", "12_packages_and_launch"}


def test_the_notebooks_are_current():
    command = [sys.executable, ROOT / "scripts" / "handbook_notebooks.py", "--check"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    assert {path.stem for path in FOLDER.glob("*.ipynb")} == {*FRAMES, *WITHOUT_VIEWER}


def test_the_notebooks_are_valid_and_without_outputs():
    nbformat = notebooks.package("nbformat")
    for path in FOLDER.glob("*.ipynb"):
        notebook = nbformat.read(path, as_version=4)
        nbformat.validate(notebook)
        assert not any(cell.get("outputs") for cell in notebook.cells)


@pytest.mark.parametrize(
    "chapter",
    [pytest.param(name, marks=[] if name == "01_why_frames" else pytest.mark.slow) for name in FRAMES],
)
def test_a_chapter_runs_and_shows_its_frames(chapter, open_page, tmp_path):
    notebook = notebooks.package("nbformat").read(FOLDER / f"{chapter}.ipynb", as_version=4)
    notebooks.execute(notebook, tmp_path)
    notebook.cells = [cell for cell in notebook.cells if cell.cell_type == "code"]  # without the chapter's figures
    file = tmp_path / f"{chapter}.html"
    file.write_text(f"<!doctype html><meta charset=utf-8>{notebooks.exported(notebook)}", encoding="utf-8")
    page = open_page(file.as_uri())
    frames = page.raw.query_selector_all("iframe")
    assert len(frames) == 1
    viewer = frames[0].content_frame()
    viewer.wait_for_function("() => window.coframe && coframe.updates > 0", timeout=notebooks.TIMEOUT * 1000)
    assert set(viewer.evaluate("Object.keys(coframe.frames)")) == FRAMES[chapter]
    assert any(frame["visible"] for frame in viewer.evaluate("Object.values(coframe.frames)"))
