# SPDX-License-Identifier: Apache-2.0
"""Large messages are in memory that processes share, unless a reader needs them as they are."""

import contextlib
import fcntl
import os
import resource
import struct
import sys
import threading
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from coframe import _core

native: Any = pytest.importorskip("coframe_fastdds._fastdds")
from coframe_fastdds._session import native_qos  # noqa: E402 - needs the module above

from coframe.wire.qos import QoS  # noqa: E402 - needs the module above

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the blocks are files of Linux")

TOPIC, TYPE = "rt/large", "std_msgs::msg::dds_::UInt8MultiArray_"
LARGE, HUGE = 1_000_000, 40_000_000
REFERENCE = bytes((0xC0, 0xF0, 0x00, 0x01))


def message(number: int, size: int = LARGE) -> bytes:
    return b"\0\1\0\0" + number.to_bytes(4, "little") + bytes((number % 251,)) * (size - 8)


def block_files() -> list[Path]:
    """Return the files of the blocks that the writers of this process have."""
    found = []
    for path in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(FileNotFoundError):  # the descriptor of the folder itself
            if "memfd:coframe" in str(path.readlink()):
                found.append(path)
    return found


def blocks() -> int:
    return len(block_files())


class Domain:
    """Participants of a domain with writers and readers of one topic."""

    def __init__(self, domain: int) -> None:
        self._domain = domain
        self.participants: list[Any] = []
        self.endpoints: list[Any] = []

    def participant(self, *properties: tuple[str, str]) -> Any:
        self.participants.append(
            native.Participant(
                domain=self._domain,
                name="/",
                user_data="enclave=/;",
                discovery_range="LOCALHOST",
                peers=[],
                profiles="",
                qos_from_profiles=False,
                asynchronous=False,
                properties=properties,
                changed=_core.Event(),
            )
        )
        return self.participants[-1]

    def writer(self, qos: QoS, participant: Any = None) -> Any:
        return self._add(native.Writer, participant, qos)

    def reader(self, qos: QoS, participant: Any = None) -> Any:
        return self._add(native.Reader, participant, qos, _core.Event())

    def tap(self, head: int) -> Any:
        return self._add(native.Tap, None, QoS(depth=10), head, 100, 1 << 30)

    def _add(self, cls: Any, participant: Any, qos: QoS, *arguments: Any) -> Any:
        owner = participant or self.participant()
        self.endpoints.append(cls(owner, TOPIC, TYPE, native_qos(qos), "", *arguments))
        return self.endpoints[-1]

    def close(self) -> None:
        for each in (*self.endpoints, *self.participants):
            each.close()


@pytest.fixture
def domain(domain_id: int) -> Iterator[Domain]:
    made = Domain(domain_id)
    yield made
    made.close()


def receive(reader: Any, count: int, eventually: Callable[..., None]) -> list[bytes]:
    received: list[bytes] = []

    def is_complete() -> bool:
        received.extend(data for data, _, _ in reader.take(100))
        return len(received) >= count

    eventually(is_complete)
    return received


@pytest.mark.parametrize("reliable", [True, False])
def test_each_message_arrives_as_it_was_sent(reliable: bool, domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=5, reliable=reliable)), domain.reader(QoS(depth=5, reliable=reliable))
    eventually(lambda: writer.matched and reader.matched)
    for number, size in enumerate((HUGE, 100, LARGE, 64_000, 63_999, LARGE + 1, HUGE)):
        writer.write(message(number, size))
        assert receive(reader, 1, eventually) == [message(number, size)]
    assert blocks() > 0


def test_a_block_is_used_again_when_the_reader_has_finished(domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    for number in range(50):
        writer.write(message(number))
        assert receive(reader, 1, eventually) == [message(number)]
    assert blocks() == 1


def test_messages_that_wait_in_the_queue_are_not_overwritten(domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=1)), domain.reader(QoS(depth=4))
    eventually(lambda: writer.matched and reader.matched)
    for number in range(30):
        writer.write(message(number))
    eventually(lambda: reader.pending)
    assert [data for data, _, _ in reader.take(100)] == [message(number) for number in range(26, 30)]
    assert blocks() <= 6


def test_messages_of_changing_sizes_take_a_bounded_number_of_blocks(domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=3)), domain.reader(QoS(depth=3))
    eventually(lambda: writer.matched and reader.matched)
    for number in range(200):
        size = 64_000 << (number % 8)
        writer.write(message(number, size))
        if number % 3 == 0:
            assert receive(reader, 1, eventually)[-1] == message(number, size)
    assert blocks() <= 5


def test_a_reader_that_cannot_open_blocks_receives_the_messages_as_well(domain: Domain, eventually) -> None:
    """Such as one of another program, or one that keeps all messages."""
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    writer.write(message(0))
    assert receive(reader, 1, eventually) == [message(0)]
    other = domain.reader(QoS(keep_all=True))
    eventually(lambda: writer.matched == 2 and other.matched)
    for number in (1, 2, 3):
        writer.write(message(number))
    expected = [message(number) for number in (1, 2, 3)]
    assert receive(reader, 3, eventually) == expected
    assert receive(other, 3, eventually) == expected
    assert blocks() == 1
    other.close()
    eventually(lambda: writer.matched == 1)
    writer.write(message(4))
    assert receive(reader, 1, eventually) == [message(4)]


def test_late_readers_of_latched_messages_receive_the_messages_themselves(domain: Domain, eventually) -> None:
    latched = QoS(depth=1, transient_local=True)
    writer, early = domain.writer(latched), domain.reader(latched)
    eventually(lambda: writer.matched and early.matched)
    writer.write(message(7))
    late = domain.reader(latched)
    assert receive(late, 1, eventually) == [message(7)]
    assert blocks() == 0


def test_secured_participants_share_no_blocks(domain: Domain, eventually) -> None:
    """What is in memory is not encrypted. The property stands for those that enable security."""
    writer = domain.writer(QoS(depth=10), domain.participant(("some.property", "1")))
    reader = domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    writer.write(message(1))
    assert receive(reader, 1, eventually) == [message(1)]
    assert blocks() == 0


def test_a_tap_copies_the_beginning_of_a_message(domain: Domain, eventually) -> None:
    writer, tap = domain.writer(QoS(depth=10)), domain.tap(16)
    eventually(lambda: writer.matched and tap.matched)
    writer.write(message(5, HUGE))
    taken: list[bytes] = []
    eventually(lambda: taken.append(tap.take()[0]) or b"".join(taken))
    assert b"".join(taken) == message(5, HUGE)[:16]
    assert blocks() == 1


def test_a_writer_that_is_closed_at_once_is_read(domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    writer.write(message(1))
    closing = threading.Thread(target=writer.close)
    closing.start()
    assert receive(reader, 1, eventually) == [message(1)]
    closing.join()
    assert blocks() == 0


def test_a_message_is_taken_although_another_writer_has_left_before(domain: Domain, eventually) -> None:
    """Fast DDS reports that in the queue of messages. Subscriptions of rclpy take one message at a time."""
    leaving, second, reader = domain.writer(QoS(depth=10)), domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: leaving.matched and second.matched and reader.matched == 2)
    leaving.write(message(1, 100))
    assert receive(reader, 1, eventually) == [message(1, 100)]
    leaving.close()
    eventually(lambda: reader.matched == 1)
    second.write(message(2, 100))
    assert second.wait_for_acks(10_000_000_000)
    assert [data for data, _, _ in reader.take(1)] == [message(2, 100)]


@pytest.mark.parametrize(
    "reference",
    [
        bytes(28),
        b"\xff" * 28,
        struct.pack("<iiIQQ", os.getpid(), 0, 1, 1, 100),
        struct.pack("<iiIQQ", 1, 1 << 30, 1, 1, 1 << 60),
    ],
    ids=["zeros", "ones", "no block", "too large"],  # the third one contains the process ID
)
def test_references_of_strangers_are_ignored(reference: bytes, domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    writer.forward(REFERENCE + reference)
    writer.write(message(1))
    assert receive(reader, 1, eventually) == [message(1)]


def test_a_reference_of_another_writer_is_ignored(domain: Domain, eventually) -> None:
    """It would deliver a message of another topic."""
    writer, stranger, reader = domain.writer(QoS(depth=10)), domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and stranger.matched and reader.matched == 2)
    writer.write(message(1))
    assert receive(reader, 1, eventually) == [message(1)]
    (file,) = block_files()
    token = file.read_bytes()[8:16]
    stranger.forward(REFERENCE + struct.pack("<iiI8sQ", os.getpid(), int(file.name), 1, token, 100))
    stranger.write(message(2))
    assert receive(reader, 1, eventually) == [message(2)]


class Forged:
    """A block of the test, with the header of a writer. Its first message is complete only if `complete` is 1."""

    def __init__(self, writer: Any, complete: int, *, magic: bytes = b"cfblock1", size: int = LARGE) -> None:
        self.file = os.memfd_create("forged", os.MFD_ALLOW_SEALING)
        self.token = self.file + 1000
        header = struct.pack("<8sQQ16sQII", magic, self.token, size, writer.guid, 1 << 32, complete, 0)
        os.write(self.file, header.ljust(64, b"\0") + message(9))
        fcntl.fcntl(self.file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK)

    def __del__(self) -> None:
        os.close(self.file)

    def reference(self, size: int = LARGE) -> bytes:
        return REFERENCE + struct.pack("<iiIQQ", os.getpid(), self.file, 1, self.token, size)


def test_only_complete_messages_of_valid_blocks_are_read(domain: Domain, eventually) -> None:
    """A writer may be stopped while it copies a message, and a stranger may send anything."""
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    cases = (
        (Forged(writer, 0), LARGE),
        (Forged(writer, 1, magic=b"other  1"), LARGE),
        (Forged(writer, 1), 2 * LARGE),
        (Forged(writer, 1), 1 << 63),
        (Forged(writer, 1, size=1 << 62), 1 << 40),
    )
    for forged, size in cases:
        writer.forward(forged.reference(size))
        writer.write(message(1))
        assert receive(reader, 1, eventually) == [message(1)]
    forged = Forged(writer, 1)
    writer.forward(forged.reference())
    assert receive(reader, 1, eventually) == [message(9)]


def test_a_reader_that_fails_to_open_a_block_asks_for_the_messages_themselves(domain: Domain, eventually) -> None:
    writer, reader = domain.writer(QoS(depth=10)), domain.reader(QoS(depth=10))
    eventually(lambda: writer.matched and reader.matched)
    writer.write(message(0))
    eventually(lambda: reader.pending)
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (3, hard))
    try:
        assert reader.take(10) == []
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    reader.take(10)  # withdraws
    writer.close()
    newer = domain.writer(QoS(depth=10))
    eventually(lambda: newer.matched)
    newer.write(message(1))
    assert receive(reader, 1, eventually) == [message(1)]
    assert blocks() == 0


@pytest.mark.slow
def test_clouds_of_40_mb_reach_another_process(start) -> None:
    process = start("fastdds", "large_messages.py", HUGE, 20)
    output, _ = process.communicate(timeout=120)
    assert process.returncode == 0
    sums = [str(zlib.crc32(bytes((number,)) * HUGE)) for number in range(20)]
    assert output.split() == sums


def test_a_process_that_ends_after_its_message_is_read(start) -> None:
    process = start("fastdds", "large_messages.py", LARGE, 1)
    output, _ = process.communicate(timeout=60)
    assert output.split() == [str(zlib.crc32(bytes(LARGE)))]
