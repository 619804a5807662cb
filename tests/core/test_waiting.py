# SPDX-License-Identifier: Apache-2.0
"""Many threads wait for transforms: each is woken at once by the insertion into its edge and does not slow down others.

What a thread waits for after it is woken is the interpreter: next to a busy Python thread every hand-over of the GIL
takes up to sys.getswitchinterval() (5 ms), and threads that are woken together queue for it. That part is measured by
threads that are woken by nothing but _core.Event, in turn with the others.
"""

import collections
import statistics
import sys
import threading
import time
from pathlib import Path

import pytest

import coframe
from coframe import _core

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="only Linux reports which threads sleep")

SECOND = 1_000_000_000
EDGES = 100
WAITERS = 10  # threads an edge
IDENTITY = (0.0, 0.0, 0.0, 1.0)
LATE = 5_000_000  # ns


def insert(buffer, child, stamp, x=0.0):
    assert buffer._set_values("map", child, stamp, x, 0.0, 0.0, *IDENTITY, False, "test") == 0


def all_asleep(threads):
    """Return whether none of the threads is running or ready to run; no other thread may be busy in the meantime."""
    tasks = Path("/proc/self/task")
    return all(
        (tasks / str(thread.native_id) / "stat").read_text().rpartition(")")[2].split()[0] == "S" for thread in threads
    )


def wait_until(condition):
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


class Crowd:
    """Ten threads for each of a hundred edges of a buffer, blocked in a lookup of a future transform.

    Half of the edges have older samples; the others are not in the buffer.
    """

    def __init__(self, buffer):
        self.buffer = buffer
        self.returned = [[] for _ in range(EDGES)]  # of each edge: (when, x) of its waiters
        self.errors = []
        insert(buffer, "anchor", SECOND)
        for edge in range(0, EDGES, 2):
            insert(buffer, f"edge{edge}", SECOND)
        self.gone = threading.Semaphore(0)
        self.threads = [
            threading.Thread(target=self.wait, args=(edge,)) for edge in range(EDGES) for _ in range(WAITERS)
        ]
        for thread in self.threads:
            thread.start()
        wait_until(lambda: all_asleep(self.threads))

    def wait(self, edge):
        try:
            transform = self.buffer.lookup("map", f"edge{edge}", 2 * SECOND, timeout="100s")
            self.returned[edge].append((time.perf_counter_ns(), transform.values[0]))
        except Exception as error:  # noqa: BLE001 - for the test's own thread
            self.errors.append(error)
        self.gone.release()

    def release(self, edge):
        """Return the delays of the edge's waiters in nanoseconds, measured from just before the insertion."""
        start = time.perf_counter_ns()
        insert(self.buffer, f"edge{edge}", 2 * SECOND, x=float(edge))
        for _ in range(WAITERS):
            assert self.gone.acquire(timeout=60), f"a waiter of edge {edge} is lost; others: {self.errors}"
        return [when - start for when, _ in self.returned[edge]]

    def join(self):
        for thread in self.threads:
            thread.join(60)
            assert not thread.is_alive()


class Control:
    """As many threads as wait on an edge, each woken by an event, repeatedly."""

    def __init__(self):
        self.events = [_core.Event() for _ in range(WAITERS)]
        self.returned = collections.deque()
        self.back = threading.Semaphore(0)
        self.over = False
        self.threads = [threading.Thread(target=self.wait, args=(event,)) for event in self.events]
        for thread in self.threads:
            thread.start()

    def wait(self, event):
        while event.wait(100 * SECOND) and not self.over:
            self.returned.append(time.perf_counter_ns())
            self.back.release()

    def release(self):
        """Return the delays in nanoseconds."""
        start = time.perf_counter_ns()
        for event in self.events:
            event.set()
        for _ in range(WAITERS):
            assert self.back.acquire(timeout=60)
        late = [when - start for when in self.returned]
        self.returned.clear()
        return late

    def join(self):
        self.over = True
        for event in self.events:
            event.set()
        for thread in self.threads:
            thread.join(60)


@pytest.fixture
def busy():
    """A thread that computes in pure Python and never releases the interpreter by itself."""
    stop = []

    def compute():
        number = 0
        while not stop:
            number += 1

    thread = threading.Thread(target=compute)
    yield thread.start
    stop.append(True)
    thread.join()


def milliseconds(late):
    late = sorted(late)
    return [round(late[round(share * (len(late) - 1))] / 1e6, 2) for share in (0.5, 0.9, 0.99, 1.0)]


def measure(start_busy):
    """Return the delays of a thousand waiters, and those of threads that only wait for the interpreter."""
    crowd, control = Crowd(coframe.Buffer()), Control()
    wait_until(lambda: all_asleep(control.threads))
    start_busy()
    late, only_woken = [], []
    for edge in range(EDGES):
        only_woken += control.release()
        late += crowd.release(edge)
    control.join()
    crowd.join()
    assert crowd.errors == []
    assert [[x for _, x in returned] for returned in crowd.returned] == [[edge] * WAITERS for edge in range(EDGES)]
    print(f"late by, in ms (median, 90 %, 99 %, all): {milliseconds(late)}; events: {milliseconds(only_woken)}")
    return late, only_woken


def test_a_thousand_waiters_return_once_each_and_none_late(busy):
    late, only_woken = measure(busy)
    assert len(late) == EDGES * WAITERS
    # Of the last ones the operating system decides, on a machine that others use as well.
    assert sorted(late)[-len(late) // 10] < max(only_woken) + LATE


def test_waiters_on_other_edges_do_not_slow_down_insertions():
    quiet, crowded = coframe.Buffer(), coframe.Buffer()
    insert(quiet, "anchor", SECOND)
    crowd = Crowd(crowded)
    costs = {quiet: [], crowded: []}
    for sample in range(200):
        for buffer, found in costs.items():
            start = time.thread_time_ns()
            for i in range(500):
                insert(buffer, "robot", SECOND + 1000 * sample + i)
            found.append(time.thread_time_ns() - start)
    for edge in range(EDGES):
        crowd.release(edge)
    crowd.join()
    ratio = statistics.median(costs[crowded]) / statistics.median(costs[quiet])
    print(f"an insertion next to 1000 waiters costs {ratio:.3f} times what it does alone")
    assert ratio < 1.2
