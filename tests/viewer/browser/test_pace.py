# SPDX-License-Identifier: Apache-2.0
"""Frame rates with many frames and large clouds. `make test-slow ARGS=-s` prints the measurements."""

import subprocess
import sys
import time
from pathlib import Path

import pytest
from benchmarks.viewer_load import Broadcaster

import coframe

pytestmark = pytest.mark.slow

MEASURE_RATE = """() => new Promise((done) => {
    const [begin, updates] = [performance.now(), coframe.updates];
    let [last, drawn, gap] = [begin, updates, 0];
    const check = () => {
        const now = performance.now();
        if (coframe.updates !== drawn) {
            gap = Math.max(gap, now - last);
            [last, drawn] = [now, coframe.updates];
        }
        if (now - begin < 6000) requestAnimationFrame(check);
        else done({fps: (drawn - updates) / (now - begin) * 1000, gap});
    };
    check();
})"""


@pytest.mark.parametrize(("frames", "min_fps"), [(10, 20), (100, 15), (1000, 5)])
def test_many_moving_frames_reach_the_required_frame_rate(view, open_page, frames, min_fps):
    buffer = coframe.Buffer()
    with Broadcaster(buffer, frames):
        page = open_page(view(buffer).url).drawn()
        page.until("n => Object.keys(coframe.frames).length > n", frames)
        page.raw.wait_for_timeout(3000)
        measured = page.evaluate(MEASURE_RATE)
    print(f"{frames} frames: {measured['fps']:.1f} fps, longest pause {measured['gap']:.0f} ms")
    assert measured["fps"] >= min_fps


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
    pytest.importorskip("dds_library", reason="clouds are received over DDS")
    with coframe.connect("browser_clouds", domain=domain_id) as ros, Broadcaster(ros.buffer, 10):
        publisher = subprocess.Popen([sys.executable, "-c", CLOUDS, str(domain_id)])
        try:
            page = open_page(view(ros, fixed="map").url).drawn()
            page.until(
                "Object.values(coframe.displays).some(({messages: [one] = []}) => one?.points * one?.step === 1000000)"
            )
            page.raw.wait_for_timeout(3000)
            sequence = (
                "Object.values(coframe.displays).find((one) => one.topic === '/cloud').messages[0]?.sequence ?? 0"
            )
            before = page.evaluate(sequence)
            measured = page.evaluate(MEASURE_RATE)
            clouds = page.evaluate(sequence) - before
        finally:
            publisher.kill()
            publisher.wait()
    print(
        f"a million points: {measured['fps']:.1f} fps, {clouds / 6:.1f} clouds per second, "
        f"longest pause {measured['gap']:.0f} ms"
    )
    assert measured["fps"] >= 1
    assert measured["gap"] < 3000


PANELS = "".join(f"plot=odom:base_link.{one}&" for one in ("x", "y", "yaw", "roll", "distance", "delay"))
PANELS += "plot=/scan.rate&plot=/scan.ranges[0]&panel=plots&panel=message&panel=log&topic=/scan"


def test_the_panels_leave_most_of_the_time_of_the_page_to_the_scene(demo, open_page):
    spent, fps = {}, {}
    for what, link in (("no panel", ""), ("panels", f"#{PANELS}")):
        page = open_page(f"{demo.url}{link}").drawn()
        if link:
            page.until("document.querySelectorAll('#curves .curve[data-state=ok]').length === 8")
        page.raw.wait_for_timeout(2000)
        session = page.raw.context.new_cdp_session(page.raw)
        session.send("Performance.enable")
        begin, before = time.monotonic(), _main_thread(session)
        fps[what] = page.evaluate(MEASURE_RATE)["fps"]
        spent[what] = (_main_thread(session) - before) / (time.monotonic() - begin)
        page.raw.close()
        print(f"{what}: {100 * spent[what]:.0f} % of the main thread, {fps[what]:.1f} fps")
    assert spent["panels"] - spent["no panel"] < 0.35
    assert fps["panels"] > 0.5 * fps["no panel"]


def _main_thread(session):
    """Return the seconds that scripts, styles and the layout have taken."""
    metrics = {one["name"]: one["value"] for one in session.send("Performance.getMetrics")["metrics"]}
    return sum(metrics[name] for name in ("ScriptDuration", "RecalcStyleDuration", "LayoutDuration"))


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
def test_a_stuck_tab_does_not_increase_memory(open_page, minutes):
    from websockets.sync.client import connect

    root = Path(__file__).parents[3]
    server = subprocess.Popen([sys.executable, "-c", SERVER], stdout=subprocess.PIPE, text=True, cwd=root)
    try:
        url = server.stdout.readline().strip()
        page = open_page(url).drawn()
        with connect(url.replace("http", "ws") + "ws", max_size=None) as stuck:
            stuck.recv()
            page.raw.wait_for_timeout(15_000)  # longer than the ten seconds of history
            memory = []
            begin = time.monotonic()
            for _ in range(6 * minutes):
                page.raw.wait_for_timeout(10_000)
                memory.append(int(Path(f"/proc/{server.pid}/statm").read_text().split()[1]) * 4096 / 1e6)
            updates = page.evaluate("coframe.updates")
            page.until("updates => coframe.updates > updates", updates)
        print(f"{time.monotonic() - begin:.0f} s with a stuck tab: {', '.join(f'{size:.1f}' for size in memory)} MB")
        assert memory[-1] - memory[0] < 3.0
    finally:
        server.kill()
        server.wait()
        server.stdout.close()
