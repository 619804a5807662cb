# SPDX-License-Identifier: Apache-2.0
"""A process on Fast DDS finds running nodes at once, and receives what was published before."""

import time
from collections.abc import Callable, Iterator

import pytest

from coframe.messages import codec, find
from coframe.wire.participant import Participant
from coframe.wire.qos import QoS

STRING = find("std_msgs/msg/String")


def text(data: str) -> bytes:
    return codec.serialize(STRING(data=data))


@pytest.fixture
def participant(domain_id: int) -> Iterator[Participant]:
    joined = Participant.get(domain_id, "fastdds")
    yield joined
    joined.close()


def test_a_new_process_receives_the_answers_to_its_first_announcement(
    start: Callable, domain_id: int, eventually: Callable
) -> None:
    """An answer that is lost is repeated with the next announcement, up to 3 s later."""
    start("fastdds", "talker.py", 1).stdout.readline()
    late = 0
    for _ in range(10):
        joined = Participant.get(domain_id, "fastdds")
        begin = time.monotonic()
        eventually(lambda joined=joined: joined.nodes())
        late += time.monotonic() - begin > 1.0
        joined.close()
    assert late <= 1


def test_a_latched_message_reaches_new_subscriptions_before_another_replaces_it(
    participant: Participant, eventually: Callable
) -> None:
    node = participant.add_node("/", "tester")
    for number in range(20):
        topic, qos = f"/latched{number}", QoS(depth=1, transient_local=True)
        publisher = participant.raw_publisher(node, topic, "std_msgs/msg/String", qos)
        publisher.write(text("old"))
        subscription = participant.raw_subscription(
            node, topic, "std_msgs/msg/String", QoS(depth=10, transient_local=True)
        )
        eventually(lambda publisher=publisher: publisher.matched == 1)
        publisher.write(text("new"))
        received: list[bytes] = []
        eventually(
            lambda received=received, subscription=subscription: (
                received.extend(sample.data for sample in subscription.take(10)) or text("new") in received
            )
        )
        assert received == [text("old"), text("new")]
