# SPDX-License-Identifier: Apache-2.0
import time

import pytest

import coframe
from coframe.messages import codec, find
from coframe.wire import GraphNode, QoS
from coframe.wire.qos import TF, TF_STATIC_WRITER

TF_MESSAGE = find("tf2_msgs/msg/TFMessage")
TRANSFORM_STAMPED = find("geometry_msgs/msg/TransformStamped")

BROADCASTER = """
    import time
    import coframe
    from coframe.messages import find
    from coframe.wire.qos import TF
    with coframe.connect("broadcaster") as ros:
        message = find("tf2_msgs/msg/TFMessage")()
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = "odom", "base_link"
        stamped.transform.rotation.w = 1.0
        message.transforms.append(stamped)
        publisher = ros.publisher("/tf", find("tf2_msgs/msg/TFMessage"), TF)
        while not publisher.matched > 1:  # ros.buffer's own reader is one
            time.sleep(0.005)
        number = 0
        while publisher.matched > 1:
            number += 1
            stamped.header.stamp.sec, stamped.header.stamp.nanosec = 100 + number // 1000, number % 1000 * 1_000_000
            stamped.transform.translation.x = float(number)
            publisher.publish(message)
            time.sleep(0.001)
"""


BROKEN_MESSAGES = """
warnings = []
participant.on_warning(warnings.append)
buffer = coframe.Buffer()
reader = participant.tf_reader(node, "/tf", buffer, static=False)
publisher = peer.advertise("/tf", "tf2_msgs/msg/TFMessage", depth=1000)
eventually(lambda: reader.matched and publisher.subscriber_count)
publisher.send_payload(whole)
eventually(lambda: buffer.statistics["stored"] == 2)
sent = 0
for size in range(8, len(whole), 4):  # DDS itself drops what is shorter, and sends multiples of 4
    publisher.send_payload(whole[:size])
    sent += 1
for seed in range(4, 50):
    sent += 1
    publisher.send_payload(bytes([0, 1, 0, 0]) + bytes((seed * 37 + i * i) % 256 for i in range(seed)))
publisher.send_payload(whole + bytes(32))
publisher.send_payload(whole.replace(b"a" + bytes(1), bytes([255, 0])))
publisher.send_payload(last)
eventually(lambda: buffer.can_transform("a", "last"))
assert buffer.statistics["malformed"] == sent + 1, buffer.statistics
assert buffer.statistics["refused"] >= 1
eventually(lambda: any(text.startswith("Dropped") and "are not a TFMessage" in text for text in warnings))
assert set(buffer.frame_names()) <= {"a", "b", "c", "last"}
"""


def stamped(parent, child, x=0.0):
    message = TRANSFORM_STAMPED()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x = x
    message.transform.rotation.w = 1.0
    return message


def tf_cdr(*transforms):
    return codec.serialize(TF_MESSAGE(transforms=list(transforms)))


def test_transforms_of_another_process_fill_the_buffer(participant, node, child, eventually):
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf", buffer, static=False)
    other = child(BROADCASTER)
    eventually(lambda: buffer.can_transform("odom", "base_link"))
    first = buffer.lookup("odom", "base_link")
    eventually(lambda: buffer.lookup("odom", "base_link").stamp > first.stamp)
    assert reader.matched == 1
    assert {frame.authority for frame in buffer.frames() if frame.name == "base_link"} == {"default_authority"}
    reader.close()
    changes = buffer._changes
    assert other.finish() == (0, "")
    assert buffer._changes == changes, "nothing is stored after close"


@pytest.mark.dds_only("over Zenoh, the thread that receives is a thread of Python")
def test_transforms_are_stored_while_python_is_busy(participant, node, child, eventually):
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf", buffer, static=False)
    other = child(BROADCASTER)
    eventually(lambda: buffer.can_transform("odom", "base_link"))
    before = buffer._changes
    sum(range(30_000_000))  # one C call, which holds the GIL
    stored = buffer._changes - before
    reader.close()
    assert stored > 50
    assert other.finish() == (0, "")


def test_a_wait_ends_when_the_transform_arrives(participant, node, child):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf", buffer, static=False)
    child(BROADCASTER)
    assert buffer.lookup("odom", "base_link", timeout="20s").translation[0] > 0


def test_a_late_joining_process_receives_the_static_transforms(participant, node, child, eventually):
    child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("early") as ros:
            stamped = find("geometry_msgs/msg/TransformStamped")()
            stamped.header.frame_id, stamped.child_frame_id = "base_link", "lidar"
            stamped.transform.rotation.w = 1.0
            writer = ros.participant.static_broadcaster(ros.node)
            writer.send([stamped])
            print("sent", flush=True)
            input()
    """).read()
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf_static", buffer, static=True)
    eventually(lambda: buffer.can_transform("base_link", "lidar"))


def test_transforms_published_before_the_reader_are_stored(participant, node, eventually):
    participant.publisher(node, "/tf_static", TF_MESSAGE, TF_STATIC_WRITER).write(tf_cdr(stamped("a", "b")))
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf_static", buffer, static=True)
    eventually(lambda: buffer.can_transform("a", "b"))


def test_the_publishing_node_is_recorded_if_requested(participant, child, node, eventually):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf", buffer, static=False, authority=None)
    child(BROADCASTER)
    eventually(lambda: any(frame.authority == "/broadcaster" for frame in buffer.frames()))


def test_the_publishing_node_of_static_transforms_is_recorded(participant, node, child, eventually):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf_static", buffer, static=True, authority=None)
    child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("placer") as ros:
            stamped = find("geometry_msgs/msg/TransformStamped")()
            stamped.header.frame_id, stamped.child_frame_id = "base_link", "lidar"
            stamped.transform.rotation.w = 1.0
            ros.participant.static_broadcaster(ros.node).send([stamped])
            input()
    """)
    eventually(lambda: any(frame.authority == "/placer" for frame in buffer.frames()))


def test_static_transforms_that_arrive_before_the_node_name_get_it(participant, node, eventually):
    publisher = participant.publisher(node, "/tf_static", TF_MESSAGE, TF_STATIC_WRITER)
    watcher = participant.subscription(node, "/tf_static", TF_MESSAGE, TF_STATIC_WRITER, on_data=None)
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf_static", buffer, static=True, authority="unknown")
    publisher.write(tf_cdr(stamped("a", "b")))
    eventually(lambda: watcher.pending() and buffer.can_transform("a", "b"))
    (sample,) = watcher.take()
    assert [frame.authority for frame in buffer.frames() if frame.name == "b"] == ["unknown"]
    reader._reader.name_writer(sample.writer, "/late")
    assert [frame.authority for frame in buffer.frames() if frame.name == "b"] == ["/late"]


@pytest.mark.cyclone_only("the other program is found by multicast, which Fast DDS does not use on one machine")
def test_damaged_messages_are_counted_and_others_are_stored(beside_rosless):
    whole, last = tf_cdr(stamped("a", "b"), stamped("b", "c")), tf_cdr(stamped("a", "last"))
    beside_rosless(f"whole, last = {whole!r}, {last!r}\n" + BROKEN_MESSAGES)


def test_an_empty_message_is_accepted(participant, node, eventually):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf", buffer, static=False)
    participant.publisher(node, "/tf", TF_MESSAGE, TF).write(tf_cdr())
    eventually(lambda: buffer.statistics["messages"] == 1)
    assert buffer.statistics["malformed"] == 0


def test_readers_are_created_and_closed_under_load(participant, node, child, eventually):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf", buffer, static=False)
    other = child(BROADCASTER)
    eventually(lambda: buffer.can_transform("odom", "base_link"))
    for _ in range(50):
        passing = coframe.Buffer()
        reader = participant.tf_reader(node, "/tf", passing, static=False)
        reader.close()
        del passing, reader
    seen = buffer._changes
    eventually(lambda: buffer._changes > seen)
    assert other.process.poll() is None


def test_a_reader_with_another_qos(participant, node):
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf", buffer, static=False, qos=QoS(depth=1, reliable=False))
    assert [subscriber.qos.reliable for subscriber in participant.subscribers("/tf")] == [False]


def test_a_late_node_name_does_not_insert_transforms_again(participant, node, eventually):
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf_static", buffer, static=True, authority="someone")
    first, second = (participant.publisher(node, "/tf_static", TF_MESSAGE, TF_STATIC_WRITER) for _ in range(2))
    first.write(tf_cdr(stamped("a", "b", 1.0), stamped("a", "c")))
    (handle,) = (h for h, w in participant._graph.writers("rt/tf_static").items() if w.guid == first.guid)
    eventually(lambda: buffer.can_transform("a", "c"))
    second.write(tf_cdr(stamped("a", "b", 2.0)))
    eventually(lambda: buffer.lookup("a", "b").translation[0] == 2)
    reader._reader.name_writer(handle, "/first")
    assert buffer.lookup("a", "b").translation[0] == 2
    assert {frame.name: frame.authority for frame in buffer.frames() if frame.parent}["c"] == "/first"


def test_writers_that_left_are_forgotten(participant, node, eventually):
    reader = participant.tf_reader(node, "/tf", coframe.Buffer(), static=False, authority=None)
    publishers = [participant.publisher(node, "/tf", TF_MESSAGE, TF) for _ in range(3)]
    eventually(lambda: len(reader._node_names) == 3)
    for publisher in publishers:
        publisher.close()
    eventually(lambda: not reader._node_names)


def test_a_reader_is_fully_constructed_before_other_threads_use_it(participant, node, monkeypatch):
    add = GraphNode.add

    def add_and_look(self, endpoint):
        add(self, endpoint)
        participant._graph_changed()

    monkeypatch.setattr(GraphNode, "add", add_and_look)
    participant.tf_reader(node, "/tf", coframe.Buffer(), static=False, authority=None)


def test_rejected_transforms_are_reported_with_their_publisher(participant, node, eventually):
    received = []
    participant.on_warning(received.append)
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf", buffer, static=False)
    publisher = participant.publisher(node, "/tf", TF_MESSAGE, TF)
    eventually(lambda: reader.matched and publisher.matched)
    good, zeros = stamped("odom", "good"), stamped("odom", "base_link")
    zeros.transform.rotation.w = 0.0
    publisher.write(codec.serialize(TF_MESSAGE(transforms=[good, zeros])))
    eventually(lambda: received)
    assert len(received) == 1
    assert received[0].startswith(
        "Rejected 1 of the transforms on /tf (from /tester): tf2 requires a non-zero quaternion"
    )


def test_stored_at_is_the_time_of_the_last_insertion(participant, node, eventually):
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf", buffer, static=False)
    assert reader.stored_at == 0
    publisher = participant.publisher(node, "/tf", TF_MESSAGE, TF)
    publisher.write(tf_cdr())
    assert reader.stored_at == 0, "nothing was stored"
    for _ in range(2):
        before = time.monotonic_ns()
        publisher.write(tf_cdr(stamped("a", "b")))
        eventually(lambda before=before: before < reader.stored_at <= time.monotonic_ns())
