# SPDX-License-Identifier: Apache-2.0
"""Replies that wait until their clients are discovered."""

import threading
import time

import pytest

from coframe.wire import _delayed_replies as delayed
from coframe.wire._delayed_replies import DelayedReplies


class Clients:
    """Clients that receive replies once they are discovered."""

    def __init__(self) -> None:
        self.replies = DelayedReplies("/add")
        self.discovered: set[int] = set()
        self.received: list[tuple[int, int]] = []

    def reply(self, client: int, number: int) -> None:
        """Reply to a client with a number."""
        self.replies.send(client, lambda: client in self.discovered, lambda: self.received.append((client, number)))


@pytest.fixture
def clients():
    yield (made := Clients())
    made.replies.finish()


def test_a_reply_to_a_discovered_client_is_sent_at_once_by_the_same_thread(clients):
    clients.discovered.add(1)
    before = threading.active_count()
    clients.reply(1, 1)
    assert clients.received == [(1, 1)]
    assert threading.active_count() == before


def test_replies_to_one_client_keep_their_order_and_do_not_delay_others(clients, eventually):
    for number in range(20):
        clients.reply(1, number)
    clients.discovered.add(2)
    clients.reply(2, 0)
    assert clients.received == [(2, 0)]
    clients.discovered.add(1)
    for number in range(20, 40):
        clients.reply(1, number)
    eventually(lambda: len(clients.received) == 41)
    assert clients.received[1:] == [(1, number) for number in range(40)]


def test_a_reply_is_sent_after_the_longest_delay_even_if_its_client_never_appears(clients, eventually):
    start = time.monotonic()
    clients.reply(1, 1)
    eventually(lambda: clients.received)
    assert time.monotonic() - start >= delayed.MAX_DELAY


def test_the_number_of_waiting_replies_is_limited(clients):
    for number in range(delayed.MAX_WAITING_REPLIES + 1):
        clients.reply(1, number)
    assert clients.received == [(1, delayed.MAX_WAITING_REPLIES)]  # sent at once
    for client in range(2, delayed.MAX_WAITING_CLIENTS + 2):
        clients.reply(client, 0)
    assert clients.received[1] == (delayed.MAX_WAITING_CLIENTS + 1, 0)


def test_finish_waits_for_the_last_reply_and_ends_the_thread(clients, eventually):
    clients.reply(1, 1)
    threading.Timer(0.1, clients.discovered.add, (1,)).start()
    clients.replies.finish()
    assert clients.received == [(1, 1)]
    eventually(lambda: not any(thread.name == "coframe-replies/add" for thread in threading.enumerate()))
