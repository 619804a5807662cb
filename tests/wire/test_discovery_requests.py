# SPDX-License-Identifier: Apache-2.0
"""The message that requests the endpoints of participants on Fast DDS, and who gets it."""

import socket
import threading

import pytest

from coframe.wire.dds import participants
from coframe.wire.dds._discovery_requests import DiscoveryRequests, acknowledgement

OWN, FAST, OTHER_FAST, CYCLONE = (
    vendor + bytes(range(2, 16)) for vendor in (b"\1\x10", b"\1\x0f", b"\1\x0f\7", b"\1\x10\7")
)


class Graph:
    def __init__(self, *guids):
        self.guids = set(guids)

    def participants(self):
        return self.guids


@pytest.fixture
def received(monkeypatch):
    """The datagrams that arrive at the ports of the domain's participants."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    receiver.settimeout(5)
    port = receiver.getsockname()[1]
    monkeypatch.setattr("coframe.wire.dds._discovery_requests.discovery_ports", lambda _: range(port, port + 1))
    yield lambda: receiver.recv(65536)
    receiver.close()


def send(requests):
    while (pause := requests.update()) < 100_000_000:
        threading.Event().wait(pause / 1e9)


def test_the_message_asks_for_heartbeats_of_publications_and_subscriptions():
    message = acknowledgement(OWN, [FAST])
    assert message[:20] == b"RTPS\2\1\1\x0f" + OWN[:12]
    assert message[20:36] == bytes.fromhex("0e010c00") + FAST[:12]
    empty = bytes(4 * 3) + b"\1\0\0\0"  # the base 0, no missing numbers; the count 1
    publications, subscriptions = bytes.fromhex("000003c7 000003c2"), bytes.fromhex("000004c7 000004c2")
    assert message[36:] == b"".join(bytes.fromhex("06011800") + ids + empty for ids in (publications, subscriptions))


def test_participants_on_fast_dds_are_asked_once(received):
    graph = Graph(OWN, CYCLONE, FAST)
    requests = DiscoveryRequests(OWN, 5, graph)
    send(requests)
    assert received() == acknowledgement(OWN, [FAST])
    graph.guids.add(OTHER_FAST)
    send(requests)
    assert received() == acknowledgement(OWN, [OTHER_FAST])


def test_nothing_is_sent_without_participants_on_fast_dds(monkeypatch):
    def forbidden(*_):
        raise AssertionError("nothing may be sent")

    monkeypatch.setattr(socket, "socket", forbidden)
    assert DiscoveryRequests(OWN, 5, Graph(OWN, CYCLONE)).update() >= 100_000_000


def test_ports_of_high_domains_end_at_the_last_one():
    assert list(participants.discovery_ports(0))[:2] == [7410, 7412]
    assert participants.discovery_ports(232)[-1] <= 65535
