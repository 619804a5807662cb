# SPDX-License-Identifier: Apache-2.0
"""Shared transforms in a /dev/shm that is small, as in containers, or truncated by another program.

Each test mounts one of its own.
"""

import os
import shlex
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")

PUBLISH = """
    import logging, textwrap, threading, time
    import coframe
    from coframe.connection import shared_transforms
    from coframe.messages import find
    logging.basicConfig(format="%(message)s")
    logged = []
    logging.getLogger().handlers[0].addFilter(lambda record: logged.append(record) or True)
    shared_transforms._CHECK_PERIOD = shared_transforms.STATICS_TIMEOUT = 0.05
    MESSAGE, STAMPED = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
    publisher = coframe.connect("publisher").publisher("/tf", MESSAGE)

    def publish(names):
        message = MESSAGE()
        for name in names:
            stamped = STAMPED(child_frame_id=name)
            stamped.header.frame_id = "map"
            stamped.header.stamp.sec, stamped.header.stamp.nanosec = divmod(time.time_ns(), 10**9)
            stamped.transform.translation.x, stamped.transform.translation.y = 1.0, 2.0
            message.transforms.append(stamped)
        publisher.publish(message)
"""


def run(size, program):
    """Run a program with a /dev/shm of that many megabytes; return its output and what it logs."""
    mount = f"mount -t tmpfs -o size={size}m,mode=1777 none /dev/shm"
    inside = ["unshare", "--mount", "sh", "-c"]
    probe = subprocess.run([*inside, mount], capture_output=True, text=True, check=False)
    if probe.returncode != 0:
        pytest.skip(f"no file system can be mounted here, which needs root: {probe.stderr.strip()}")
    code = textwrap.dedent(PUBLISH) + textwrap.dedent(program)
    command = [*inside, f"{mount} && exec {shlex.join([sys.executable, '-c', code])}"]
    # Fast DDS itself must not use the room.
    environment = {**os.environ, "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=100, check=False)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout, ended.stderr


@pytest.mark.usefixtures("domain_id")
def test_a_process_receives_alone_if_there_is_no_room():
    output, logged = run(
        1,
        """
        ros = coframe.connect("listener", shared=True)
        for _ in range(1000):
            publish(["base"])
            if ros.buffer.can_transform("map", "base", timeout="50ms"):
                break
        print(ros.buffer.lookup("map", "base").translation.tolist())
        ros.close()
        """,
    )
    assert output == "[1.0, 2.0, 0.0]\n"
    (line,) = logged.splitlines()
    assert line.startswith("The transforms are not shared with other processes: there is no room for shared memory in")
    assert line.endswith("No space left on device")


@pytest.mark.usefixtures("domain_id")
def test_memory_that_becomes_full_is_reported_and_known_frames_are_stored():
    output, logged = run(
        8,
        """
        ros = coframe.connect("listener", shared=True)
        for number in range(400):
            publish([f"base{number}_{i}" for i in range(50)])
            time.sleep(0.002)
            if ros.buffer.statistics["over_limit"]:
                break
        while not ros.buffer.statistics["over_limit"]:
            publish([f"more{number}_{i}" for i in range(50)])
            number += 1
        first = ros.buffer.lookup("map", "base0_0").stamp
        while ros.buffer.lookup("map", "base0_0").stamp == first:
            publish(["base0_0"])
            time.sleep(0.01)
        print(ros.buffer.lookup("map", "base0_0").translation.tolist(), ros.shared)
        while len(logged) < 2:
            time.sleep(0.01)
        ros.close()
        """,
    )
    assert output == "[1.0, 2.0, 0.0] True\n"
    full, rejected = sorted(logged.splitlines(), reverse=True)
    assert full.startswith("The memory of the shared transforms is full: /dev/shm/coframe-")
    assert "No space left on device. New frames are rejected" in full
    assert rejected.startswith("Rejected ")
    assert rejected.endswith("their frames are new, and the buffer cannot store more frames of other nodes.")


@pytest.mark.usefixtures("domain_id")
@pytest.mark.parametrize("size", [0, 5000, 100_000])
def test_transforms_that_another_program_truncates_raise_an_error(size):
    output, logged = run(
        64,
        f"""
        import os, subprocess, sys
        from pathlib import Path
        reader = '''
        import coframe
        ros = coframe.connect("reader", shared=True)
        ros.buffer.wait("map", "base0")
        print("ready", flush=True)
        input()
        try:
            while True:
                ros.buffer.lookup("base1", "base99", timeout="1s")
        except coframe.CoframeError as error:
            print(type(error).__name__, error)
        change = lambda: ros.buffer.set("map", "own", coframe.Transform(), 1)
        for act in (change, ros.buffer.snapshot, ros.buffer.clear):
            try:
                print(act())
            except coframe.CoframeError as error:
                print(type(error).__name__, error)
        ros.close()
        '''
        writer = coframe.connect("writer", shared=True)
        stopping = threading.Event()

        def publish_all():
            while not stopping.wait(0.005):
                publish([f"base{{number}}" for number in range(100)])

        thread = threading.Thread(target=publish_all)
        thread.start()
        writer.buffer.wait("map", "base0")
        assert writer._receiver.transforms.is_writer
        program = [sys.executable, "-c", textwrap.dedent(reader)]
        process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        process.stdout.readline()
        (file,) = (path for path in Path(f"/dev/shm/coframe-{{os.getuid()}}").iterdir() if not path.suffix)
        os.truncate(file, {size})
        print(process.communicate("\\n", timeout=60)[0], end="")
        try:
            while True:
                writer.buffer.lookup("base1", "base99")
                writer.buffer.edges()
        except coframe.CoframeError as error:
            print(type(error).__name__, error)
        while not any("truncated" in record.getMessage() for record in logged):
            time.sleep(0.01)
        writer.close()
        stopping.set()
        thread.join()
        """,
    )
    lines = output.splitlines()
    assert len(lines) == 5
    for line in lines:
        assert line.startswith("WireError The shared transforms in /dev/shm/coframe-")
        assert "are lost, because another program has truncated this file" in line
    assert "Another program has truncated the file of the shared transforms in /dev/shm" in logged
