# SPDX-License-Identifier: Apache-2.0
import asyncio
import threading

import pytest

import coframe
from coframe.messages import codec, find
from coframe.wire import QoS

STRING = find("std_msgs/msg/String")
RELIABLE = QoS(depth=1000)


def test_publish_and_receive(domain_id):
    with coframe.connect("one", domain=domain_id) as ros:
        subscription = ros.subscribe("chatter", STRING)
        publisher = ros.publisher("/chatter", STRING)
        publisher.publish(STRING(data="hello"))
        message = subscription.receive("10s")
        assert message is not None
        assert message.data == "hello"
        assert subscription.receive(0) is None


def test_a_relative_topic_is_in_the_namespace_of_the_node(domain_id):
    with coframe.connect("one", node_namespace="/robot", domain=domain_id) as ros:
        ros.publisher("chatter", STRING)
        assert "/robot/chatter" in ros.participant.topics()
        assert ("/robot", "one") in ros.participant.nodes()


def test_a_callback_runs_on_its_own_thread_and_may_raise(domain_id, caplog):
    received, done, before = [], threading.Event(), set(threading.enumerate())

    def callback(message):
        received.append(message.data)
        if message.data == "bad":
            raise RuntimeError("on purpose")
        if message.data == "end":
            done.set()

    with coframe.connect("one", domain=domain_id) as ros:
        ros.subscribe("/chatter", STRING, callback)
        publisher = ros.publisher("/chatter", STRING)
        for text in ("hello", "bad", "end"):
            publisher.publish(STRING(data=text))
        assert done.wait(10)
    assert received == ["hello", "bad", "end"]
    assert "on purpose" in caplog.text
    assert set(threading.enumerate()) <= before


def test_damaged_messages_are_counted_in_few_lines(domain_id, caplog):
    """Another node can send any number of them."""
    received = threading.Event()
    with coframe.connect("one", domain=domain_id) as ros:
        ros.subscribe("/chatter", STRING, lambda _: received.set())
        participant = ros.participant
        damaged = participant.raw_publisher(
            participant.add_node("/", "two"), "/chatter", "std_msgs/msg/String", RELIABLE
        )
        for _ in range(200):
            damaged.write(b"\0\1\0\0\xff\xff\xff\x7f")
        damaged.write(codec.serialize(STRING(data="valid")))
        assert received.wait(10)
    (line,) = [record.message for record in caplog.records if "/chatter" in record.message]
    assert line.startswith("A message on /chatter is ignored: std_msgs/msg/String: at byte 8 of 8, ")
    assert "Traceback" not in caplog.text


def test_close_ends_iteration_over_a_subscription(domain_id):
    ros = coframe.connect("one", domain=domain_id)
    subscription = ros.subscribe("/chatter", STRING)
    closer = threading.Timer(0.05, ros.close)
    closer.start()
    assert list(subscription) == []
    closer.join()
    ros.close()


def test_the_buffer_receives_transforms_and_records_their_publishers(domain_id, eventually):
    with coframe.connect("one", domain=domain_id) as ros:
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = "map", "odom"
        stamped.transform.rotation.w = 1.0
        ros.participant.static_broadcaster(ros.node).send([stamped])
        ros.buffer.lookup("map", "odom", timeout="10s")
        eventually(lambda: any(frame.authority == "/one" for frame in ros.buffer.frames()))
    assert ros.buffer.can_transform("map", "odom"), "received transforms are kept"


def test_arguments_of_the_wrong_type(domain_id):
    with coframe.connect("one", domain=domain_id) as ros:
        for arguments in ((STRING, "/chatter"), ("/chatter", "std_msgs/msg/String"), ("/chatter", STRING())):
            with pytest.raises(TypeError):
                ros.publisher(*arguments)
            with pytest.raises(TypeError):
                ros.subscribe(*arguments)
        with pytest.raises(TypeError, match="must be a function, not 3"):
            ros.subscribe("/chatter", STRING, 3)
        publisher = ros.publisher("/chatter", STRING, 10)
        with pytest.raises(TypeError, match="cannot publish Int32 on /chatter: expected String"):
            publisher.publish(find("std_msgs/msg/Int32")())
        assert ros.subscribe("/chatter", STRING, qos=3).receive("1ms") is None


def test_a_closed_connection_creates_no_endpoints(domain_id):
    with coframe.connect("one", domain=domain_id), coframe.connect("two", domain=domain_id) as ros:
        ros.close()
        with pytest.raises(coframe.WireError, match="The connection of two is closed"):
            ros.publisher("/chatter", STRING)
        with pytest.raises(coframe.WireError, match="The connection of two is closed"):
            ros.subscribe("/chatter", STRING)


@pytest.mark.parametrize(
    "wait",
    [
        lambda ros, _, timeout: ros.wait_for_statics(timeout),
        lambda _, subscription, timeout: subscription.receive(timeout),
        lambda ros, _, timeout: ros.buffer.lookup("a", "b", timeout=timeout),
    ],
)
def test_a_timeout_without_a_unit_is_refused_everywhere(domain_id, wait):
    with coframe.connect("one", domain=domain_id) as ros:
        subscription = ros.subscribe("chatter", STRING)
        with pytest.raises(ValueError, match=r'the duration 1 has no unit.*write "1s"'):
            wait(ros, subscription, 1)
        with pytest.raises(TypeError, match=r'For 0.5 seconds, write "0.5s"'):
            wait(ros, subscription, 0.5)


@pytest.mark.parametrize(
    ("store", "method"),
    [
        (lambda buffer: buffer.set("odom", "base", coframe.Transform(), 1), "connection.send("),
        (lambda buffer: buffer.set("odom", "base", coframe.Transform(), static=True), "connection.send_static("),
        (lambda buffer: buffer.set_many("odom", "base", [1], [[0, 0, 0, 0, 0, 0, 1]]), "connection.send("),
    ],
)
def test_a_transform_that_the_program_stores_is_not_published_which_is_logged_once(domain_id, caplog, store, method):
    with coframe.connect("one", domain=domain_id) as ros:
        store(ros.buffer)
        store(ros.buffer)
        [record] = [record for record in caplog.records if "publishes nothing" in record.getMessage()]
        assert "odom -> base is stored in the buffer of this process only" in record.getMessage()
        assert method in record.getMessage()
        assert "base" in ros.buffer


def test_static_transforms_are_not_complete_before_anything_was_discovered(domain_id):
    with coframe.connect("one", domain=domain_id) as ros:
        assert not ros.wait_for_statics("1500ms")


def test_transforms_are_sent_to_other_nodes(domain_id):
    with coframe.connect("one", domain=domain_id) as one, coframe.connect("two", domain=domain_id) as two:
        one.send_static("base", "lidar", coframe.Transform([0, 0, 1.0]))
        one.send_static("base", "camera", coframe.Transform([0, 1.0, 0]))
        statics = [two.buffer.wait("base", name, timeout="10s") for name in ("lidar", "camera")]
        assert [pose.translation.tolist() for pose in statics] == [[0, 0, 1], [0, 1, 0]]
        for second in (1, 2):
            one.send("odom", "base", coframe.Transform([second, 0, 0]), second * 1_000_000_000)
        assert two.buffer.wait("odom", "lidar", 1_500_000_000, timeout="10s").x == 1.5
        one.send("map", "odom", coframe.Transform(target="map", source="odom"))
        assert two.buffer.wait("map", "odom", timeout="10s").stamp > 1_600_000_000 * 1_000_000_000
    with coframe.connect("one", domain=domain_id) as one:
        with pytest.raises(
            coframe.FrameMismatchException, match=r"cannot send the transform map <- base as odom <- base"
        ):
            one.send("odom", "base", coframe.Transform(target="map", source="base"))
        with pytest.raises(coframe.InvalidArgumentException, match="cannot send a batch"):
            one.send("odom", "base", coframe.Transform([[0, 0, 0]]))
        with pytest.raises(TypeError, match=r"expected a coframe.Transform, not list"):
            one.send_static("odom", "base", [1, 2, 3])
    with pytest.raises(coframe.WireError, match="is closed"):
        one.send("odom", "base", coframe.Transform())


def test_messages_are_published_without_a_publisher(domain_id):
    with coframe.connect("one", domain=domain_id) as ros:
        subscription = ros.subscribe("chatter", STRING)
        threads = [threading.Thread(target=ros.publish, args=("chatter", STRING(data=str(i)))) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert {subscription.receive("10s").data for _ in threads} == {"0", "1", "2", "3"}
        with pytest.raises(TypeError, match="expected a message class"):
            ros.publish("chatter", "text")
    with pytest.raises(coframe.WireError, match="is closed"):
        ros.publish("chatter", STRING())


def test_messages_are_received_in_asyncio(domain_id):
    async def received(ros, subscription):
        ticks = 0

        async def count():
            nonlocal ticks
            while True:
                await asyncio.sleep(0.01)
                ticks += 1

        counting = asyncio.create_task(count())
        waiting = asyncio.create_task(subscription.receive_async("10s"))
        while ticks < 3:  # noqa: ASYNC110 - the loop runs while the subscription waits
            await asyncio.sleep(0.01)
        assert not waiting.done()
        ros.publish("chatter", STRING(data="first"))
        found = [(await waiting).data]
        for text in ("second", "end"):
            ros.publish("chatter", STRING(data=text))
        async for message in subscription:
            found.append(message.data)
            if message.data == "end":
                break
        assert await subscription.receive_async("1ms") is None
        cancelled = asyncio.create_task(subscription.receive_async())
        await asyncio.sleep(0)
        cancelled.cancel()
        ros.publish("chatter", STRING(data="after"))
        found.append((await subscription.receive_async("10s")).data)
        closing = asyncio.create_task(subscription.receive_async())
        await asyncio.sleep(0.05)
        await asyncio.to_thread(subscription.close)
        assert await closing is None
        counting.cancel()
        return found

    with coframe.connect("one", domain=domain_id) as ros:
        subscription = ros.subscribe("chatter", STRING)
        assert asyncio.run(received(ros, subscription)) == ["first", "second", "end", "after"]


@pytest.mark.parametrize("shared", [False, True])
def test_a_connection_interpolates_along_screws_if_asked(domain_id, eventually, shared):
    with (
        coframe.connect("sender", domain=domain_id) as sender,
        coframe.connect("listener", domain=domain_id, interpolation="screw", shared=shared) as ros,
    ):
        assert (ros.buffer.interpolation, sender.buffer.interpolation) == ("screw", "decoupled")
        for stamp, yaw in ((1_000_000_000, 0.0), (2_000_000_000, 1.0)):
            pose = coframe.Transform.from_rpy([yaw, 0.0, 0.0], yaw=yaw)
            eventually(
                lambda p=pose, s=stamp: sender.send("odom", "base", p, stamp=s) or ros.buffer.frame_exists("base")
            )
        expected = coframe.Buffer(None, interpolation="screw")
        expected.set("odom", "base", coframe.Transform(), 1_000_000_000)
        expected.set("odom", "base", coframe.Transform.from_rpy([1.0, 0.0, 0.0], yaw=1.0), 2_000_000_000)
        found = ros.buffer.lookup("odom", "base", 1_500_000_000, timeout="5s")
        assert found.y == pytest.approx(expected.lookup("odom", "base", 1_500_000_000).y, abs=1e-12)
        assert abs(found.y) > 0.01


def test_an_unknown_interpolation_is_refused(domain_id):
    with pytest.raises(ValueError, match="interpolation must be 'decoupled' or 'screw', not 'slerp'"):
        coframe.connect("one", domain=domain_id, interpolation="slerp")
