# SPDX-License-Identifier: Apache-2.0
"""Time that jumps back on a live ROS graph: loops, restarted replays, simulations; real DDS, real WebSockets."""

import threading
import time

import pytest

import coframe
from coframe.viewer.sources._time_jumps import BackwardJumps, TransformStamps

SECOND = 1_000_000_000
MILLISECOND = 1_000_000


def fed(jumps, rows, newest=0):
    """Return the jumps reported for rows of (arrival in ms, stamp in ms)."""
    return [jumps.add("base", stamp * MILLISECOND, now * MILLISECOND, newest) for now, stamp in rows]


def test_a_jump_is_reported_once_it_lasts():
    jumps = BackwardJumps()
    steady = [(100 * k, 20_000 + 100 * k) for k in range(20)]
    looped = [(2000 + 100 * k, 10_000 + 100 * k) for k in range(8)]
    assert not any(fed(jumps, steady))
    reported = fed(jumps, looped)
    assert not any(reported[:4]), "late messages look like this, too"
    first = next(jump for jump in reported if jump)
    assert first == pytest.approx(11.4e9, abs=0.3e9)


@pytest.mark.parametrize(
    "rows",
    [
        [(100 * k, 20_000 + 100 * k if k % 2 else 15_000 + 100 * k) for k in range(60)],
        [(100 * k, 20_000 + 100 * k if k % 10 == 0 else 15_000 + 100 * k) for k in range(80)],
        [(100 * k, 20_000) for k in range(60)],
        [(100 * k, 20_000 + 100 * k - (300 if k % 3 else 0)) for k in range(60)],
    ],
    ids=["two clocks", "two clocks at different rates", "one stamp again and again", "late messages"],
)
def test_other_disorder_is_not_a_jump(rows):
    settling = 20  # The interval between new stamps must be known first.
    assert not any(fed(BackwardJumps(), rows)[settling:])


def test_a_jump_is_noticed_by_comparison_with_the_buffer():
    """The viewer may have been started, or a tab opened, after the jump."""
    reported = fed(BackwardJumps(), [(100 * k, 10_000 + 100 * k) for k in range(20)], newest=20 * SECOND)
    assert any(reported)


def test_a_viewer_that_is_behind_sees_no_jump(domain_id):
    """A busy machine asks for the stamps rarely, and a fast robot fills the queue until then."""
    period, burst = 5 * MILLISECOND, 150
    with coframe.connect("robot", domain=domain_id) as robot, coframe.connect("viewer", domain=domain_id) as viewer:
        stamps = TransformStamps(viewer)
        stamp = time.time_ns()
        for number in range(6):
            for _ in range(burst):
                stamp += period
                robot.send("odom", "base", coframe.Transform([stamp % SECOND, 0, 0]), stamp=stamp)
            viewer.buffer.wait("odom", "base", stamp, timeout="20s")
            time.sleep(0.05)  # The stamps arrive in another queue.
            assert stamps.poll(number * SECOND, lambda _, newest=stamp: newest) == 0


class Replay:
    """Publishes odom -> base_link, a scan, and /clock if wanted, with the stamps that `start` chooses."""

    def __init__(self, domain, *, clock=False):
        from coframe.messages import find

        self.find = find
        self.ros = coframe.connect("replay", domain=domain)
        self.tf = self.ros.publisher("/tf", find("tf2_msgs/msg/TFMessage"))
        self.scans = self.ros.publisher("/scan", find("sensor_msgs/msg/LaserScan"))
        self.clock = self.ros.publisher("/clock", find("rosgraph_msgs/msg/Clock")) if clock else None
        self.sends_transforms = True
        self._offset = 0
        self.paused = False
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def start(self, stamp):
        """Publish from a stamp in nanoseconds on."""
        self._offset = stamp - time.monotonic_ns()
        if not self._thread.is_alive():
            self._thread.start()

    def _run(self):
        stamped = self.find("geometry_msgs/msg/TransformStamped")
        while not self._ended.wait(0.02):
            if self.paused:
                continue
            now = self._offset + time.monotonic_ns()
            if self.clock is not None:
                message = self.find("rosgraph_msgs/msg/Clock")()
                message.clock.sec, message.clock.nanosec = divmod(now, SECOND)
                self.clock.publish(message)
            if not self.sends_transforms:
                continue
            transform = stamped(child_frame_id="base_link")
            transform.header.frame_id = "odom"
            transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(now, SECOND)
            transform.transform.translation.x = now / SECOND
            self.tf.publish(self.find("tf2_msgs/msg/TFMessage")(transforms=[transform]))
            scan = self.find("sensor_msgs/msg/LaserScan")(ranges=[1.0, 2.0], range_max=10.0)
            scan.header.frame_id = "base_link"
            scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(now, SECOND)
            self.scans.publish(scan)

    def close(self):
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()
        self.ros.close()


@pytest.fixture
def replay(domain_id):
    pytest.importorskip("dds_library", reason="live sources need DDS")
    replays = []

    def make(**options):
        replays.append(Replay(domain_id, **options))
        return replays[-1]

    yield make
    for one in replays:
        one.close()


@pytest.fixture
def live_tab(domain_id, view, open_tab):
    with coframe.connect("coframe_view", domain=domain_id) as ros:

        def start(tabs=1):
            viewer = view(ros, fixed="odom")
            opened = [open_tab(viewer) for _ in range(tabs)]
            return opened if tabs > 1 else opened[0]

        yield start


def shown_x(tab, update):
    return tab.world(update, "base_link")[0]


def has_frame(tab):
    return any(frame["name"] == "base_link" for frame in tab.last.get("tree", {}).get("frames", ()))


def until(tab, condition):
    """Read messages until a condition is true, which may be so already."""
    deadline = time.monotonic() + 20
    while not condition():
        assert time.monotonic() < deadline, str({key: tab.last.get(key) for key in ("display", "pulse", "hello")})
        tab.read()


def test_a_looped_replay_moves_again(replay, live_tab):
    playing, tab = replay(), live_tab()
    tab.send("subscribe", id=1, topic="/scan")
    playing.start(1000 * SECOND)
    tab.frame_update(lambda update: has_frame(tab) and shown_x(tab, update) > 1000.5)
    until(tab, lambda: tab.last["display"]["state"] == "ok")
    playing.start(500 * SECOND)
    again = tab.wait("hello", lambda hello: hello["restart"])
    assert "The time of the transforms jumped back by" in again["restart"]
    tab.drawings.clear()
    tab.frame_update(lambda update: has_frame(tab) and 500 < shown_x(tab, update) < 600)
    until(tab, lambda: tab.drawings and tab.last["display"]["state"] == "ok")
    playing.start(800 * SECOND)
    tab.frame_update(lambda update: shown_x(tab, update) > 800)
    assert tab.received.count("hello") == 3, (
        "time may jump forward: the first hello, that for the origin, and a restart"
    )
    playing.start(790 * SECOND)
    tab.wait("hello", lambda hello: hello["restart"])
    tab.frame_update(lambda update: has_frame(tab) and 790 < shown_x(tab, update) < 799)


def test_a_reset_simulation_starts_again(replay, live_tab):
    """Only /clock jumps at first: the transforms of a robot that does not move yet are not published."""
    simulation, tab = replay(clock=True), live_tab()
    simulation.start(100 * SECOND)
    tab.frame_update(lambda update: has_frame(tab) and shown_x(tab, update) > 100.3)
    until(tab, lambda: tab.last["pulse"]["clock"] == "simulated")
    simulation.paused = True
    until(tab, lambda: tab.last["pulse"]["clock"] == "paused")
    assert tab.last["pulse"]["silence"] is None
    stats = tab.wait("stats")
    assert not any(frame["state"] == "stale" for frame in stats["frames"]), "a paused simulation is not stale"
    simulation.sends_transforms = False
    simulation.paused = False
    simulation.start(1 * SECOND)
    assert "/clock jumped back" in tab.wait("hello", lambda hello: hello["restart"])["restart"]
    simulation.sends_transforms = True
    tab.frame_update(lambda update: has_frame(tab) and shown_x(tab, update) < 60)


def test_the_reset_request_starts_again_in_all_tabs(replay, live_tab):
    playing = replay()
    tab, other = live_tab(tabs=2)
    playing.start(1000 * SECOND)
    for one in (tab, other):
        one.frame_update(lambda _update, one=one: has_frame(one))
    tab.send("restart")
    for one in (tab, other):
        assert one.wait("hello", lambda hello: hello["restart"])["restart"] == "Reset"


def test_rates_fall_when_publishers_die(replay, live_tab):
    playing, tab = replay(), live_tab()
    tab.send("subscribe", id=1, topic="/scan")
    playing.start(1000 * SECOND)

    def row(stats):
        names = [frame["name"] for frame in tab.has("tree")["frames"]]
        return stats["frames"][names.index("base_link")] if "base_link" in names else {"rate": None}

    for _ in range(2):  # After the first one, the displays open again, because the origin of times has changed.
        tab.wait("stats", lambda stats: (row(stats)["rate"] or 0) > 20)
    until(tab, lambda: tab.last["display"]["state"] == "ok")
    playing.paused = True
    stats = tab.wait("stats", lambda stats: row(stats)["rate"] == 0)
    assert row(stats)["state"] == "stale"
    assert tab.wait("pulse", lambda pulse: (pulse["silence"] or 0) > 1.5)["clock"] == "system"
    until(tab, lambda: "no message for" in tab.last["display"]["text"])
    assert tab.last["display"]["state"] == "waiting"
    playing.paused = False
    until(tab, lambda: tab.last["display"]["state"] == "ok")
