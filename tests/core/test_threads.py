# SPDX-License-Identifier: Apache-2.0
"""Waiting threads: timeouts, finalizers, forks, callbacks, and the exit of the interpreter."""

import os
import subprocess
import sys
import textwrap
import threading
import time

import pytest

import coframe
from coframe import _core

SECOND = 1_000_000_000


def run(code, timeout=60):
    """Run a program and return its exit code and its stderr."""
    # Python 3.12 and newer warn when a process with threads calls fork().
    command = [sys.executable, "-W", "ignore:This process:DeprecationWarning", "-c"]
    command.append("import coframe\n" + textwrap.dedent(code))
    ended = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    return ended.returncode, ended.stderr


@pytest.mark.parametrize("timeout", ["40ms", "80ms"])
def test_a_wait_lasts_its_timeout_next_to_a_busy_publisher(timeout):
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
def test_a_program_exits_cleanly_while_threads_wait(wait):
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


def test_a_finalizer_can_use_the_buffer_whose_failure_is_read():
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


@pytest.mark.timeout(600)
def test_the_memory_for_cached_paths_is_bounded():
    """The processor time is limited, not the time: other programs may keep the machine busy."""
    code = """
        import resource
        resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
        buffer = coframe.Buffer()
        names = [f"frame{i}" for i in range(301)]
        for parent, child in zip(names, names[1:]):
            buffer.set(parent, child, coframe.Transform(), static=True)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        assert all(buffer.can_transform(target, source) for target in names for source in names)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        assert grown < 20_000, f"{grown} KiB"
    """
    assert run(code, timeout=500) == (0, "")


def test_the_memory_for_waits_on_unknown_frames_is_bounded():
    code = """
        import resource
        from coframe import _core
        buffer = coframe.Buffer()
        mailbox = _core.Mailbox()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for number in range(100_000):
            _core.wait(buffer, mailbox, number, "map", f"tag_{number}", None).cancel()
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        assert grown < 5_000, f"{grown} KiB"
    """
    assert run(code) == (0, "")


@pytest.mark.parametrize("act", ["tell()", "wait()()", "buffer.on_change(print).close()"])
def test_finalizers_can_use_a_buffer_with_waits(act):
    code = f"""
        import gc
        from coframe import _core
        buffer = coframe.Buffer()
        def tell():
            with buffer._dispatcher.inserting():
                buffer.set("odom", "base", coframe.Transform(), 1)
        def wait():
            start = lambda mailbox, token: _core.wait(buffer, mailbox, token, "map", "base", None)
            return buffer._dispatcher.wait(start, lambda found: None, 100_000_000_000)
        class Acts:
            def __init__(self):
                self.itself = self
            def __del__(self):
                {act}
        kept = [wait(), buffer.on_change(lambda edge: None)]
        for allocations in range(1, 50):  # until the garbage is collected
            for use in (tell, wait):
                gc.disable()
                Acts()
                gc.set_threshold(gc.get_count()[0] + allocations)
                gc.enable()
                use()
                gc.set_threshold(700)
        Acts()  # for the exit
    """
    assert run(code) == (0, "")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork()")
def test_a_forked_process_can_wait_in_the_buffer():
    code = """
        import asyncio, os, sys, threading
        sys.setswitchinterval(1e-6)
        buffer = coframe.Buffer()
        kept = buffer.on_change(lambda edge: None)
        child = os.fork()
        if child == 0:
            threading.Timer(0.05, lambda: buffer.set("odom", "base", coframe.Transform(), 1)).start()
            asyncio.run(buffer.wait_async("odom", "base", timeout="5s"))
            os._exit(0)
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    """
    assert [run(code)[0] for _ in range(5)] == [0] * 5


def reported(buffer, count):
    """Return the stamps that a callback reports, up to `count`; each is inserted after the report of the one before."""
    stamps, arrived = [], threading.Condition()

    def tell(edge):
        with arrived:
            stamps.append(edge.newest)
            arrived.notify()
        if edge.newest == 1:
            sys.exit("enough")

    with buffer.on_change(tell), arrived:
        for stamp in range(1, count + 1):
            buffer.set("odom", "base", coframe.Transform(), stamp)
            arrived.wait_for(lambda stamp=stamp: stamp in stamps, timeout=5)
    return stamps


def test_sys_exit_in_a_callback_does_not_end_the_callback_thread(caplog):
    assert reported(coframe.Buffer(), 3) == [1, 2, 3]
    assert "would end the callback thread" in caplog.text


def test_an_interrupted_callback_does_not_delay_other_waits():
    buffer = coframe.Buffer()
    ended = threading.Semaphore(0)

    def interrupt(_):
        ended.release()
        raise KeyboardInterrupt

    start = lambda mailbox, token: _core.wait(buffer, mailbox, token, "odom", "base", None)  # noqa: E731
    for on_end in (interrupt, interrupt, lambda _: ended.release()):
        buffer._dispatcher.wait(start, on_end)
    with pytest.raises(KeyboardInterrupt), buffer._dispatcher.inserting():
        buffer.set("odom", "base", coframe.Transform(), 1)
    assert all(ended.acquire(timeout=5) for _ in range(3))


def test_callbacks_of_changes_run_in_their_own_thread():
    buffer = coframe.Buffer()
    threads = []
    called = threading.Event()
    with buffer.on_change(lambda _: (threads.append(threading.get_ident()), called.set())):
        with buffer._dispatcher.inserting():
            buffer.set("odom", "base", coframe.Transform(), 1)
        assert called.wait(5)
    assert threading.get_ident() not in threads


def test_deadlines_of_finished_waits_are_removed():
    buffer = coframe.Buffer()
    start = lambda mailbox, token: _core.wait(buffer, mailbox, token, "odom", "base", None)  # noqa: E731
    kept = buffer.on_change(print)
    for _ in range(2000):
        buffer._dispatcher.wait(start, print, 10**15)()
    kept.close()
    assert len(buffer._dispatcher._deadlines) < 500
