# SPDX-License-Identifier: Apache-2.0
"""Forks next to threads that change the buffer without the interpreter lock: children must find every lock free."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork()")

# Each child does everything that a buffer can do. SIGALRM ends a child that hangs, with a negative exit code.
PROGRAM = """
    import asyncio, contextlib, itertools, os, signal, sys, tempfile, threading, time
    from pathlib import Path

    import numpy as np

    import coframe
    from coframe import _core

    CHILDREN, CHILD_SECONDS = int(sys.argv[1]), 30
    folder = Path(tempfile.mkdtemp(dir=sys.argv[2]))
    buffer = coframe.Buffer()
    static = coframe.Buffer()
    for number in range(100):
        static.set(f"frame{number}", f"frame{number + 1}", coframe.Transform([1, 0, 0]), 1)
    message = static.encode(static=False)
    store = _core.TransformStore(buffer, False, "robot")
    relay = _core.Relay(static=False, period=0)
    relay.add_source(_core.Renaming("robot/", []), split=False)
    stamps = np.arange(1, 20_002) * 500_000  # as long as the cache, and so many that the interpreter lock is released
    poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (len(stamps), 1))
    running, stopping = threading.Event(), False

    def repeat(act):
        while not stopping:
            running.wait()
            with contextlib.suppress(coframe.TransformException):
                act()

    # All of these release the interpreter lock, so that forks happen in the middle of them.
    def receive():
        store.add(next(numbers) % 3, message)
    def name_writers():
        store.name_writer(next(numbers) % 3, f"robot{next(numbers) % 5}")
        store.writers()
    def insert():
        buffer.set_many("odom", "base", stamps + next(numbers) * stamps[-1], poses)
    def create():
        other = coframe.Buffer()
        other.set_many("odom", "base", stamps, poses)
        other.snapshot()
    def look_up():
        newest = buffer.latest_common_time("odom", "base")
        buffer.lookup_many("odom", "base", newest - stamps, on_error="nan", threads=2)
    def wait():
        buffer.lookup("frame0", f"frame{next(numbers) % 200}", next(numbers), timeout="3ms")

    def use_the_buffer(number):
        fresh = f"child{number}"
        assert buffer.set("frame0", fresh, coframe.Transform([1, 2, 3]), 1) or True
        with contextlib.suppress(coframe.TransformException):
            buffer.lookup("frame0", "frame99", timeout="20ms")
        with contextlib.suppress(coframe.TransformException):
            buffer.lookup("frame0", "nowhere", timeout="1ms")
        with contextlib.suppress(coframe.TransformException):
            buffer.wait("frame0", "nowhere", timeout="1ms")
        buffer.can_transform("odom", "base", timeout="1ms")
        insert()
        look_up()
        buffer.ingest(message)
        store.add(1, message)
        store.writers()
        relay.add(0, 1, message)
        relay.take()
        assert buffer.statistics["stored"] > 0 and buffer.edges() and buffer.all_frames_as_yaml()
        snapshot = buffer.snapshot()
        if number % 20 == 0:
            snapshot.save(folder / "saved.cfz")
            assert len(coframe.load(folder / "saved.cfz").frame_names()) == len(snapshot.frame_names())
        changed = threading.Event()
        with buffer.on_change(lambda edge: changed.set(), child=fresh + "b"):
            buffer.set("frame0", fresh + "b", coframe.Transform(), 1)
            assert changed.wait(CHILD_SECONDS)
        threading.Timer(0.001, lambda: buffer.set("frame0", fresh + "c", coframe.Transform(), 1)).start()
        asyncio.run(buffer.wait_async("frame0", fresh + "c", timeout="20s"))

    numbers = itertools.count(1)
    receive()
    sys.setswitchinterval(1e-4)
    busy = [receive, receive, name_writers, insert, create, look_up, wait]
    threads = [threading.Thread(target=repeat, args=[act], daemon=True) for act in busy]
    for thread in threads:
        thread.start()
    bad = []
    for number in range(CHILDREN):
        running.set()
        time.sleep(0.002)
        child = os.fork()
        if child == 0:
            signal.alarm(CHILD_SECONDS)
            stopping = True
            code = 1
            try:
                use_the_buffer(number)
                code = 0
            except BaseException:
                import traceback
                traceback.print_exc()
            finally:
                os._exit(code)
        running.clear()  # the child has the processor
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if code != 0:
            bad.append(code)
    stopping = True
    running.set()
    for thread in threads:
        thread.join(30)
    print(len(bad), "children failed or hung:", bad[:5])
"""


def fork(children: int, folder: Path, timeout: float) -> tuple[int, str]:
    """Fork a busy process that often and return its exit code and what it reports."""
    command = [sys.executable, "-W", "ignore:This process:DeprecationWarning", "-c", textwrap.dedent(PROGRAM)]
    command += [str(children), str(folder)]
    ended = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=timeout, check=False
    )
    return ended.returncode, ended.stdout


@pytest.mark.timeout(300)
def test_children_use_the_buffer_of_a_busy_process(tmp_path):
    assert fork(60, tmp_path, 280) == (0, "0 children failed or hung: []\n")


@pytest.mark.slow
@pytest.mark.timeout(3600)
def test_ten_thousand_children_use_the_buffer_of_a_busy_process(tmp_path):
    assert fork(10_000, tmp_path, 3500) == (0, "0 children failed or hung: []\n")


# glibc's _Fork() calls no handlers, so in the child, the work of other threads stays half done.
UNGUARDED = """
    import ctypes, os, signal, sys, threading, time

    import numpy as np

    import coframe

    libc = ctypes.PyDLL(None)
    if not hasattr(libc, "_Fork"):
        print("no _Fork")
        sys.exit()
    buffer = coframe.Buffer(None)
    stamps = np.arange(1, 300_001) * 1_000_000
    buffer.set_many("odom", "base", stamps, np.tile([0.0, 0, 0, 0, 0, 0, 1], (len(stamps), 1)))
    older = np.arange(1, 20_002), np.tile([0.0, 0, 0, 0, 0, 0, 1], (20_001, 1))  # each moves all of the above
    threading.Thread(target=lambda: buffer.set_many("odom", "base", *older), daemon=True).start()
    for attempt in range(200):
        time.sleep(0.005)
        child = libc._Fork()
        if child == 0:
            signal.alarm(20)
            code, start = 1, time.monotonic()
            try:
                buffer.lookup("odom", "base", int(stamps[9]), timeout="100ms")
            except coframe.TimeoutException as error:
                if "in the middle of a change" in str(error) and time.monotonic() - start < 5:
                    code = 42
            finally:
                os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if code == 42:
            print("timed out")
            os._exit(0)
    print("no child timed out; the last one ended with", code)
    os._exit(1)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="_Fork() is a function of glibc")
def test_a_lookup_times_out_if_a_change_never_ends():
    command = [sys.executable, "-c", textwrap.dedent(UNGUARDED)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=100, check=False)
    if ended.stdout == "no _Fork\n":
        pytest.skip("this C library has no _Fork()")
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "timed out\n", "")


def test_a_forked_process_logs_once_that_callbacks_of_its_parent_are_not_called():
    program = """
        import os, sys, threading
        import coframe
        buffers = [coframe.Buffer(), coframe.Buffer()]
        called = threading.Event()
        handles = [buffer.on_change(lambda edge: called.set()) for buffer in buffers for _ in range(2)]
        closed = coframe.Buffer().on_change(print)
        closed.close()
        child = os.fork()
        if child == 0:
            mine = threading.Event()
            with buffers[0].on_change(lambda edge: mine.set()):
                handles[0].close()  # the parent's: it must not close the new one
                buffers[0].set("odom", "base", coframe.Transform(), 1)
                os._exit(0 if mine.wait(20) and not called.is_set() else 1)
        sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    """
    command = [sys.executable, "-W", "ignore:This process:DeprecationWarning", "-c", textwrap.dedent(program)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 0
    (line,) = ended.stderr.splitlines()
    assert "that were registered before a fork are not called in the forked process" in line


def test_a_forked_process_without_callbacks_logs_nothing():
    program = """
        import os, coframe
        buffer = coframe.Buffer()
        buffer.on_change(print).close()
        if os.fork() == 0:
            os._exit(0)
        os.wait()
    """
    command = [sys.executable, "-c", textwrap.dedent(program)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
