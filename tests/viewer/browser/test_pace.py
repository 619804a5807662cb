"""How fast it is where there is much to draw: `make test-slow ARGS=-s` prints what it measures."""

import subprocess
import sys
import time
from pathlib import Path

import pytest
from benchmarks.viewer_load import Broadcaster

import coframe

pytestmark = pytest.mark.slow

RATES = """() => new Promise((done) => {
    const [begin, ticks] = [performance.now(), coframe.ticks];
    let [last, seen, gap] = [begin, ticks, 0];
    const look = () => {
        const now = performance.now();
        if (coframe.ticks !== seen) {
            gap = Math.max(gap, now - last);
            [last, seen] = [now, coframe.ticks];
        }
        if (now - begin < 6000) requestAnimationFrame(look);
        else done({draws: (seen - ticks) / (now - begin) * 1000, gap});
    };
    look();
})"""


@pytest.mark.parametrize(("frames", "least"), [(10, 20), (100, 15), (1000, 5)])
def test_so_many_moving_frames_are_drawn_often_enough(view, open_page, frames, least):
    buffer = coframe.Buffer()
    with Broadcaster(buffer, frames):
        page = open_page(view(buffer).url).drawn()
        page.until("n => Object.keys(coframe.frames).length > n", frames)
        page.raw.wait_for_timeout(3000)
        told = page.ask(RATES)
    print(f"{frames} frames: {told['draws']:.1f} pictures a second, the longest pause {told['gap']:.0f} ms")
    assert told["draws"] >= least


CLOUDS = """
import sys, time
from array import array
import numpy as np, coframe
from coframe.messages import find
field = find("sensor_msgs/msg/PointField")
count = 1_000_000
cloud = find("sensor_msgs/msg/PointCloud2")(height=1, width=count, point_step=12, row_step=12 * count, is_dense=True)
cloud.fields = [field(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate("xyz")]
cloud.data = array("B", np.random.default_rng(1).uniform(-5, 5, (count, 3)).astype("<f4").tobytes())
cloud.header.frame_id = "map"
with coframe.connect("clouds", domain=int(sys.argv[1])) as ros:
    publisher = ros.publisher("/cloud", type(cloud))
    due = time.monotonic()
    while True:
        cloud.header.stamp.sec, cloud.header.stamp.nanosec = divmod(time.time_ns(), 10**9)
        publisher.publish(cloud)
        due += 0.1
        time.sleep(max(0.0, due - time.monotonic()))
"""


def test_a_cloud_of_a_million_points_does_not_stall_the_frames(domain_id, view, open_page):
    pytest.importorskip("cyclonedds", reason="clouds come over DDS")
    with coframe.connect("browser_clouds", domain=domain_id) as ros, Broadcaster(ros.buffer, 10):
        talker = subprocess.Popen([sys.executable, "-c", CLOUDS, str(domain_id)])
        try:
            page = open_page(view(ros, fixed="map").url).drawn()
            page.until(
                "Object.values(coframe.displays).some(({messages: [one] = []}) => one?.points * one?.step === 1000000)"
            )
            page.raw.wait_for_timeout(3000)
            sequence = (
                "Object.values(coframe.displays).find((one) => one.topic === '/cloud').messages[0]?.sequence ?? 0"
            )
            before = page.ask(sequence)
            told = page.ask(RATES)
            clouds = page.ask(sequence) - before
        finally:
            talker.kill()
            talker.wait()
    print(
        f"a million points: {told['draws']:.1f} pictures, {clouds / 6:.1f} clouds a second, pause {told['gap']:.0f} ms"
    )
    assert told["draws"] >= 1
    assert told["gap"] < 3000


SERVER = """
import sys, threading, coframe
from benchmarks.viewer_load import Broadcaster
buffer = coframe.Buffer()
with Broadcaster(buffer, 1000), coframe.show(buffer, port=0) as viewer:
    print(viewer.url, flush=True)
    threading.Event().wait()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory of another process is read from /proc")
@pytest.mark.parametrize("minutes", [1, pytest.param(10, marks=pytest.mark.long)])
@pytest.mark.timeout(900)
def test_a_stuck_tab_beside_a_page_takes_no_memory(open_page, minutes):
    from websockets.sync.client import connect

    root = Path(__file__).parents[3]
    server = subprocess.Popen([sys.executable, "-c", SERVER], stdout=subprocess.PIPE, text=True, cwd=root)
    try:
        url = server.stdout.readline().strip()
        page = open_page(url).drawn()
        with connect(url.replace("http", "ws") + "ws", max_size=None) as stuck:
            stuck.recv()
            page.raw.wait_for_timeout(15_000)  # ten seconds of history, and some
            memory = []
            begin = time.monotonic()
            for _ in range(6 * minutes):
                page.raw.wait_for_timeout(10_000)
                memory.append(int(Path(f"/proc/{server.pid}/statm").read_text().split()[1]) * 4096 / 1e6)
            ticks = page.ask("coframe.ticks")
            page.until("ticks => coframe.ticks > ticks", ticks)
        print(f"{time.monotonic() - begin:.0f} s with a stuck tab: {', '.join(f'{size:.1f}' for size in memory)} MB")
        assert memory[-1] - memory[0] < 3.0
    finally:
        server.kill()
        server.wait()
        server.stdout.close()
