# SPDX-License-Identifier: Apache-2.0
"""Measures what publishing a message costs the caller, and what receiving it costs the other process.

    python -m benchmarks.publishing publish rclpy tf 2      time of a call: nanoseconds, median
    python -m benchmarks.publishing receive rclpy cloud 2   processor time of the receiver: nanoseconds per message

The messages are `tf`, one transform, sent by `sendTransform`; `joints`, a JointState of 30 joints with velocities and
efforts; and `cloud`, a PointCloud2 of 1 MB. The receiver is another process on another processor, and messages are sent
with pauses, as a robot does. The contenders are:

- `rclpy`: coframe's in coframe's Python, and that of a sourced ROS 2 in its own.
- `bytes`: coframe's publisher of serialized bytes, which passes them to Cyclone DDS.
- `cyclonedds`: the package of that name, with its own classes.
- `socket`: bare UDP sockets that send and receive the serialized bytes, in datagrams of up to 64 kB.
- `copying`: the same with a copy of the bytes, because DDS keeps messages until they are acknowledged.
"""

import contextlib
import os
import socket
import statistics
import subprocess
import sys
import threading
import time
from array import array
from collections.abc import Callable, Iterator
from typing import Any, Protocol

from benchmarks.processor import leave_processor, take_processor

PAUSE_S = {"tf": 0.001, "joints": 0.001, "cloud": 0.01}
"""The pause between two messages."""
TOPICS = {"tf": "/tf", "joints": "/joint_states", "cloud": "/points"}
CLOUD_SIZE = 1_000_000
DATAGRAM = 64_000
KEPT = 10
"""The depth of the publishers of joints and clouds."""
PATIENCE = 30.0
CYCLONE_ON_LOOPBACK = (
    '<CycloneDDS><Domain id="any"><General><Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/>'
    "</Interfaces></General></Domain></CycloneDDS>"
)
"""Otherwise as configured by default."""


class Receiver(Protocol):
    """Receives messages in its own thread from its creation on.

    Attributes:
        address: The address argument of the sender.
        received: How many messages have arrived.
    """

    address: str
    received: int


def message(kind: str) -> Any:
    """Return a message of the installed ROS packages."""
    from geometry_msgs.msg import TransformStamped
    from sensor_msgs.msg import JointState, PointCloud2

    if kind == "tf":
        stamped = TransformStamped()
        stamped.header.frame_id, stamped.child_frame_id = "odom", "base_link"
        return stamped
    if kind == "joints":
        names = [f"arm_joint_{number}" for number in range(30)]
        return JointState(name=names, position=[0.5] * 30, velocity=[0.1] * 30, effort=[2.0] * 30)
    cloud = PointCloud2(height=1, width=CLOUD_SIZE // 16, point_step=16, row_step=CLOUD_SIZE, is_dense=True)
    cloud.data = array("B", bytes(CLOUD_SIZE))
    return cloud


class RclpyReceiver:
    """A node that spins in a thread."""

    address = ""

    def __init__(self, kind: str) -> None:
        import rclpy

        self.received = 0
        rclpy.init()
        self._node = rclpy.create_node("receiver")
        self._node.create_subscription(_ros_type(kind), TOPICS[kind], self._on_message, 10)
        threading.Thread(target=rclpy.spin, args=(self._node,), daemon=True).start()

    def _on_message(self, _: object) -> None:
        self.received += 1


def _ros_type(kind: str) -> Any:
    if kind == "tf":
        from tf2_msgs.msg import TFMessage

        return TFMessage
    from sensor_msgs.msg import JointState, PointCloud2

    return JointState if kind == "joints" else PointCloud2


@contextlib.contextmanager
def rclpy_sender(kind: str, _: str) -> Iterator[Callable[[], object]]:
    import rclpy

    rclpy.init()
    node = rclpy.create_node("sender")
    content = message(kind)
    if kind == "tf":
        from tf2_ros import TransformBroadcaster

        broadcaster = TransformBroadcaster(node)
        publisher, send = broadcaster.pub_tf, lambda: broadcaster.sendTransform(content)
    else:
        publisher = node.create_publisher(_ros_type(kind), TOPICS[kind], 10)
        send = lambda: publisher.publish(content)  # noqa: E731 - as above
    while not publisher.get_subscription_count():
        time.sleep(0.01)
    yield send
    rclpy.shutdown()


class SocketReceiver:
    """A bare UDP socket."""

    def __init__(self, kind: str) -> None:
        self.received = 0
        self._datagrams = -(-len(serialized(kind)) // DATAGRAM)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 * CLOUD_SIZE)
        self._socket.bind(("127.0.0.1", 0))
        self.address = str(self._socket.getsockname()[1])
        threading.Thread(target=self._receive, daemon=True).start()

    def _receive(self) -> None:
        data = bytearray(self._datagrams * DATAGRAM)
        view = memoryview(data)
        while True:
            for number in range(self._datagrams):
                self._socket.recv_into(view[number * DATAGRAM :])
            self.received += 1


def serialized(kind: str) -> bytes:
    from coframe.messages import serialize
    from tf2_msgs.msg import TFMessage

    content = message(kind)
    return serialize(TFMessage(transforms=[content]) if kind == "tf" else content)


@contextlib.contextmanager
def socket_sender(kind: str, address: str) -> Iterator[Callable[[], object]]:
    data = serialized(kind)
    parts = [data[begin : begin + DATAGRAM] for begin in range(0, len(data), DATAGRAM)]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.connect(("127.0.0.1", int(address)))
        send = sender.send

        def send_all() -> None:
            with contextlib.suppress(ConnectionRefusedError):  # The receiver has ended.
                for part in parts:
                    send(part)

        yield send_all


@contextlib.contextmanager
def copying_sender(kind: str, address: str) -> Iterator[Callable[[], object]]:
    data = serialized(kind)
    kept = [memoryview(bytearray(data)) for _ in range(KEPT)]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.connect(("127.0.0.1", int(address)))
        send = sender.send

        def send_all() -> None:
            copy = kept[0]
            kept.append(kept.pop(0))
            copy[:] = data
            with contextlib.suppress(ConnectionRefusedError):  # The receiver has ended.
                for begin in range(0, len(copy), DATAGRAM):
                    send(copy[begin : begin + DATAGRAM])

        yield send_all


class CycloneReceiver:
    """A reader of the cyclonedds package, which waits in a thread."""

    address = ""

    def __init__(self, kind: str) -> None:
        from cyclonedds.domain import DomainParticipant
        from cyclonedds.sub import DataReader
        from cyclonedds.util import duration

        from benchmarks.peers import cyclone

        self.received = 0
        participant = DomainParticipant(int(os.environ["ROS_DOMAIN_ID"]))
        reader = DataReader(participant, cyclone.topic(participant, kind), cyclone.QOS)

        def receive() -> None:
            for _ in reader.take_iter(timeout=duration(seconds=PATIENCE)):
                self.received += 1

        threading.Thread(target=receive, daemon=True).start()


@contextlib.contextmanager
def cyclone_sender(kind: str, _: str) -> Iterator[Callable[[], object]]:
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.pub import DataWriter

    from benchmarks.peers import cyclone

    participant = DomainParticipant(int(os.environ["ROS_DOMAIN_ID"]))
    writer = DataWriter(participant, cyclone.topic(participant, kind), cyclone.QOS)
    content = cyclone.message(kind)
    while not writer.get_matched_subscriptions():
        time.sleep(0.01)
    yield lambda: writer.write(content)


@contextlib.contextmanager
def bytes_sender(kind: str, _: str) -> Iterator[Callable[[], object]]:
    from coframe.wire import Participant, QoS
    from coframe.wire.qos import TF

    participant = Participant.get()
    qos = TF if kind == "tf" else QoS(depth=KEPT)
    publisher = participant.publisher(participant.add_node("/", "sender"), TOPICS[kind], _ros_type(kind), qos)
    while not publisher.matched:
        time.sleep(0.01)
    data = serialized(kind)
    yield lambda: publisher.write(data)


RECEIVERS: dict[str, Callable[[str], Receiver]] = {
    "rclpy": RclpyReceiver,
    "bytes": RclpyReceiver,
    "socket": SocketReceiver,
    "copying": SocketReceiver,
    "cyclonedds": CycloneReceiver,
}
SENDERS = {
    "rclpy": rclpy_sender,
    "bytes": bytes_sender,
    "socket": socket_sender,
    "copying": copying_sender,
    "cyclonedds": cyclone_sender,
}


def send_messages(contender: str, kind: str, seconds: float, address: str, processor: str) -> None:
    """Send messages for a time, and print the median time of a call in nanoseconds."""
    take_processor(processor)
    took = []
    with SENDERS[contender](kind, address) as send:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            time.sleep(PAUSE_S[kind])
            begin = time.perf_counter_ns()
            send()
            took.append(time.perf_counter_ns() - begin)
        print(statistics.median(took), flush=True)
    os._exit(0)  # Threads of the middleware may still run.


def measure(quantity: str, contender: str, kind: str, seconds: float) -> float:
    processor = leave_processor()
    receiver = RECEIVERS[contender](kind)
    command = ["-m", "benchmarks.publishing", "send", contender, kind, str(seconds + 1), receiver.address, processor]
    with subprocess.Popen([*_python(), *command], stdout=subprocess.PIPE, text=True) as sender:
        print("the first message", file=sys.stderr, flush=True)
        end = time.monotonic() + PATIENCE
        while not receiver.received:
            if time.monotonic() > end:
                sender.kill()
                raise SystemExit(f"no message was received within {PATIENCE:g} s")
            time.sleep(0.01)
        print("the measurement", file=sys.stderr, flush=True)
        spent, received = time.process_time_ns(), receiver.received
        time.sleep(seconds)
        spent, received = time.process_time_ns() - spent, receiver.received - received
        assert sender.stdout
        median = float(sender.stdout.readline())
        if not received:
            raise SystemExit("no message was received during the measurement")
        return median if quantity == "publish" else spent / received


def _python() -> list[str]:
    return [sys.executable, *(["-E"] if sys.flags.ignore_environment else [])]


def main(quantity: str, contender: str, kind: str, seconds: str, address: str = "", processor: str = "") -> None:
    if quantity == "send":
        send_messages(contender, kind, float(seconds), address, processor)
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    if contender == "cyclonedds":
        os.environ["CYCLONEDDS_URI"] = CYCLONE_ON_LOOPBACK
    print(measure(quantity, contender, kind, float(seconds)), flush=True)
    os._exit(0)  # Threads of the middleware may still run.


if __name__ == "__main__":
    main(*sys.argv[1:])
