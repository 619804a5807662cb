# SPDX-License-Identifier: Apache-2.0
"""The nodes of the lab, in this process or in their own processes."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import pytest

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage


class Observer:
    """A node that stores received messages, and the executor of all nodes of this process."""

    def __init__(self) -> None:
        self.node = rclpy.create_node("observer")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.nodes = [self.node]

    def add(self, node: Node) -> Node:
        self.nodes.append(node)
        self.executor.add_node(node)
        return node

    def hear(self, message_type: type, topic: str, *, latched: bool = False) -> list:
        """Return a list that receives the messages of a topic."""
        received: list = []
        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        self.node.create_subscription(
            message_type, topic, received.append, QoSProfile(depth=1000, durability=durability)
        )
        return received

    def hear_tf(self) -> tuple[list, list]:
        """Return the lists of messages on /tf and on /tf_static."""
        return self.hear(TFMessage, "/tf"), self.hear(TFMessage, "/tf_static", latched=True)

    def until(self, condition: Callable[[], object], seconds: float = 30.0) -> None:
        """Spin until a condition is true."""
        deadline = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < deadline, "timed out waiting for a condition"
            self.executor.spin_once(timeout_sec=0.02)

    def spin_for(self, seconds: float) -> None:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.executor.spin_once(timeout_sec=0.02)

    def close(self) -> None:
        self.executor.shutdown()
        for node in self.nodes:
            node.destroy_node()


@pytest.fixture
def start(domain_id: int) -> Iterator[Callable[..., Observer]]:
    """Initialize rclpy with `-p name:=value` parameters and return an observer."""
    assert domain_id
    observers: list[Observer] = []

    def start_(*parameters: str) -> Observer:
        arguments = [word for parameter in parameters for word in ("-p", parameter)]
        rclpy.init(args=["--ros-args", *arguments] if arguments else [])
        observers.append(Observer())
        return observers[-1]

    yield start_
    for observer in observers:
        observer.close()
    rclpy.try_shutdown()


@pytest.fixture
def run(domain_id: int) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Start a node of the lab in its own process, which must stop cleanly when it is interrupted."""
    assert domain_id
    processes: list[subprocess.Popen[str]] = []

    def run_(name: str, *parameters: str) -> subprocess.Popen[str]:
        command = [sys.executable, "-m", f"coframe.lab.{name}"]
        if parameters:
            command += ["--ros-args", *(word for parameter in parameters for word in ("-p", parameter))]
        processes.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True))
        return processes[-1]

    yield run_
    outputs = []
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
    for process in processes:
        try:
            outputs.append(process.communicate(timeout=20)[0])
        except subprocess.TimeoutExpired:
            process.kill()
            outputs.append(f"did not end\n{process.communicate()[0]}")
    broken = [out for process, out in zip(processes, outputs, strict=True) if process.returncode or "Traceback" in out]
    assert not broken, "\n".join(broken)
