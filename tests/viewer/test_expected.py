# SPDX-License-Identifier: Apache-2.0
"""A viewer that starts before its source: the tabs start from scratch when the source is available."""

import numpy as np
import pytest

import coframe
from coframe.viewer import start_viewer
from coframe.viewer.sources.recorded import RecordedSource
from coframe.viewer.sources.source import BufferSource

SECOND = 1_000_000_000


@pytest.fixture
def early_viewer():
    with start_viewer("run.mcap", "buffer", fixed="map", port=0) as viewer:
        yield viewer


def test_the_page_is_served_before_the_source_is_available(early_viewer, open_tab):
    tab = open_tab(early_viewer)
    hello = tab.wait("hello")
    assert (hello["title"], hello["mode"], hello["span"]) == ("run.mcap", "buffer", None)
    assert tab.wait("tree")["frames"] == []
    assert np.isnan(tab.frame_update().time)
    early_viewer.set_title("run.mcap: 40 % read")
    assert tab.wait("hello")["title"] == "run.mcap: 40 % read"
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 2.0, 0.0]), 100 * SECOND)
    early_viewer.set_source(BufferSource(buffer, "all of it"))
    hello = tab.wait("hello", lambda hello: hello["title"] == "all of it")
    assert [frame["name"] for frame in tab.wait("tree")["frames"]] == ["base", "map"]
    update = tab.frame_update()
    assert update.time + int(hello["origin"]) == 100 * SECOND
    np.testing.assert_allclose(tab.world(update, "base")[:3], [1.0, 2.0, 0.0])
    assert open_tab(early_viewer).wait("hello")["title"] == "all of it"


def test_earlier_requests_of_a_tab_apply_to_the_recording(shared, early_viewer, open_tab):
    tab = open_tab(early_viewer)
    tab.send("fixed", frame="tilt_base")
    tab.send("subscribe", id=1, topic="/scan", options={})
    assert tab.wait("display")["text"] == "no node publishes /scan"
    recording = coframe.open_bag(shared / "recordings" / "tilt_laser.bag")
    early_viewer.set_source(RecordedSource(recording, own=True))
    hello = tab.wait("hello")
    assert hello["mode"] == "recording"
    drawn = tab.wait("cloud")
    assert len(drawn.points)
    first, last = recording.span
    assert first <= drawn.stamp + int(hello["origin"]) <= last, "by the new origin"
