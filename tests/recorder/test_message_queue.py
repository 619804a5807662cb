"""The queue before the disk."""

from coframe.recorder.message_queue import MessageQueue, ReceivedMessage, Source

TF = Source("/tf", "tf2_msgs/msg/TFMessage", latched=False)
STATIC = Source("/tf_static", "tf2_msgs/msg/TFMessage", latched=True)


def message(source, received, size=800):
    return ReceivedMessage(source, bytes(size), received, received, publisher=1)


def test_messages_leave_in_the_order_in_which_they_came():
    backlog = MessageQueue(1 << 20)
    for i, source in enumerate([TF, STATIC, STATIC, TF, STATIC, TF]):
        backlog.put(message(source, i))
    assert [taken.received for taken in backlog.take(0.0, 2500)] == [0, 1, 2]
    assert [taken.received for taken in backlog.take(0.0, 1 << 20)] == [3, 4, 5]
    assert backlog.size == 0
    assert backlog.take(0.01, 1 << 20) == []


def test_the_oldest_make_room_but_not_the_latched_ones():
    backlog = MessageQueue(5000)
    backlog.put(message(STATIC, 0))
    for i in range(1, 20):
        backlog.put(message(TF, i))
    assert backlog.size <= 5000
    assert [taken.received for taken in backlog.take(0.0, 1 << 20)] == [0, 16, 17, 18, 19]
    assert backlog.dropped == {"/tf": 15}


def test_latched_messages_alone_cannot_fill_the_memory():
    backlog = MessageQueue(5000)
    for i in range(20):
        backlog.put(message(STATIC, i))
    assert [taken.received for taken in backlog.take(0.0, 1 << 20)] == [15, 16, 17, 18, 19]
    assert backlog.dropped == {"/tf_static": 15}


def test_one_message_larger_than_the_limit_is_kept():
    backlog = MessageQueue(100)
    backlog.put(message(TF, 1, size=10_000))
    assert len(backlog.take(0.0, 1)) == 1
    backlog.close()
    assert backlog.is_done
