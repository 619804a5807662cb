# SPDX-License-Identifier: Apache-2.0
"""The queue of messages that are not on the disk yet."""

from coframe.recorder._message_queue import MessageQueue, MessageSource, ReceivedMessage

TF = MessageSource("/tf", "tf2_msgs/msg/TFMessage", latched=False)
STATIC = MessageSource("/tf_static", "tf2_msgs/msg/TFMessage", latched=True)


def message(source, received, size=800):
    return ReceivedMessage(source, bytes(size), received, received, publisher=1)


def test_messages_are_taken_in_the_order_of_arrival():
    queue = MessageQueue(1 << 20)
    for i, source in enumerate([TF, STATIC, STATIC, TF, STATIC, TF]):
        queue.add_message(message(source, i))
    assert [entry.received for entry in queue.take(0.0, 2500)] == [0, 1, 2]
    assert [entry.received for entry in queue.take(0.0, 1 << 20)] == [3, 4, 5]
    assert queue.size == 0
    assert queue.take(0.01, 1 << 20) == []


def test_a_full_queue_drops_the_oldest_messages_that_are_not_latched():
    queue = MessageQueue(5000)
    queue.add_message(message(STATIC, 0))
    for i in range(1, 20):
        queue.add_message(message(TF, i))
    assert queue.size <= 5000
    assert [entry.received for entry in queue.take(0.0, 1 << 20)] == [0, 16, 17, 18, 19]
    assert queue.dropped == {"/tf": 15}


def test_a_full_queue_of_latched_messages_drops_the_oldest():
    queue = MessageQueue(5000)
    for i in range(20):
        queue.add_message(message(STATIC, i))
    assert [entry.received for entry in queue.take(0.0, 1 << 20)] == [15, 16, 17, 18, 19]
    assert queue.dropped == {"/tf_static": 15}


def test_a_single_message_larger_than_the_limit_is_kept():
    queue = MessageQueue(100)
    queue.add_message(message(TF, 1, size=10_000))
    assert len(queue.take(0.0, 1)) == 1
    queue.close()
    assert queue.is_done
