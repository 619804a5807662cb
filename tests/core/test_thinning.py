# SPDX-License-Identifier: Apache-2.0
"""A relay with a maximum error: lookups stay close to what was published, at a fraction of the bytes."""

import math

import numpy as np
import pytest
from benchmarks import thinning
from benchmarks.thinning import Message
from hypothesis import given, settings
from hypothesis import strategies as st

from coframe import _core
from coframe.messages import codec, find
from coframe.tf_relay import MaxError

MS = 1_000_000
PERIOD, HEARTBEAT = 100 * MS, 500 * MS
START = 1_700_000_000_000_000_000
MAX_ERROR = MaxError.of("1mm,0.1deg")


def stamped(stamp, position=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0), *, parent="odom", child="base"):
    message = find("geometry_msgs/msg/TransformStamped")()
    message.header.frame_id, message.child_frame_id = parent, child
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(START + stamp, 10**9)
    t, r = message.transform.translation, message.transform.rotation
    t.x, t.y, t.z = map(float, position)
    r.x, r.y, r.z, r.w = map(float, rotation)
    return message


def yaw(angle):
    return 0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)


def cdr(*transforms):
    return codec.serialize(find("tf2_msgs/msg/TFMessage")(transforms=list(transforms)))


class Link:
    """A relay and its subscriber; times are nanoseconds since the start, for stamps and arrivals alike."""

    def __init__(self, most=MAX_ERROR, period=PERIOD):
        self.native = _core.Relay(False, period, most)
        self.native.add_source(_core.Renaming("", []), False)
        self.sent = []  # (time of sending, stamp, parent, child, x)

    def add(self, at, *transforms):
        self.wait(at)
        self.native.add(0, 1, cdr(*transforms), at)
        self.take(at)

    def wait(self, until):
        while (due := self.native.next_due()) is not None and due < until:
            self.take(due)

    def take(self, at):
        message = self.native.take(at)
        for t in codec.deserialize(message, find("tf2_msgs/msg/TFMessage")).transforms if message else ():
            stamp = t.header.stamp.sec * 10**9 + t.header.stamp.nanosec - START
            self.sent.append((at, stamp, t.header.frame_id, t.child_frame_id, t.transform.translation.x))

    def stamps(self, child="base"):
        return [stamp // MS for _, stamp, _, frame, _ in self.sent if frame == child]


def test_uniform_motion_is_sent_at_the_rate():
    link = Link()
    for number in range(51):  # 50 Hz, 1 m/s and 1 rad/s
        at = 20 * MS * number
        link.add(at, stamped(at, (at / 1e9, 0, 0), yaw(at / 1e9)))
    assert link.stamps() == list(range(0, 1001, 100))
    assert all(sent == stamp for sent, stamp, *_ in link.sent)


def test_a_robot_that_stands_still_is_sent_at_the_heartbeat_and_a_moving_one_as_a_whole():
    link = Link()
    for number in range(150):
        at = 20 * MS * number
        x = max(0.0, at - 2e9) / 1e9  # moves after two seconds
        link.add(at, stamped(at, (x, 0, 0)), stamped(at, parent="base", child="arm"))
    for child in ("base", "arm"):
        assert link.stamps(child)[:5] == [0, 500, 1000, 1500, 2000], child
        assert max(np.diff(link.stamps(child)[4:])) <= 120
    assert [stamp for stamp in link.stamps("arm") if stamp >= 2100] == [
        stamp for stamp in link.stamps("base") if stamp >= 2100
    ]


def test_the_sample_before_a_jump_is_sent_and_the_jump_within_the_period():
    link = Link()
    for number in range(12):
        at = 20 * MS * number
        link.add(at, stamped(at, (0.0 if number < 9 else 1.0, 0, 0)))
    link.wait(10**9)
    before, after = link.stamps()[1:3]
    assert before == 160  # the last one at the old place
    assert 180 <= after <= 260
    assert link.sent[2][0] <= (180 + 100) * MS


def test_pending_transforms_of_a_robot_that_falls_silent_are_sent():
    link = Link()
    for number in range(3):
        link.add(20 * MS * number, stamped(20 * MS * number, (number, 0, 0)))
    link.wait(10**10)
    assert link.stamps()[-1] == 40
    assert link.native.next_due() is None


def test_late_and_repeated_transforms_leave_nothing_out_around_them():
    link = Link()
    times = [0, 20, 40, 60, 50, 80, 80, 100]
    for arrival, stamp in enumerate(times):
        link.add(arrival * 10 * MS, stamped(stamp * MS))
    assert link.stamps() == [0, 20, 40, 60, 50]  # all up to the late one; 80 came twice and 100 is pending
    link.add(100 * MS, stamped(100 * MS, (1, 0, 0)))
    assert link.stamps()[5:7] == [80, 100][: len(link.stamps()) - 5]
    assert 100 in link.stamps()


def test_a_new_parent_ends_the_interpolation():
    link = Link()
    for number, parent in enumerate(["odom", "odom", "odom", "map", "map", "odom"]):
        at = 20 * MS * number
        link.add(at, stamped(at, (number, 0, 0), parent=parent))
    assert [(stamp // MS, parent) for _, stamp, parent, *_ in link.sent] == [
        (0, "odom"),
        (40, "odom"),
        (60, "map"),
        (80, "map"),
        (100, "odom"),
    ]


def test_a_clock_that_was_set_back_is_thinned_again():
    link = Link()
    for number in range(100):
        at = 20 * MS * number
        link.add(at, stamped(at + (3_600_000 * MS if number < 50 else 0)))
    assert 2 <= len([stamp for stamp in link.stamps() if stamp < 3_600_000]) <= 5


def test_half_turns_are_sent_because_they_cannot_be_interpolated():
    link = Link(MaxError(1.0, math.pi / 4))
    for number in range(6):
        at = 20 * MS * number
        link.add(at, stamped(at, (0, 0, 0), yaw(math.radians(100) * number)))
    assert link.stamps() == [0, 20, 40, 60, 80, 100]


def test_counters_add_up():
    link = Link()
    for number in range(50):
        link.add(20 * MS * number, stamped(20 * MS * number, (math.sin(number), 0, 0)))
    link.wait(10**10)
    [edge] = link.native.edges()
    forwarded, skipped = edge[6:8]
    assert forwarded == len(link.sent)
    assert forwarded + skipped == 50


def test_the_number_of_pending_transforms_is_bounded():
    native = _core.Relay(False, 10**12, (0.01, 0.01))
    native.add_source(_core.Renaming("", []), False)
    for number in range(1000):
        native.add(0, 1, cdr(stamped(number * MS)), number)
    [edge] = native.edges()
    assert 1000 - sum(edge[6:8]) <= 64


@pytest.mark.parametrize("most", [(-1.0, 0.1), (0.1, 1.0), (math.nan, 0.1), (0.1, math.nan)])
def test_errors_that_make_no_sense_are_refused(most):
    with pytest.raises(ValueError, match="45 degrees"):
        _core.Relay(False, 0, most)
    with pytest.raises(ValueError, match="45 degrees"):
        MaxError.of(most)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1mm,0.1deg", (0.001, math.radians(0.1))),
        (" 0.1deg , 2 cm ", (0.02, math.radians(0.1))),
        ("0m,5mrad", (0.0, 0.005)),
        (".5m,0.02rad", (0.5, 0.02)),
    ],
)
def test_a_maximum_error_is_a_distance_and_an_angle(text, expected):
    assert MaxError.of(text) == pytest.approx(expected)


@pytest.mark.parametrize("text", ["1mm", "0.1deg", "1,0.1", "1mm,2mm", "1mm,0.1deg,", "", "1 parsec,1deg"])
def test_texts_that_are_not_a_maximum_error_are_refused(text):
    with pytest.raises(ValueError, match=r"such as 1mm,0\.1deg"):
        MaxError.of(text)


@st.composite
def trajectories(draw):
    """Return stamps, positions and rotations: smooth, still, jumping and spinning pieces, with noise."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    count = draw(st.integers(2, 120))
    steps = random.integers(1, draw(st.sampled_from([2, 40, 400])) * MS, count)
    scale = 10.0 ** random.uniform(-5, 1)
    rates = scale * random.normal(size=(count, 6)) * random.choice([0, 1], size=(count, 1), p=[0.3, 0.7])
    pieces = random.integers(1, 30)
    rates = np.repeat(rates[:: int(pieces)], int(pieces), axis=0)[:count]  # constant velocities for a while
    jumps = np.where(random.random((count, 1)) < draw(st.sampled_from([0.0, 0.05, 1.0])), 1.0, 0.0)
    moves = rates * steps[:, None] / 1e9 + jumps * random.normal(size=(count, 6)) * scale
    position, rotation = np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0])
    poses = []
    for move in moves:
        position = position + move[:3]
        angle = np.linalg.norm(move[3:])
        axis = move[3:] / angle if angle > 0 else move[3:]
        turn = np.append(np.sin(angle / 2) * axis, np.cos(angle / 2))
        rotation = product(rotation, turn)
        rotation /= np.linalg.norm(rotation)
        poses.append((position, rotation if draw(st.booleans()) else -rotation))
    return np.cumsum(steps), poses


def product(a, b):
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


@settings(max_examples=80, deadline=None)
@given(trajectories(), st.floats(-5, 0), st.floats(-4, -0.11))
def test_lookups_stay_within_the_maximum_error(trajectory, distance, angle):
    most = MaxError(10.0**distance, 10.0**angle)
    stamps, poses = trajectory
    messages = [Message(int(at), cdr(stamped(int(at), *pose))) for at, pose in zip(stamps, poses, strict=True)]
    sent = thinning.relayed(messages, 10.0, most)
    original, thinned = thinning.buffer_of(messages, []), thinning.buffer_of(sent, [])
    # The ends are sent, and times between two samples count as well.
    assert original.span("odom", "base") == thinned.span("odom", "base")
    worst = thinning.error(original, thinned, [("odom", "base")], seed=1)
    assert worst.distance <= most.distance * (1 + 1e-9) + 1e-12
    assert worst.angle <= most.angle * (1 + 1e-9) + 1e-7


# Of the bytes of each recording, at most a fifth is sent. At 10 Hz this is possible only where more is published.
@pytest.mark.parametrize(
    ("name", "rate", "text", "reach"),  # the last one is the longest distance between two frames, in meters
    [
        ("turtlesim_tf_demo.bag", 10.0, "1mm,0.1deg", 16.0),
        ("tb3_tf_missing_static", 10.0, "1mm,0.1deg", 2.0),
        ("tb3_gazebo_walker", 2.0, "5mm,0.5deg", 2.0),
        ("epuck_webots", 2.0, "5mm,0.5deg", 2.0),
        ("tilt_laser.bag", 2.0, "5mm,0.5deg", 2.0),
    ],
)
def test_recorded_robots_are_sent_with_a_fifth_of_the_bytes(shared, name, rate, text, reach):
    dynamic, static = thinning.recorded(shared / "recordings" / name)
    most = MaxError.of(text)
    outcome = thinning.measure(dynamic, static, rate, most)
    assert thinning.size(outcome.sent) <= thinning.size(dynamic) / 5
    assert outcome.edges.distance <= most.distance
    assert outcome.edges.angle <= most.angle + 1e-7
    # The errors of up to three dynamic edges of a chain add up, those of rotations with the distance.
    assert outcome.chains.angle <= 3 * most.angle
    assert outcome.chains.distance <= 3 * (most.distance + reach * most.angle)
