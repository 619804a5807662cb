# SPDX-License-Identifier: Apache-2.0
"""Files of RViz in the page: their views, filters and groups are applied, and saving them changes nothing."""

import math

import pytest
import yaml

import coframe

GRID = {
    "Class": "rviz_default_plugins/Grid",
    "Enabled": True,
    "Line Style": {"Line Width": 0.03, "Value": "Lines"},
    "Name": "Grid",
    "Normal Cell Count": 2,
    "Offset": {"X": 1, "Y": 2, "Z": 0.5},
    "Reference Frame": "<Fixed Frame>",
}
TF = {"Class": "rviz_default_plugins/TF", "Enabled": True, "Filter (blacklist)": "^hid", "Name": "TF"}
ORBIT = {
    "Class": "rviz_default_plugins/Orbit",
    "Distance": 7,
    "Focal Point": {"X": 1, "Y": 0.5, "Z": 0.25},
    "Name": "Current View",
    "Pitch": 0.5,
    "Target Frame": "base",
    "Value": "Orbit (rviz)",
    "Yaw": 2.5,
}
TOP = {"Angle": -1.5, "Class": "rviz_default_plugins/TopDownOrtho", "Scale": 40, "Target Frame": "<Fixed Frame>"}
TOP |= {"X": 3, "Y": 4}
FPS = {"Class": "rviz_default_plugins/FPS", "Pitch": 0.25, "Position": {"X": 1, "Y": 2, "Z": 3}, "Yaw": 1}
FPS |= {"Target Frame": "base"}
FOLLOWER = ORBIT | {"Class": "rviz_default_plugins/ThirdPersonFollower"}
ALIGNED = FPS | {"Class": "rviz_default_plugins/FrameAligned"}
# The frame "base" is at (10, 20, 0) and turned by 90 degrees.
BASE = (10.0, 20.0, 0.0)


def document(view, *, background="10; 20; 30", **more):
    manager = {"Class": "", "Displays": [GRID, TF], "Global Options": {"Fixed Frame": "map"}, "Name": "root"}
    if background:
        manager["Global Options"] = {"Background Color": background, "Fixed Frame": "map", "Frame Rate": 29.5}
    return {"Panels": [], "Visualization Manager": manager | {"Views": {"Current": view, **more}}}


@pytest.fixture
def source():
    made = coframe.Buffer(None)
    turned = coframe.Transform(BASE, [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)])
    made.set("map", "base", turned, static=True)
    made.set("map", "hidden", coframe.Transform([1.0, 0.0, 0.0]), static=True)
    return made


def saved(page):
    page.tab("rviz")
    with page.raw.expect_download() as download:
        page.click("#save-rviz")
    return yaml.safe_load(download.value.path().read_text())


def opened(page, tmp_path, content):
    """Open a file as the user does, and wait until it is applied."""
    file = tmp_path / "other.rviz"
    file.write_text(yaml.safe_dump(content))
    page.tab("rviz")
    page.raw.evaluate("document.querySelector('#toasts').replaceChildren()")
    page.raw.set_input_files("#body-rviz input[type=file]", str(file))
    page.wait(lambda: "Loaded" in page.text("#toasts"), "the notification")
    page.until("coframe.updates > 0 && coframe.frames.base")
    page.raw.wait_for_timeout(300)  # The view is applied with the next frame update.


def close(actual, expected):
    assert actual == pytest.approx(expected, abs=1e-3)


def test_files_are_applied_and_saved_unchanged(source, view, open_page, tmp_path):
    file = tmp_path / "first.rviz"
    file.write_text(yaml.safe_dump(document(ORBIT, Saved=[TOP | {"Name": "From above"}])))
    page = open_page(view(source, rviz=file).url).drawn()
    page.until("coframe.camera.target[0] > 5")
    close(page.evaluate("coframe.camera.target"), [11.0, 20.5, 0.25])
    distance = math.dist(page.evaluate("coframe.camera.position"), page.evaluate("coframe.camera.target"))
    close(distance, 7.0)
    assert page.evaluate("coframe.frames.hidden.visible") is False, "the filter of the TF display"
    assert saved(page) == document(ORBIT, Saved=[TOP | {"Name": "From above"}])
    page.click("#file-views button")
    page.until("coframe.camera.mode === 'top'")
    page.until("document.querySelector('.view-tools button[title^=Top]').getAttribute('aria-pressed') === 'true'")
    assert saved(page)["Visualization Manager"]["Views"]["Current"]["Class"].endswith("TopDownOrtho")

    opened(page, tmp_path, document(TOP, background=None))
    assert saved(page) == document(TOP, background=None), "nothing is added, not even a background or a target frame"
    close(page.evaluate("coframe.camera.target").copy()[:2], [3.0, 4.0])
    corner, along = page.evaluate("[coframe.pixel([3, 4, 0]), coframe.pixel([4, 4, 0])]")
    close(math.atan2(-(along[1] - corner[1]), along[0] - corner[0]), 1.5)

    opened(page, tmp_path, document(FPS))
    close(page.evaluate("coframe.camera.position"), [11.0, 22.0, 3.0])
    ahead = [a - b for a, b in zip(*page.evaluate("[coframe.camera.target, coframe.camera.position]"), strict=True)]
    close(ahead, [math.cos(0.25) * math.cos(1), math.cos(0.25) * math.sin(1), -math.sin(0.25)])
    assert saved(page) == document(FPS)

    opened(page, tmp_path, document(ALIGNED))
    close(page.evaluate("coframe.camera.position"), [8.0, 21.0, 3.0])
    assert saved(page) == document(ALIGNED)

    locked = ALIGNED | {"Lock Camera": True, "Point towards": "arbitrary"}
    opened(page, tmp_path, document(locked))
    before = page.evaluate("coframe.camera")
    page.raw.mouse.move(600, 300)
    page.raw.mouse.down()
    page.raw.mouse.move(700, 350, steps=3)
    page.raw.mouse.up()
    page.raw.mouse.wheel(0, 400)
    assert page.evaluate("coframe.camera") == before
    assert saved(page) == document(locked)
    page.key("w")
    page.raw.get_by_label("Point towards").select_option("-z axis")
    page.until("coframe.camera.position[2] === 0")
    close(page.evaluate("coframe.camera.position"), list(BASE))
    close(page.evaluate("coframe.camera.target"), [10.0, 20.0, -1.0])
    page.raw.get_by_label("Lock Camera").uncheck()
    changed = saved(page)["Visualization Manager"]["Views"]["Current"]
    assert (changed["Point towards"], changed["Lock Camera"]) == ("-z axis", False)
    page.key("w")

    opened(page, tmp_path, document(FOLLOWER))
    close(page.evaluate("coframe.camera.target"), [9.5, 21.0, 0.25])
    assert saved(page) == document(FOLLOWER)
    page.raw.mouse.move(600, 300)
    page.raw.mouse.wheel(0, 400)
    page.raw.wait_for_timeout(300)
    changed = saved(page)["Visualization Manager"]["Views"]["Current"]
    assert changed["Distance"] > 7.1
    assert changed["Value"] == "Orbit (rviz)"
    assert set(changed) == set(FOLLOWER)
