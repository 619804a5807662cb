# SPDX-License-Identifier: Apache-2.0
"""Recordings, trajectories, robots and .rviz files are opened by dropping them on the page."""

import base64
import tempfile
from pathlib import Path

import pytest

import coframe
from coframe.viewer import start_viewer
from coframe.viewer.sources.recorded import RecordedSource

pytest.importorskip("mcap", reason="recordings need mcap")

from recordings import write_mcap

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
DROP = """([files]) => {
  const data = new DataTransfer();
  for (const [name, text] of files)
    data.items.add(new File([Uint8Array.from(atob(text), (character) => character.charCodeAt(0))], name));
  for (const type of ["dragover", "drop"])
    document.body.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""
URDF = b'<robot name="cart"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>'


def recording(folder, name, frame, begin):
    """Write two seconds in which a frame is at x = 1 and then at x = 2."""
    rows = []
    for second in range(3):
        buffer = coframe.Buffer(None)
        buffer.set("map", frame, coframe.Transform([1.0 + second, 0.0, 0.0]), begin + second * SECOND)
        rows.append(("/tf", begin + second * SECOND, buffer.encode(static=False)))
    return write_mcap(folder / name, rows=rows)


def drop(page, *files):
    page.evaluate(DROP, [[[name, base64.b64encode(data).decode()] for name, data in files]])


@pytest.fixture
def page(tmp_path, open_page):
    first = recording(tmp_path, "first.mcap", "one", BEGIN)
    with start_viewer("first", "buffer", port=0) as viewer:
        viewer.set_source(RecordedSource(coframe.open_bag(first), own=True))
        opened = open_page(viewer.url).drawn()
        opened.shows("one")
        yield opened
    assert not list(Path(tempfile.gettempdir()).glob("coframe-viewer-*/*/*/second.mcap")), "uploads are removed"


def test_files_are_dropped_on_the_page_and_earlier_ones_are_shown_again(page, tmp_path):
    second = recording(tmp_path, "second.mcap", "two", BEGIN + 3600 * SECOND).read_bytes()
    drop(page, ("second.mcap", second))
    page.shows("two")
    assert "one" not in page.evaluate("coframe.frames")
    page.wait(lambda: "Opened second.mcap." in page.text("#toasts"), "the confirmation")
    assert page.text(".source-title") == "second.mcap"
    page.settle()
    assert page.evaluate("coframe.frames.two.position") == [1, 0, 0], "at its start"

    page.click("#bar button[aria-label='Open a file']")
    assert page.texts("#recent button") == ["second.mcap (shown)", "first.mcap"]
    page.click("#recent button:text('first.mcap')")
    page.shows("one")

    # An hour lies between the two recordings; they start together.
    drop(page, ("first.mcap", (tmp_path / "first.mcap").read_bytes()), ("second.mcap", second))
    page.until("Object.keys(coframe.frames).length === 4")
    frames = page.evaluate("coframe.frames")
    assert set(frames) == {"first_1/map", "first_1/one", "second_2/map", "second_2/two"}
    page.until("document.querySelector('#time').title.endsWith('of 2.00 s')")

    drop(page, ("cart.urdf", URDF))
    page.until("coframe.displays.RobotModel?.robot === 'cart'")
    drop(page, ("path.tum", b"1700000000 0 0 0 0 0 0 1\n1700000001 1 0 0 0 0 0 1\n"))
    page.until("Object.keys(coframe.frames).length === 2")
    drop(page, ("lab.rviz", b"Visualization Manager: {Displays: [{Class: rviz/Axes, Enabled: true, Name: Mine}]}"))
    page.until("coframe.displays.Mine")

    for name, text in (("arm.urdf.xacro", "coframe view --robot arm.urdf.xacro"), ("virus.exe", ".mcap")):
        drop(page, (name, b"x"))
        page.wait(lambda text=text: text in page.text("#toasts"), text)
    drop(page, ("damaged.mcap", b"nothing"))
    page.wait(lambda: "damaged.mcap cannot be opened" in page.text("#toasts"), "the reason")
    assert page.evaluate("coframe.connected")
