"""Threads that wait, and what happens to them at the end."""

import subprocess
import sys
import textwrap
import threading
import time

import pytest

import coframe

SECOND = 1_000_000_000


def run(code):
    """Runs a program: its exit code and what it wrote to stderr."""
    command = [sys.executable, "-c", "import coframe\n" + textwrap.dedent(code)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    return ended.returncode, ended.stderr


@pytest.mark.parametrize("timeout", ["40ms", "80ms"])
def test_a_wait_lasts_its_time_beside_a_busy_publisher(timeout):
    buffer = coframe.Buffer()
    stop = threading.Event()

    def feed():
        stamp = SECOND
        while not stop.is_set():
            buffer.set("map", "other", coframe.Transform(), stamp := stamp + 1)

    feeder = threading.Thread(target=feed)
    feeder.start()
    start = time.monotonic()
    assert not buffer.can_transform("odom", "base", timeout=timeout)
    elapsed = time.monotonic() - start
    stop.set()
    feeder.join()
    assert elapsed >= float(timeout[:2]) / 1000


@pytest.mark.parametrize(
    "wait",
    [
        "buffer.can_transform('odom', 'base', timeout='10s')",
        "buffer.can_transform('odom', 'base', timeout=2_000_000)",
        "_core.Mailbox().wait(1_000_000)",
        "buffer.wait('odom', 'base')",
        "_core.Event().wait(500_000)",
    ],
)
def test_a_program_ends_well_although_threads_wait(wait):
    code = f"""
        import threading
        from coframe import _core
        buffer = coframe.Buffer()
        started = threading.Semaphore(0)
        def wait():
            started.release()
            while True:
                {wait}
        for _ in range(20):
            threading.Thread(target=wait, daemon=True).start()
            started.acquire()
    """
    assert [run(code) for _ in range(3)] == [(0, "")] * 3


def test_a_finalizer_may_ask_the_buffer_whose_failure_is_read():
    code = """
        import gc
        buffer = coframe.Buffer()
        buffer.set("odom", "base", coframe.Transform(), 5)
        class Asks:
            def __init__(self):
                self.itself = self
            def __del__(self):
                buffer.can_transform("odom", "base")
        try:
            buffer.lookup("odom", "base", 7)
        except coframe.ExtrapolationException as error:
            kept = []
            gc.set_threshold(1)
            for _ in range(5000):
                Asks()
                kept.append(error.edge)
    """
    assert run(code) == (0, "")


def test_the_paths_between_all_pairs_of_frames_take_no_memory_for_ever():
    code = """
        import resource
        buffer = coframe.Buffer()
        names = [f"frame{i}" for i in range(301)]
        for parent, child in zip(names, names[1:]):
            buffer.set(parent, child, coframe.Transform(), static=True)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        assert all(buffer.can_transform(target, source) for target in names for source in names)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        assert grown < 20_000, f"{grown} KiB"
    """
    assert run(code) == (0, "")


def test_waits_for_frames_that_never_come_take_no_memory_for_ever():
    code = """
        import resource
        buffer = coframe.Buffer()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for number in range(100_000):
            assert not buffer.can_transform("map", f"tag_{number}", timeout=1)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        assert grown < 5_000, f"{grown} KiB"
    """
    assert run(code) == (0, "")
