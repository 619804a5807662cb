# SPDX-License-Identifier: Apache-2.0
"""Measures the cost of a tab of the viewer for its server, at 30 Hz and in addition to the lookups.

    python -m benchmarks.viewer_load 1000 5     frames, seconds: percent of one core

The frames move in chains of five and are updated 30 times per second. The tab is another process, which confirms each
frame update. The program prints the processor time of the viewer's threads without the lookups, that of the lookups,
and the frame updates per second.
"""

import re
import subprocess
import sys
import threading
import time

import numpy as np
from typing_extensions import Self

import coframe
from coframe import _core
from coframe.messages import find, serialize

RATE_HZ = 30
DEPTH = 5
WARM_UP = 1.0
MAGIC = 0x5EC0_5EC0
"""Seconds of the stamps, to find them in the bytes."""

TAB = """
import sys
from websockets.sync.client import connect
with connect(sys.argv[1].replace("http", "ws") + "ws", max_size=None, compression=None) as socket:
    while True:
        message = socket.recv()
        if isinstance(message, bytes):
            socket.send('{"type":"ready"}')
            print(flush=True)
"""


class Broadcaster:
    """Stores a sample of each frame repeatedly, as a listener does, and measures its processor time."""

    def __init__(self, buffer: coframe.Buffer, frames: int) -> None:
        stamped = find("geometry_msgs/msg/TransformStamped")
        transforms = []
        for i in range(frames):
            one = stamped(child_frame_id=f"frame_{i:05}")
            one.header.frame_id = "map" if i % DEPTH == 0 else f"frame_{i - 1:05}"
            one.header.stamp.sec = MAGIC
            one.transform.translation.x = 0.1 * i
            transforms.append(one)
        message = serialize(find("tf2_msgs/msg/TFMessage")(transforms=transforms))
        self._bytes = np.frombuffer(bytearray(message), np.uint8)
        offsets = [match.start() for match in re.finditer(re.escape(MAGIC.to_bytes(4, "little")), message)]
        self._stamps = np.add.outer(offsets, np.arange(8))
        self._buffer = buffer
        self._ended = threading.Event()
        self.spent = 0.0
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._ended.wait(1 / RATE_HZ):
            seconds, nanoseconds = divmod(time.time_ns(), 1_000_000_000)
            self._bytes[self._stamps] = np.array([seconds, nanoseconds], "<u4").view(np.uint8)
            self._buffer.ingest(self._bytes)
            self.spent = time.thread_time()


def lookups(buffer: coframe.Buffer, updates: int) -> float:
    """Return the seconds that the lookups of a number of frame updates take."""
    names = buffer.frame_names()
    roots: list[str | None] = [None] * len(names)
    poses, states = np.empty((len(names), 7)), np.empty(len(names), np.uint8)
    table = _core.PoseTable(buffer, "map", names, roots)
    begin = time.thread_time()
    for _ in range(updates):
        table.look_up(0, 0, poses, states)
    return time.thread_time() - begin


def main(frames: int, seconds: float) -> None:
    buffer = coframe.Buffer()
    with Broadcaster(buffer, frames) as broadcaster, coframe.show(buffer, fixed="map", port=0) as viewer:
        tab = subprocess.Popen([sys.executable, "-c", TAB, viewer.url], stdout=subprocess.PIPE)
        assert tab.stdout
        updates = 0
        counted = threading.Event()

        def count() -> None:
            nonlocal updates
            for _ in tab.stdout or ():
                updates += counted.is_set()

        threading.Thread(target=count, daemon=True).start()
        time.sleep(WARM_UP)
        counted.set()
        begin, cpu, others = time.monotonic(), time.process_time(), broadcaster.spent
        time.sleep(seconds)
        cpu = time.process_time() - cpu - (broadcaster.spent - others)
        wall, received = time.monotonic() - begin, updates
        tab.kill()
        tab.wait()
    floor = lookups(buffer, received)
    print(f"{100 * (cpu - floor) / wall:.2f} {100 * floor / wall:.2f} {received / wall:.1f}")


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
