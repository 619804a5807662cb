"""A viewer that is there before what it shows: the tabs begin anew when that comes."""

import numpy as np
import pytest

import coframe
from coframe.viewer import expect
from coframe.viewer.sources.recorded import RecordedSource
from coframe.viewer.sources.source import BufferSource

SECOND = 1_000_000_000


@pytest.fixture
def expected():
    with expect("run.mcap", "buffer", fixed="map", port=0) as viewer:
        yield viewer


def test_the_page_is_there_before_the_frames(expected, open_tab):
    tab = open_tab(expected)
    hello = tab.wait("hello")
    assert (hello["title"], hello["mode"], hello["span"]) == ("run.mcap", "buffer", None)
    assert tab.wait("tree")["frames"] == []
    assert np.isnan(tab.tick().time)
    expected.entitle("run.mcap: 40 % read")
    assert tab.wait("hello")["title"] == "run.mcap: 40 % read"
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 2.0, 0.0]), 100 * SECOND)
    expected.show(BufferSource(buffer, "all of it"))
    hello = tab.wait("hello", lambda hello: hello["title"] == "all of it")
    assert [frame["name"] for frame in tab.wait("tree")["frames"]] == ["base", "map"]
    tick = tab.tick()
    assert tick.time + int(hello["origin"]) == 100 * SECOND
    np.testing.assert_allclose(tab.world(tick, "base")[:3], [1.0, 2.0, 0.0])
    assert open_tab(expected).wait("hello")["title"] == "all of it"


def test_what_a_tab_has_asked_for_is_there_when_the_recording_is(shared, expected, open_tab):
    tab = open_tab(expected)
    tab.send("fixed", frame="tilt_base")
    tab.send("subscribe", id=1, topic="/scan", display="LaserScan", options={})
    assert tab.wait("display")["text"] == "nobody publishes /scan"
    recording = coframe.open_bag(shared / "recordings" / "tilt_laser.bag")
    expected.show(RecordedSource(recording, own=True))
    hello = tab.wait("hello")
    assert hello["mode"] == "recording"
    drawn = tab.wait("cloud")
    assert len(drawn.points)
    first, last = recording.span
    assert first <= drawn.stamp + int(hello["origin"]) <= last, "by the new origin"
