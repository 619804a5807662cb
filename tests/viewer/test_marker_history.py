# SPDX-License-Identifier: Apache-2.0
"""Markers after jumps in a recording, markers with stamps of their own, and drawings that stay visible."""

from types import SimpleNamespace

import numpy as np

import coframe
from coframe.messages import find
from coframe.viewer.displays import Drawing, Options, display
from coframe.viewer.displays.kinds import markers
from coframe.viewer.displays.resources import Resources
from coframe.viewer.displays.rows import make_renderer
from coframe.viewer.replay.displays import ImmediateExecutor
from coframe.viewer.sources.topic_messages import StampedMessage

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
MARKER = "visualization_msgs/msg/Marker"


class Messages:
    """The messages of a recorded topic."""

    shortfall = ""

    def __init__(self, made, times):
        self.type = made[0].ROS_TYPE
        self.stored = [
            StampedMessage(key, time, lambda one=one: one)
            for key, (one, time) in enumerate(zip(made, times, strict=True), start=1)
        ]

    def frame(self, name):
        return name

    def pending(self):
        return False

    def at(self, time):
        return next((one for one in reversed(self.stored) if time == 0 or one.time <= time), None)

    def after(self, key, last):
        return self.stored[key:last]


def marker(number, stamp=0, **fields):
    made = find(MARKER)(id=number, type=1, **fields)
    made.header.frame_id = "map"
    made.header.stamp.sec, made.header.stamp.nanosec = divmod(stamp, SECOND)
    made.pose.orientation.w = 1.0
    return made


def ids(drawings):
    import json
    import struct

    found = []
    for drawing in drawings:
        (length,) = struct.unpack_from("<I", drawing.data, 12)
        found += [(item["id"]) for item in json.loads(drawing.data[16 : 16 + length])["items"]]
    return sorted(found)


def test_all_earlier_messages_build_the_markers_after_a_jump(monkeypatch):
    monkeypatch.setattr(markers, "_STEP", 1e9)
    count = 1500
    messages = Messages([marker(number) for number in range(count)], BEGIN + np.arange(count) * SECOND)
    renderer = make_renderer(messages, Options(), Resources())
    newest = messages.stored[-1]
    assert ids(renderer.draw(newest, newest.time, newest.time)) == list(range(count))
    for earlier in (1200, 3, 700):
        message = messages.stored[earlier - 1]
        fresh = make_renderer(messages, Options(), Resources()).draw(message, message.time, message.time)
        assert ids(fresh) == list(range(earlier))
        again = renderer.draw(message, message.time, message.time)
        assert ids(again) == list(range(earlier)), "a jump back starts from a snapshot"


def test_reading_many_earlier_messages_reports_the_progress(monkeypatch):
    monkeypatch.setattr(markers, "_STEP", -1.0)
    messages = Messages([marker(number) for number in range(3)], [BEGIN, BEGIN + 1, BEGIN + 2])
    shown = display.Display(1, messages, Options(), Resources(), ImmediateExecutor())
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    texts = []
    for _ in range(8):
        shown.update(buffer, "map", 0, BEGIN + 2)
        texts.append((shown.status.state, shown.status.text))
    assert ("waiting", "reading earlier markers: 2 messages left") in texts
    assert texts[-1] == ("ok", "")


def test_markers_with_stamps_of_their_own_are_grouped_by_close_stamps():
    stamps = BEGIN + np.arange(3000) * 20_000  # A loop that calls now() takes 20 microseconds for each marker.
    array = find("visualization_msgs/msg/MarkerArray")(
        markers=[marker(number, int(stamp)) for number, stamp in enumerate(stamps)]
    )
    messages = Messages([array], [BEGIN])
    drawings = make_renderer(messages, Options(), Resources()).draw(messages.stored[0], BEGIN, BEGIN)
    assert len(drawings) <= markers.MAX_STAMPS
    assert ids(drawings) == list(range(3000))
    rounded = np.sort([drawing.stamp for drawing in drawings])
    assert np.diff(rounded).max() <= 12 * 20_000, "stamps are rounded by at most a quarter of a millisecond"


def test_few_stamps_are_exact_even_if_they_are_far_apart():
    far = [marker(1, BEGIN), marker(2, BEGIN + 3600 * SECOND)]
    messages = Messages([find("visualization_msgs/msg/MarkerArray")(markers=far)], [BEGIN])
    drawings = make_renderer(messages, Options(), Resources()).draw(messages.stored[0], BEGIN, BEGIN)
    assert sorted(drawing.stamp for drawing in drawings) == [BEGIN, BEGIN + 3600 * SECOND]


class Fixed:
    """A renderer whose drawings have a size."""

    def __init__(self, size):
        self.size = size

    def draw(self, message, _time, _at):
        return [Drawing("map", message.time, bytearray(self.size))]

    def has_changed(self, _time, _at):
        return False


def layers_after(monkeypatch, count, size, **options):
    monkeypatch.setattr(display, "make_renderer", lambda *_arguments: Fixed(size))
    stored = [StampedMessage(key + 1, BEGIN + key * SECOND // 10, lambda: None) for key in range(count)]
    messages = SimpleNamespace(
        type="", shortfall="", frame=lambda name: name, pending=lambda: False, at=lambda _time: stored[at]
    )
    shown = display.Display(1, messages, Options(**options), Resources(), ImmediateExecutor())
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    for at in range(count):  # noqa: B007 - the messages use it
        for _ in ("draw", "place"):
            shown.update(buffer, "map", 0, 0)
    return shown


def test_messages_stay_visible_for_the_whole_decay_time(monkeypatch):
    shown = layers_after(monkeypatch, 500, 100, decay=1000.0)
    assert (len(shown.poses()), shown.status.note) == (500, "")
    assert len(layers_after(monkeypatch, 500, 100, decay=10.0).poses()) == 101
    assert len(layers_after(monkeypatch, 50, 100, history=7).poses()) == 7
    assert len(layers_after(monkeypatch, 50, 100).poses()) == 1


def test_the_memory_limits_the_decay_time_and_the_display_says_so(monkeypatch):
    monkeypatch.setattr(display, "MAX_LAYER_BYTES", 1 << 20)
    shown = layers_after(monkeypatch, 100, (1 << 16) - 4096, decay=1000.0)
    assert len(shown.poses()) == 16
    assert shown.status == ("ok", "", "the last 2 s, because the drawings take at most 1 MiB")
