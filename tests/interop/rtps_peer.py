# SPDX-License-Identifier: Apache-2.0
"""A small RTPS participant with any vendor ID, which announces endpoints and counts what it is sent.

It matches every endpoint of its topics and types: quality of service and partitions are left to the other side. It
ignores the discovery data of others, and sends its own again and again until it is closed.
"""

from __future__ import annotations

import socket
import struct
import threading
import time
from typing import Final, NamedTuple

FAST_DDS: Final = b"\x01\x0f"
CYCLONE_DDS: Final = b"\x01\x10"
RTI_CONNEXT: Final = b"\x01\x01"

_PERIOD: Final = 0.05  # seconds between two announcements
_PARTICIPANTS: Final = 20  # the indexes of other participants to which it announces itself

_INFO_DESTINATION, _HEARTBEAT, _DATA, _DATA_FRAG = 0x0E, 0x07, 0x15, 0x16
_PARTICIPANT = bytes.fromhex("000001c1")
_SPDP_READER, _SPDP_WRITER = bytes.fromhex("000100c7"), bytes.fromhex("000100c2")
# The built-in reader and writer of announced writers, and of announced readers.
_SEDP = {
    "writer": (bytes.fromhex("000003c7"), bytes.fromhex("000003c2")),
    "reader": (bytes.fromhex("000004c7"), bytes.fromhex("000004c2")),
}
_UNKNOWN = bytes(4)
_ANNOUNCERS = 1 | 2 | 4 | 16  # it has the writers of SPDP and SEDP, and the reader of SPDP


class Received(NamedTuple):
    """A message that an endpoint of this participant was sent."""

    reader: bytes
    writer: bytes
    data: bytes


class RtpsPeer:
    """A participant on the loopback interface.

    Args:
        domain: The domain ID.
        vendor: The vendor ID, two bytes.

    Attributes:
        received: The messages that were sent to its readers, or to all readers.
    """

    def __init__(self, domain: int, vendor: bytes = FAST_DDS) -> None:
        self._vendor = vendor
        self.prefix = vendor + struct.pack("<QH", time.monotonic_ns() & 0xFFFFFFFFFFFF, 7)
        self.received: list[Received] = []
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(_PERIOD)
        base = 7400 + 250 * domain
        self._targets = [("127.0.0.1", base + 10 + 2 * index) for index in range(_PARTICIPANTS)]
        self._entities: list[bytes] = []
        self._announced: dict[str, list[bytes]] = {"writer": [], "reader": []}
        self._others: dict[bytes, tuple[tuple[str, int], tuple[str, int]]] = {}  # by prefix: discovery and data
        self._sequences: dict[bytes, int] = {}
        self._history: dict[bytes, list[tuple[int, bytes]]] = {}
        self._count = 0
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._threads = [threading.Thread(target=run, daemon=True) for run in (self._announce, self._receive)]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Stop, without a farewell."""
        self._closing.set()
        for thread in self._threads:
            thread.join()
        self._socket.close()

    def serve(self, service: str, ros_type: str) -> bytes:
        """Announce the endpoints of a server. Return the entity ID of the reader of requests."""
        self.announce("writer", f"rr{service}Reply", dds_type(f"{ros_type}_Response"))
        return self.announce("reader", f"rq{service}Request", dds_type(f"{ros_type}_Request"))

    def call(self, service: str, ros_type: str) -> bytes:
        """Announce the endpoints of a client. Return the entity ID of the writer of requests."""
        self.announce("reader", f"rr{service}Reply", dds_type(f"{ros_type}_Response"))
        return self.announce("writer", f"rq{service}Request", dds_type(f"{ros_type}_Request"))

    def name(self, name: str) -> None:
        """Announce that all endpoints so far belong to the node with this name."""
        from coframe.wire.rtps.discovery_info import NodeInfo, encode_info

        topic_type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"
        readers, writers = (
            tuple(self.prefix + entity for entity in self._entities if entity[3] == kind) for kind in (0x04, 0x03)
        )
        writer = self.announce("writer", "ros_discovery_info", topic_type, durable=True)
        self.write(writer, encode_info(self.prefix + _PARTICIPANT, [NodeInfo("/", name, readers, writers)], 16))

    def announce(
        self, kind: str, topic: str, type_name: str, partitions: tuple[str, ...] = (), *, durable: bool = False
    ) -> bytes:
        """Announce a reliable "reader" or "writer". Return its entity ID."""
        with self._lock:
            entity = struct.pack(">I", len(self._entities) + 1 << 8 | (0x04 if kind == "reader" else 0x03))
            self._entities.append(entity)
            parameters = [
                (0x005A, self.prefix + entity),
                (0x0050, self.prefix + _PARTICIPANT),
                (0x0005, _text(topic)),
                (0x0007, _text(type_name)),
                (0x001A, struct.pack("<IiI", 2, 0, 100_000_000)),
                (0x001D, struct.pack("<I", durable)),
            ]
            if partitions:
                names = b"".join(map(_text, partitions))
                parameters.append((0x0029, struct.pack("<I", len(partitions)) + names))
            self._announced[kind].append(_parameter_list(parameters))
        return entity

    def write(self, writer: bytes, data: bytes) -> None:
        """Send bytes, usually 4 of encapsulation and then CDR, padded to a multiple of 4, to all known participants.

        They are sent again with every announcement, so that participants that are discovered later receive them.
        """
        with self._lock:
            history = self._history.setdefault(writer, [])
            history.append((len(history) + 1, data + bytes(-len(data) % 4)))  # as RTPS requires
            for prefix, (_, address) in self._others.items():
                heartbeat, *_, last = _messages(_UNKNOWN, writer, history, self._next_count())
                self._send(address, prefix, heartbeat, last)

    def received_on(self, reader: bytes) -> list[bytes]:
        """Return the messages that one of its readers was sent. Those without a payload reach no application."""
        return [message.data for message in self.received if message.data and message.reader in {reader, _UNKNOWN}]

    def _next_count(self) -> int:
        self._count += 1
        return self._count

    def _announce(self) -> None:
        locator = struct.pack("<iI12x4B", 1, self._socket.getsockname()[1], 127, 0, 0, 1)
        participant = _parameter_list([
            (0x0015, b"\x02\x03\x00\x00"),
            (0x0016, self._vendor + bytes(2)),
            (0x0050, self.prefix + _PARTICIPANT),
            (0x0032, locator),
            (0x0031, locator),
            (0x0002, struct.pack("<iI", 100, 0)),
            (0x0058, struct.pack("<I", _ANNOUNCERS)),
        ])  # fmt: skip
        while not self._closing.wait(_PERIOD):
            with self._lock:
                spdp = _data(_SPDP_READER, _SPDP_WRITER, 1, participant)
                for address in self._targets:
                    self._send(address, None, spdp)
                for prefix, (address, _) in self._others.items():
                    for kind, endpoints in self._announced.items():
                        reader, writer = _SEDP[kind]
                        history = list(enumerate(endpoints, start=1))
                        if history:
                            self._send(address, prefix, *_messages(reader, writer, history, self._next_count()))
                for prefix, (_, address) in self._others.items():
                    for writer, history in self._history.items():
                        self._send(address, prefix, *_messages(_UNKNOWN, writer, history, self._next_count()))

    def _send(self, address: tuple[str, int], destination: bytes | None, *submessages: bytes) -> None:
        header = b"RTPS\x02\x03" + self._vendor + self.prefix
        target = b"" if destination is None else _submessage(_INFO_DESTINATION, destination)
        for submessage in submessages:
            self._socket.sendto(header + target + submessage, address)

    def _receive(self) -> None:
        while not self._closing.is_set():
            try:
                packet = self._socket.recv(65_536)
            except (TimeoutError, ConnectionRefusedError):
                continue
            if packet[:4] == b"RTPS" and packet[8:20] != self.prefix:
                self._read(packet[8:20], packet[20:])

    def _read(self, source: bytes, rest: bytes) -> None:
        while len(rest) >= 4:
            kind, flags, size = rest[0], rest[1], struct.unpack_from("<H", rest, 2)[0]
            body = rest[4 : 4 + size] if size else rest[4:]
            rest = rest[4 + len(body) :]
            if kind in {_DATA, _DATA_FRAG}:
                self._read_data(source, flags, body)

    def _read_data(self, source: bytes, flags: int, body: bytes) -> None:
        reader, writer = body[4:8], body[8:12]
        payload = body[4 + struct.unpack_from("<H", body, 2)[0] :]
        if flags & 2:  # inline QoS
            while (parameter := struct.unpack_from("<HH", payload))[0] != 1:
                payload = payload[4 + parameter[1] :]
            payload = payload[4:]
        if writer == _SPDP_WRITER:
            parameters = dict(_parameters(payload[4:]))
            if 0x0032 in parameters and 0x0031 in parameters:
                with self._lock:
                    self._others[source] = _address(parameters[0x0032]), _address(parameters[0x0031])
        elif writer[3] in {0x02, 0x03}:
            self.received.append(Received(reader, writer, payload))


def dds_type(ros_type: str) -> str:
    """Return the DDS type of a ROS type."""
    *package, name = ros_type.split("/")
    return "::".join([*package, "dds_", f"{name}_"])


def _messages(reader: bytes, writer: bytes, history: list[tuple[int, bytes]], count: int) -> list[bytes]:
    """Return a heartbeat, after which the other side accepts data, and all messages of a writer."""
    heartbeat = reader + writer + _number(1) + _number(history[-1][0]) + struct.pack("<I", count)
    return [_submessage(_HEARTBEAT, heartbeat), *(_data(reader, writer, number, data) for number, data in history)]


def _data(reader: bytes, writer: bytes, number: int, payload: bytes) -> bytes:
    return _submessage(_DATA, struct.pack("<HH", 0, 16) + reader + writer + _number(number) + payload, flags=0x05)


def _submessage(kind: int, body: bytes, flags: int = 0x01) -> bytes:
    return struct.pack("<BBH", kind, flags, len(body)) + body


def _number(value: int) -> bytes:
    return struct.pack("<iI", value >> 32, value & 0xFFFFFFFF)


def _text(text: str) -> bytes:
    data = text.encode() + b"\0"
    return struct.pack("<I", len(data)) + data + bytes(-len(data) % 4)


def _parameter_list(parameters: list[tuple[int, bytes]]) -> bytes:
    """Return the parameters as CDR in little endian, with their end."""
    body = b"".join(struct.pack("<HH", key, len(value)) + value for key, value in parameters)
    return b"\x00\x03\x00\x00" + body + struct.pack("<HH", 1, 0)


def _parameters(body: bytes) -> list[tuple[int, bytes]]:
    found = []
    while len(body) >= 4:
        key, size = struct.unpack_from("<HH", body)
        if key == 1:
            break
        found.append((key, body[4 : 4 + size]))
        body = body[4 + size :]
    return found


def _address(locator: bytes) -> tuple[str, int]:
    return ".".join(map(str, locator[20:24])), struct.unpack_from("<I", locator, 4)[0]
