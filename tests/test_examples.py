# SPDX-License-Identifier: Apache-2.0
"""Every example runs and prints what it promises."""

import json
import re
import runpy
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"
EXPECTED = {
    "04_batch.py": r"1000 poses; the last one is at \[10\.088, 0\.048, 0\.3\] m",
    "05_deskew.py": r"deskewed: +the wall is off by up to 0\.000000 m",
    "06_asyncio.py": r"at 2\.5 s: x = 0\.25 m; at 5 s: x = 0\.50 m\nno transform: .*5\.000000",
    "07_urdf.py": r"tool relative to base_link: \[0\.614, 0\.0, 0\.348\] m",
    "08_recording.py": r"odom -> base_link: 101 transforms, moved 10\.00 m",
    "15_time_travel.py": r"lidar now: x = 0\.10 m; two seconds ago: x = -0\.90 m",
    "16_poses_and_messages.py": r"goal in odom: x = 3\.0 m",
    "17_project_points.py": r"\[5\.0, 1\.0, 0\.5\] m -> \[175\.4, 240\.0\] px\n.*\[nan, nan\] px",
    "18_uncertain_poses.py": r"fused +x = 3\.05 \+- 0\.07 m",
    "19_screw_interpolation.py": r"decoupled: up to 122\.4 mm .*\nscrew +: up to 0\.0 mm",
    "20_repair_a_recording.py": r"1 frame name changed\n1 stamp changed\nstamp: \+35 ms",
}
SCENES = {  # the nodes that each example draws in the viewer
    "21_color_a_cloud.py": ["hills"],
    "22_draw_a_path.py": ["length", "path"],
    "23_terrain_mesh.py": ["ball", "box", "terrain"],
    "24_arm_workspace.py": ["workspace"],
    "25_camera_frustum.py": ["frustum", "image"],
    "26_two_robots.py": ["between", "distance", "robot1 body", "robot2 body"],
}
VIEWERS = {  # tests/viewer/browser/test_example_programs.py
    "10_click_to_measure.py",
    "11_calibration_sliders.py",
    "12_record_a_route.py",
    "13_tune_a_controller.py",
    "14_label_detections.py",
}
NODES = ["01_static_broadcaster.py", "02_dynamic_broadcaster.py", "03_listener.py"]


def test_each_example_has_a_test():
    assert {path.name for path in EXAMPLES.glob("[0-9]*.py")} == {*EXPECTED, *NODES, *VIEWERS, *SCENES}


@pytest.mark.parametrize("name", EXPECTED)
def test_the_output_is_as_expected(name, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", [name])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")
    output = capsys.readouterr().out
    assert re.search(EXPECTED[name], output), output


@pytest.mark.parametrize("name", SCENES)
def test_the_scene_is_drawn(name):
    with runpy.run_path(str(EXAMPLES / name))["show_scene"]() as viewer:
        assert sorted(viewer.scene.names) == SCENES[name]


def test_each_example_is_in_the_gallery_with_a_small_picture():
    programs = {path.stem for path in EXAMPLES.glob("[0-9]*")}
    pictures = list((EXAMPLES.parent / "docs" / "images" / "gallery").iterdir())
    assert len(programs) >= 24
    assert {path.stem for path in pictures} == programs
    assert sum(path.stat().st_size for path in pictures) < 1_500_000
    rows = re.findall(r"^\| \[(\d\w+)\.\w+\]", (EXAMPLES / "README.md").read_text("utf-8"), re.MULTILINE)
    assert sorted(rows) == sorted(programs)


def test_the_recording_example_reads_a_real_recording(shared):
    recording = shared / "recordings" / "tb3_gazebo_walker"
    output = subprocess.check_output([sys.executable, EXAMPLES / "08_recording.py", recording], text=True, timeout=60)
    assert "odom -> base_footprint: 579 transforms" in output


@pytest.mark.usefixtures("domain_id")
def test_broadcasters_and_listener_work_together():
    nodes = [subprocess.Popen([sys.executable, EXAMPLES / name], stderr=subprocess.PIPE, text=True) for name in NODES]
    try:
        heights = []
        deadline = time.monotonic() + 60
        while len(heights) < 2 and time.monotonic() < deadline:
            line = nodes[-1].stderr.readline()
            heights += re.findall(r"lidar at x=\S+ y=\S+ z=(\S+) m in odom", line)
        assert heights == ["0.30", "0.30"]
        for node in nodes:
            node.send_signal(signal.SIGINT)
        assert [node.wait(20) for node in nodes] == [0, 0, 0]
    finally:
        for node in nodes:
            node.kill()
            node.wait()
            node.stderr.close()


def test_the_cells_of_the_notebook_run():
    notebook = json.loads((EXAMPLES / "09_notebook.ipynb").read_text(encoding="utf-8"))
    names = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    assert names["path"].shape == (1000, 3)
    assert names["transform"].target == "odom"
