# SPDX-License-Identifier: Apache-2.0
import asyncio
import contextlib
import logging
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import coframe
from coframe import _core
from coframe.connection import shared_transforms
from coframe.connection.shared_transforms import SharedTransforms
from coframe.messages import find
from coframe.messages.codec import serialize

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")

MESSAGE, STAMPED = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
READER = """
import sys, time
import coframe
with coframe.connect("reader", domain=int(sys.argv[1]), shared=True) as ros:
    print(ros.buffer.wait("map", "base", timeout="30s").x, flush=True)
    for line in sys.stdin:
        print(eval(line), flush=True)
"""


def transform(parent, child, stamp, x=1.0):
    stamped = STAMPED(child_frame_id=child)
    stamped.header.frame_id = parent
    stamped.header.stamp.sec, stamped.header.stamp.nanosec = divmod(stamp, 10**9)
    stamped.transform.translation.x = x
    return stamped


@contextlib.contextmanager
def broadcasting(domain, period=0.01):
    """Publish map <- base with x = 3 all the time."""
    stopped = threading.Event()
    with coframe.connect("broadcaster", domain=domain) as ros:
        publisher = ros.publisher("/tf", MESSAGE)

        def publish():
            while not stopped.wait(period):
                publisher.publish(MESSAGE(transforms=[transform("map", "base", time.time_ns(), 3.0)]))

        thread = threading.Thread(target=publish)
        thread.start()
        try:
            yield ros
        finally:
            stopped.set()
            thread.join()


class Reader:
    def __init__(self, domain):
        self.process = subprocess.Popen(
            [sys.executable, "-c", READER, str(domain)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self.process.stdout.readline() == "3.0\n"

    def __call__(self, expression):
        self.process.stdin.write(expression + "\n")
        self.process.stdin.flush()
        return eval(self.process.stdout.readline())

    def end(self):
        self.process.communicate(timeout=30)
        assert self.process.returncode == 0


@pytest.fixture
def start_reader(domain_id):
    """Starts processes that share transforms, and ends them after the test."""
    readers = []

    def start():
        readers.append(Reader(domain_id))
        return readers[-1]

    yield start
    for reader in readers:
        if reader.process.poll() is None:
            reader.end()


@pytest.fixture
def receiver(domain_id):
    with broadcasting(domain_id), coframe.connect("one", domain=domain_id, shared=True) as ros:
        ros.buffer.wait("map", "base", timeout="30s")
        yield ros


def test_another_process_reads_without_a_subscription(receiver, domain_id):
    reader = Reader(domain_id)
    assert reader("ros.shared and not ros._receiver.transforms.is_writer")
    assert reader("ros._participant is None")
    assert reader("ros.buffer.frame_names()") == ["base", "map"]
    assert reader("'base' in str(ros.buffer.why('map', 'base'))")
    first = reader("ros.buffer.lookup('map', 'base').stamp")
    stamp = reader(f"ros.buffer.wait('map', 'base', {first + 200_000_000}, timeout='30s').stamp")
    assert stamp == first + 200_000_000
    assert reader("ros.buffer.lookup_many('map', 'base', [0, 0]).translation[:, 0].tolist()") == [3.0, 3.0]
    assert reader("ros.buffer.snapshot().lookup('map', 'base').x") == 3.0
    assert reader("'base_lnk' not in ros.buffer and ros.buffer.edges()[0].samples > 0")
    reader.end()
    assert receiver.shared


def test_another_process_takes_over_when_the_writer_is_killed(domain_id, eventually):
    with broadcasting(domain_id) as ros:
        writer, reader = Reader(domain_id), Reader(domain_id)
        assert writer("ros._receiver.transforms.is_writer")
        stored = reader("ros.buffer.lookup('map', 'base').stamp")
        os.kill(writer.process.pid, signal.SIGKILL)
        writer.process.communicate()
        assert reader(f"ros.buffer.lookup('map', 'base', {stored}).x") == 3.0
        assert reader("ros.buffer.wait('map', 'base', time.time_ns() + 100_000_000, timeout='30s').x") == 3.0
        eventually(lambda: reader("ros._receiver.transforms.is_writer"))
        assert reader("ros._receiver.transforms.writer_process") == reader.process.pid
        reader.end()
        assert ros is not None


def test_a_wait_in_asyncio_and_a_watch_see_the_changes_of_another_process(receiver):
    changed = threading.Event()
    with receiver.buffer.on_change(lambda _: changed.set(), child="base"):
        assert changed.wait(30)

    async def wait():
        newest = receiver.buffer.lookup("map", "base").stamp
        return await receiver.buffer.wait_async("map", "base", newest + 50_000_000, timeout="30s")

    with ThreadPoolExecutor(1) as own_thread:  # that of the test can have an event loop of a browser
        assert own_thread.submit(lambda: asyncio.run(wait())).result().x == 3.0


def test_a_local_change_makes_the_buffer_one_of_its_own(receiver):
    buffer = receiver.buffer
    stored = buffer.lookup("map", "base").stamp
    assert buffer.set("base", "lidar", coframe.Transform([1, 0, 0]), static=True)
    assert not receiver.shared
    assert buffer.lookup("map", "lidar", stored).x == 4.0
    assert buffer.wait("map", "lidar", stored + 300_000_000, timeout="30s").x == 4.0


@pytest.mark.parametrize(
    "change",
    [
        lambda buffer: buffer.set_many("map", "own", np.array([10**9]), np.array([[1.0, 0, 0, 0, 0, 0, 1]])),
        lambda buffer: buffer.ingest(coframe.Buffer().encode(static=False)),
        lambda buffer: buffer.clear(),
        lambda buffer: buffer.remove_frame("base"),
        lambda buffer: buffer.freeze(),
    ],
)
def test_every_kind_of_local_change_is_possible(receiver, change):
    change(receiver.buffer)
    assert not receiver.shared


def test_a_closed_connection_keeps_its_transforms(receiver):
    receiver.close()
    stamp = receiver.buffer.lookup("map", "base").stamp
    assert receiver.buffer.set("map", "own", coframe.Transform([1, 0, 0]), 10**9)
    assert receiver.buffer.lookup("map", "base").stamp == stamp


def test_publishers_and_subscriptions_work_next_to_the_shared_transforms(receiver):
    string = find("std_msgs/msg/String")
    subscription = receiver.subscribe("/chatter", string)
    receiver.publisher("/chatter", string).publish(string(data="hello"))
    assert subscription.receive("10s").data == "hello"
    assert [publisher.node for publisher in receiver.publishers()] == ["/broadcaster"]
    assert not receiver.wait_for_statics("100ms"), "nothing publishes static transforms"


def test_a_hub_receives_for_the_others(domain_id, eventually):
    words = ["hub", "--prefix", "robot1/", "--keep", "map"]
    hub = subprocess.Popen([sys.executable, "-m", "coframe.cli", *words], stderr=subprocess.PIPE, text=True)
    assert f"Receiving /tf and /tf_static in domain {domain_id} for all programs" in hub.stderr.readline()
    options = {"domain": domain_id, "prefix": "robot1/", "keep": "map", "shared": True}
    with broadcasting(domain_id) as publisher, coframe.connect("reader", **options) as ros:
        assert ros.buffer.wait("map", "robot1/base", timeout="30s").x == 3.0
        assert ros._receiver.transforms.writer_process == hub.pid
        assert any("2 frames in" in line for line in iter(hub.stderr.readline, ""))
        statics = publisher.participant.static_broadcaster(publisher.node)
        publish_statics(statics, "lidar", "camera")
        ros.buffer.wait("robot1/base", "robot1/camera", timeout="30s")
        publish_statics(statics, "lidar")
        assert any("Static transforms were withdrawn" in line for line in iter(hub.stderr.readline, ""))
        with coframe.connect("late", **options) as late:
            assert late.buffer.wait("robot1/base", "robot1/lidar", timeout="30s").x == 1.0
            assert "robot1/camera" not in late.buffer
            assert late._receiver.transforms.writer_process == hub.pid
        hub.send_signal(signal.SIGINT)
        hub.communicate(timeout=30)
        assert hub.returncode == 0
        eventually(lambda: ros._receiver.transforms.is_writer)


def publish_statics(broadcaster, *children):
    broadcaster.write(serialize(MESSAGE(transforms=[transform("base", child, 0) for child in children])))


@pytest.fixture
def statics(receiver):
    """A broadcaster of static transforms of another process, as far as the subscriptions can tell."""
    node = receiver.participant.add_node("/", "statics")
    yield receiver.participant.static_broadcaster(node)
    node.close()


def test_a_late_listener_does_not_see_withdrawn_statics(receiver, statics, start_reader):
    publish_statics(statics, "lidar", "camera")
    receiver.buffer.wait("base", "camera", timeout="30s")
    same = start_reader()
    assert same("ros._receiver.transforms.writer_process") == os.getpid()
    publish_statics(statics, "lidar")
    receiver.buffer.wait("map", "base", receiver.buffer.lookup("map", "base").stamp + 1, timeout="30s")
    late, later = start_reader(), start_reader()
    for reader in (late, later):
        assert reader("ros.buffer.wait('base', 'lidar', timeout='30s').x") == 1.0
        assert reader("'camera' in ros.buffer.frame_names()") is False
        assert reader("ros._receiver.transforms.writer_process") == late.process.pid, (
            "late listeners share with each other"
        )
    assert same("'camera' in ros.buffer.frame_names()") is True
    publish_statics(statics, "lidar", "camera")
    receiver.buffer.wait("map", "base", receiver.buffer.lookup("map", "base").stamp + 1, timeout="30s")
    assert start_reader()("ros._receiver.transforms.writer_process") == os.getpid(), (
        "all of the first memory is published again"
    )


def test_statics_of_a_publisher_that_has_ended_are_withdrawn(receiver, eventually):
    node = receiver.participant.add_node("/", "statics")
    publish_statics(receiver.participant.static_broadcaster(node), "lidar")
    assert receiver.buffer.wait("base", "lidar", timeout="30s").x == 1.0
    assert not receiver._receiver.transforms.is_outdated
    node.close()
    eventually(lambda: receiver._receiver.transforms.is_outdated)
    assert receiver.buffer.lookup("base", "lidar").x == 1.0


def test_statics_stay_published_when_another_process_takes_over(domain_id, start_reader, eventually):
    with broadcasting(domain_id) as ros:
        publish_statics(ros.participant.static_broadcaster(ros.node), "lidar")
        writer, reader = start_reader(), start_reader()
        assert reader("ros.buffer.wait('base', 'lidar', timeout='30s').x") == 1.0
        os.kill(writer.process.pid, signal.SIGKILL)
        writer.process.communicate()
        assert reader("ros.buffer.wait('map', 'base', time.time_ns() + 100_000_000, timeout='30s').x") == 3.0
        eventually(lambda: reader("ros._receiver.transforms.is_writer"))
        assert reader("ros._receiver.transforms.is_outdated") is False
        assert reader("ros.wait_for_statics('30s')")
        assert reader("[one.settle_statics() for one in ros._receiver.transforms.readers]") == [None, None]
        assert reader("ros._receiver.transforms.is_outdated") is False


def hub_status(domain, *, code):
    words = [sys.executable, "-m", "coframe.cli", "hub", "--status", "--domain", str(domain)]
    status = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert (status.returncode, status.stderr) == (code, "")
    return status.stdout


def test_status_of_the_receiving_process(domain_id, start_reader, caplog, monkeypatch, eventually):
    topics = f"/tf and /tf_static in domain {domain_id}"
    assert hub_status(domain_id, code=1) == f"No process receives {topics} for others.\n"
    with broadcasting(domain_id):
        receiver = start_reader()
        process = receiver.process.pid
        assert f"Process {process} receives {topics} for all programs that share transforms: 2 frames in" in hub_status(
            domain_id, code=0
        )
        monkeypatch.setattr(shared_transforms, "_VACANCY_TIMEOUT", 10_000_000)
        with coframe.connect("reader", domain=domain_id, shared=True) as ros:
            os.kill(process, signal.SIGSTOP)
            try:
                eventually(lambda: ros._receiver.transforms.writer_is_suspended)
                sentence = f"Process {process}, which receives the shared transforms, is suspended: no new transforms"
                assert sentence in hub_status(domain_id, code=1)
                eventually(lambda: sentence in caplog.text)
                assert ros.buffer.lookup("map", "base").x == 3.0
            finally:
                os.kill(process, signal.SIGCONT)


def memory_of(domain, folder=None):
    files = (folder or Path(f"/dev/shm/coframe-{os.getuid()}")).glob(f"{domain}-*")
    return {file for file in files if file.suffix != ".lock"}


def test_nothing_is_left_when_the_last_one_leaves(domain_id):
    before = memory_of(domain_id)  # of processes in other networks
    with coframe.connect("one", domain=domain_id, shared=True):
        assert memory_of(domain_id) - before
    assert not memory_of(domain_id) - before


ENDING = """
import os, sys
from coframe import _core
segment = _core.Segment.open(sys.argv[1], "232-one", 10**10)
assert segment.try_to_write()
buffer = _core.Buffer(10**10)
segment.write(buffer)
buffer._set_values("map", "base", 10**9, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, False, "me")
os._exit(0)
"""


def test_transforms_of_programs_that_have_ended_are_not_used(tmp_path):
    folder = tmp_path / "shared"
    subprocess.run([sys.executable, "-c", ENDING, folder], check=True)
    assert len(memory_of(232, folder)) == 1
    segment = _core.Segment.open(str(folder), "232-one", 10**10)
    buffer = coframe.Buffer()
    assert segment.follow(buffer)
    assert buffer.frame_names() == []
    segment.close()


def test_memory_of_programs_that_have_ended_is_removed(tmp_path, domain_id, monkeypatch):
    folder = tmp_path / "shared"  # with memory of domain 232, which no test uses
    monkeypatch.setattr(shared_transforms, "_FOLDER", str(folder))
    subprocess.run([sys.executable, "-c", ENDING, folder], check=True)
    used = _core.Segment.open(str(folder), "232-used", 10**10)
    assert len(memory_of(232, folder)) == 2
    with coframe.connect("one", domain=domain_id, shared=True) as ros:
        assert ros._receiver.transforms.is_writer
        assert [file.name.startswith("232-used") for file in memory_of(232, folder)] == [True]
    used.close()


RESTLESS = """
import sys
from coframe import _core
segment = _core.Segment.open(sys.argv[1], "one", 10**13)
assert segment.try_to_write()
buffer = _core.Buffer(10**13)
segment.write(buffer)
store = lambda stamp: buffer._set_values("map", "base", stamp, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, False, "me")
for i in range(20_000):
    store(10**13 + i)
print("ready", flush=True)
for i in range(10**9):
    store(10**13 - i)  # before all others, which are moved
"""


def test_copying_ends_beside_a_writer_that_never_rests(tmp_path):
    folder = str(tmp_path / "shared")
    writer = subprocess.Popen([sys.executable, "-c", RESTLESS, folder], stdout=subprocess.PIPE, text=True)
    try:
        assert writer.stdout.readline() == "ready\n"
        segment = _core.Segment.open(folder, "one", 10**13)
        buffer = coframe.Buffer()
        assert segment.follow(buffer)
        assert buffer.snapshot().frame_names() == ["base", "map"]
        buffer._stop_following()
        assert buffer.set("map", "own", coframe.Transform([1, 0, 0]), 10**9)
        segment.close()
    finally:
        writer.kill()
        writer.communicate()


def test_a_folder_of_others_is_refused(tmp_path):
    folder = tmp_path / "open"
    folder.mkdir(mode=0o755)
    with pytest.raises(_core.SegmentError, match="does not belong to this user alone"):
        _core.Segment.open(str(folder), "one", 10**10)
    (tmp_path / "link").symlink_to(folder)
    with pytest.raises(_core.SegmentError, match="does not belong to this user alone"):
        _core.Segment.open(str(tmp_path / "link"), "one", 10**10)


def test_where_sharing_is_not_possible_the_process_receives_itself(domain_id, monkeypatch, caplog):
    def refuse(*_):
        raise _core.SegmentError("no shared memory here")

    monkeypatch.setattr(_core.Segment, "open", refuse)
    with (
        caplog.at_level(logging.WARNING),
        broadcasting(domain_id),
        coframe.connect("one", domain=domain_id, shared=True) as ros,
    ):
        assert ros.buffer.wait("map", "base", timeout="30s").x == 3.0
        assert not ros.shared
    assert "The transforms are not shared with other processes: no shared memory here" in caplog.text
    assert not SharedTransforms._instances
