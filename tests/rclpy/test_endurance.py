# SPDX-License-Identifier: Apache-2.0
"""Many entities, nodes and processes: nothing hangs, grows or stays behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.usefixtures("domain_id")

# The DDS threads call into a publisher, whose last references and events are dropped in the meantime by other threads.
# A DDS thread that needed the interpreter lock, or a thread that waited for DDS with it, would stop the program
# forever.
_CHURN = """
import faulthandler, threading, time
import rclpy
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from std_msgs.msg import String
faulthandler.dump_traceback_later(30, exit=True)
rclpy.init()
node = rclpy.create_node("churn")
callbacks = PublisherEventCallbacks(matched=lambda _: None, deadline=lambda _: None)
publisher = node.create_publisher(String, "chatter", 10, event_callbacks=callbacks)
end = time.monotonic() + 2
count = [0, 0, 0]

def subscribe():
    while time.monotonic() < end:
        events = SubscriptionEventCallbacks(matched=lambda _: None)
        subscription = node.create_subscription(String, "chatter", lambda _: None, 10, event_callbacks=events)
        node.destroy_subscription(subscription)
        count[0] += 1

def publish():
    while time.monotonic() < end:
        publisher.publish(String(data="x" * 1000))
        count[1] += 1

def ask():
    while time.monotonic() < end:
        publisher.get_subscription_count()
        node.get_subscriptions_info_by_topic("chatter")
        count[2] += 1

threads = [threading.Thread(target=work) for work in (subscribe, subscribe, publish, ask)]
for thread in threads:
    thread.start()
while any(thread.is_alive() for thread in threads):
    rclpy.spin_once(node, timeout_sec=0.01)
node.destroy_node()
rclpy.shutdown()
print(*count)
"""

_CYCLES = """
import gc, os, resource, threading
import rclpy, tf2_ros
from std_msgs.msg import String

def memory():
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()

rclpy.init()
keeper = rclpy.create_node("keeper")
executor = rclpy.executors.SingleThreadedExecutor()
for cycle in range(1000):
    node = rclpy.create_node(f"node{cycle}")
    executor.add_node(node)
    node.create_subscription(String, "chatter", lambda _: None, 10)
    node.create_publisher(String, "chatter", 10).publish(String(data="hello"))
    node.create_timer(0.1, print)
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node)
    executor.spin_once(timeout_sec=0)
    node.destroy_node()
    if cycle == 300:
        before, threads, files = memory(), threading.active_count(), len(os.listdir("/proc/self/fd"))
print((memory() - before) / 2**20, threading.active_count() - threads, len(os.listdir("/proc/self/fd")) - files)
rclpy.shutdown()
"""

_ONE_OF_MANY = """
import sys, time
start = time.monotonic()
import rclpy, tf2_ros
rclpy.init()
node = rclpy.create_node(f"node{sys.argv[1]}")
listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node)
print("up", flush=True)
while len({name for name in node.get_node_names() if name.startswith("node")}) < int(sys.argv[2]):
    rclpy.spin_once(node, timeout_sec=0.05)
print("all", time.monotonic(), flush=True)
rclpy.spin(node)
"""


def _start(text: str, *args: object) -> subprocess.Popen:
    command = [sys.executable, "-c", text, *map(str, args)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_entities_come_and_go_while_dds_threads_use_them() -> None:
    program = _start(_CHURN)
    output, errors = program.communicate(timeout=60)
    assert program.returncode == 0, errors
    assert all(int(count) > 10 for count in output.split()), output


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="memory and files are read from /proc")
def test_a_thousand_nodes_leave_nothing_behind() -> None:
    program = _start(_CYCLES)
    output, errors = program.communicate(timeout=300)
    assert program.returncode == 0, errors
    megabytes, threads, files = map(float, output.split())
    assert megabytes < 8
    assert (threads, files) == (0, 0)


@pytest.mark.slow
def test_twenty_processes_find_each_other_and_leave() -> None:
    count, load = 20, os.getloadavg()[0]
    programs = [_start(_ONE_OF_MANY, number, count) for number in range(count)]
    try:
        for program in programs:
            assert program.stdout.readline() == "up\n"
        last_up = time.monotonic()
        found = [float(program.stdout.readline().split()[1]) for program in programs]
        assert max(found) - last_up < 3
        for program in programs:
            program.send_signal(signal.SIGINT)
        asked = time.monotonic()
        for program in programs:
            program.wait(10)
        # The end of a process takes about 0.1 s of processor time.
        is_idle = load + count * 0.1 < (os.cpu_count() or 1)
        assert time.monotonic() - asked < (1 if is_idle else 8)
    finally:
        for program in programs:
            program.kill()
            program.communicate()
