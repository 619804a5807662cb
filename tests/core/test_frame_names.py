# SPDX-License-Identifier: Apache-2.0
"""Frame prefixes follow the same rules in Python, in relays and when bytes are ingested."""

import pytest

import coframe
from coframe import _core, frame_names
from coframe.messages import codec, find

TF_MESSAGE = find("tf2_msgs/msg/TFMessage")
TRANSFORM_STAMPED = find("geometry_msgs/msg/TransformStamped")


def stamped(parent, child, *, x=0.0, stamp=1_000_000_000):
    message = TRANSFORM_STAMPED()
    message.header.frame_id, message.child_frame_id = parent, child
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 10**9)
    message.transform.translation.x = x
    message.transform.rotation.w = 1.0
    return message


def cdr(*transforms):
    return codec.serialize(TF_MESSAGE(transforms=list(transforms)))


def edges_of(message):
    found = codec.deserialize(message, TF_MESSAGE).transforms
    return [(t.header.frame_id, t.child_frame_id, t.transform.translation.x) for t in found]


@pytest.mark.parametrize(
    ("prefix", "name", "becomes"),
    [
        ("robot1/", "base_link", "robot1/base_link"),
        ("robot1", "base_link", "robot1base_link"),  # No slash is added.
        ("robot1/", "/base_link", "robot1/base_link"),
        ("robot1/", "//base_link", "robot1//base_link"),
        ("robot1/", "map", "map"),
        ("robot1/", "/map", "map"),
        ("robot1/", "map2", "robot1/map2"),
        ("robot1/", "robot1/odom", "robot1/odom"),
        ("robot1/", "robot1", "robot1/robot1"),
        ("robot1/", "robot10/odom", "robot1/robot10/odom"),
        ("r", "rear", "rrear"),
        ("r1_", "odom", "r1_odom"),
        ("robot1/", "", ""),
        ("ü/", "ö", "ü/ö"),
    ],
)
def test_prefixes_are_added_by_the_rules(prefix, name, becomes):
    assert frame_names.renaming(prefix, keep="map, world")(name) == becomes


def test_an_empty_prefix_renames_nothing_and_a_leading_slash_is_refused():
    assert frame_names.renaming("", keep=["map"]) is None
    with pytest.raises(ValueError, match=r"'/robot1/' begins with a slash, .* Use 'robot1/'"):
        frame_names.renaming("/robot1/")


def relay(*prefixes, keep=(), split=False, static=False, period=0):
    """Return a relay with one source per prefix, and a function that returns its output as (parent, child, x)."""
    native = _core.Relay(static, period)
    for prefix in prefixes:
        native.add_source(_core.Renaming(prefix, list(keep)), split)

    def pass_on(source, *transforms, at=0, writer=1):
        native.add(source, writer, cdr(*transforms), at)
        message = native.take()
        return [] if message is None else edges_of(message)

    return native, pass_on


def test_a_relay_prefixes_all_frames_but_the_shared_ones():
    _, pass_on = relay("robot1/", "robot2/", keep=["map"])
    for _ in range(2):  # names that are new, and names that are remembered
        assert pass_on(0, stamped("map", "/odom"), stamped("odom", "base")) == [
            ("map", "robot1/odom", 0.0),
            ("robot1/odom", "robot1/base", 0.0),
        ]
        assert pass_on(1, stamped("map", "odom", x=2.0)) == [("map", "robot2/odom", 2.0)]


def test_splitting_removes_the_prefix():
    _, pass_on = relay("robot1/", keep=["map"], split=True)
    message = [
        stamped("map", "robot1/odom"),
        stamped("robot1/odom", "robot1/base"),
        stamped("map", "robot2/odom"),
        stamped("world", "map"),
        stamped("map", "table"),
    ]
    for _ in range(2):
        assert pass_on(0, *message) == [("map", "odom", 0.0), ("odom", "base", 0.0), ("world", "map", 0.0)]


def test_of_two_publishers_of_a_frame_the_first_is_used_until_it_stops():
    native, pass_on = relay("", "")
    assert pass_on(0, stamped("map", "odom", x=1.0), at=0)
    assert pass_on(1, stamped("map", "odom", x=2.0), at=10**9) == []
    assert pass_on(0, stamped("map", "odom", x=1.5), at=2 * 10**9) == [("map", "odom", 1.5)]
    [edge] = native.edges()
    assert (edge[2], edge[4], edge[5]) == (0, 1, 1)  # the owner, the rival, how often it was left out
    assert pass_on(1, stamped("map", "odom", x=2.0), at=5 * 10**9) == [("map", "odom", 2.0)]
    assert pass_on(0, stamped("map", "odom", x=1.0), at=5 * 10**9) == []


def test_all_static_transforms_are_written_when_one_is_new():
    native, pass_on = relay("robot1/", "robot2/", keep=["map", "world"], static=True)
    mount, placed = ("robot1/base", "robot1/lidar", 0.5), ("world", "map", 0.0)
    assert pass_on(0, stamped("base", "lidar", x=0.5), stamped("world", "map")) == [mount, placed]
    assert pass_on(0, stamped("base", "lidar", x=0.5)) == []  # nothing new
    # The same transform from another robot is not a conflict, a different one is; and no publisher stops.
    assert pass_on(1, stamped("world", "map"), stamped("base", "cam"), at=10**12) == [
        mount,
        placed,
        ("robot2/base", "robot2/cam", 0.0),
    ]
    assert [edge for edge in native.edges() if edge[4] is not None] == []
    assert pass_on(1, stamped("world", "map", x=9.0), at=10**12) == []
    assert [edge[1] for edge in native.edges() if edge[4] is not None] == ["map"]
    # A frame that moves to another parent is reported once.
    moved = pass_on(0, stamped("mast", "lidar", x=0.7))
    assert [edge for edge in moved if edge[1] == "robot1/lidar"] == [("robot1/mast", "robot1/lidar", 0.7)]


def test_the_average_rate_of_each_edge_is_limited():
    native, pass_on = relay("", period=10**8)  # 10 Hz
    passed = 0
    for number in range(500):  # 50 Hz, for ten seconds, not quite regular
        passed += len(pass_on(0, stamped("a", "b"), at=10**12 + number * 20_000_000 + number % 3 * 1_000_000))
    assert 99 <= passed <= 101
    [edge] = native.edges()
    assert (edge[6], edge[6] + edge[7]) == (passed, 500)


def test_a_relay_drops_transforms_that_a_buffer_would_refuse():
    native, pass_on = relay("robot1/")
    nan = stamped("a", "b")
    nan.transform.translation.x = float("nan")
    assert pass_on(0, stamped("a", "a"), nan, stamped("a", ""), stamped("", "b"), stamped("a", "c")) == [
        ("robot1/a", "robot1/c", 0.0)
    ]
    native.add(0, 1, b"\0\1\0\0\xff\xff\xff\x7f")
    native.add(0, 1, b"")
    assert native.take() is None
    [(writer, malformed, refused, over_limit)] = native.writers(0)
    assert (writer[1], malformed, refused, over_limit) == (3, 2, 4, 0)
    with pytest.raises(IndexError):
        native.add(7, 1, cdr())


def test_the_number_of_frames_of_a_writer_is_bounded():
    native = _core.Relay(False, 0)
    native.add_source(_core.Renaming("", []), False)
    for batch in range(70):
        native.add(0, batch, cdr(*(stamped("a", f"b{batch}_{number}") for number in range(1000))))
    assert len(native.edges()) == 65536
    assert sum(over_limit for _, _, _, over_limit in native.writers(0)) == 70_000 - 65536


def test_naming_problems_are_reported_with_examples():
    native, pass_on = relay("robot1/", keep=["map"])
    pass_on(0, stamped("map", "odom"))
    [(writer, *_)] = native.writers(0)
    assert writer[5:] == ("", "", "odom")
    pass_on(0, stamped("/map", "robot1/odom"))
    [(writer, *_)] = native.writers(0)
    assert writer[5:] == ("/map", "robot1/odom", "odom")
    problems = frame_names.naming_problems("/robot1/tf", *writer[5:])
    assert "'/map'; its leading slash is removed" in problems[0]
    assert "for only some of its frames: 'robot1/odom' and 'odom'" in problems[1]


def test_the_clock_offset_of_a_source_ignores_single_wild_stamps():
    import time

    native = _core.Relay(False, 0)
    native.add_source(_core.Renaming("", []), False)
    for number in range(30):
        wrong = 10**12 if number % 5 == 0 else 0  # Every fifth stamp is wild.
        now = time.time_ns() + 10**9 + wrong
        native.add(0, 1, cdr(stamped("a", "b", stamp=now)))
        if number < 14:
            assert native.writers(0)[0][0][4] is None
    assert native.writers(0)[0][0][4] == pytest.approx(-(10**9), abs=5 * 10**7)


def test_frames_are_renamed_when_bytes_are_ingested():
    buffer = coframe.Buffer()
    names = frame_names.renaming("robot1/", keep=["map"])
    message = cdr(stamped("map", "odom"), stamped("/odom", "base", x=1.0))
    for _ in range(2):
        _core.ingest_slices(buffer, message, array(0), array(len(message)), False, "bag", renaming=names)
    assert sorted(buffer.frame_names()) == ["map", "robot1/base", "robot1/odom"]
    assert buffer.lookup("map", "robot1/base").translation[0] == 1.0


def array(*values):
    import numpy as np

    return np.array(values, np.uint64)
