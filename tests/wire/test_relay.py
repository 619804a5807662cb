# SPDX-License-Identifier: Apache-2.0
"""Relays between processes: the received transforms, their origin, and the warnings."""

import re

import pytest

import coframe
from coframe.messages import find, serialize
from coframe.wire import Participant
from coframe.wire.qos import TF, TF_STATIC_WRITER

# A robot that publishes odom and base on its own topic and a mount on its static topic until it is killed.
ROBOT = """
    import sys, time
    import coframe
    from coframe.messages import find
    from coframe.wire.qos import TF, TF_STATIC_WRITER
    name, offset, kind = {name!r}, {offset!r}, find("tf2_msgs/msg/TFMessage")
    def stamped(parent, child, x):
        message = find("geometry_msgs/msg/TransformStamped")()
        message.header.frame_id, message.child_frame_id = parent, child
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(time.time_ns() + offset, 10**9)
        message.transform.translation.x, message.transform.rotation.w = x, 1.0
        return message
    participant = coframe.wire.Participant.get()
    node = participant.add_node("/" + name, "driver")
    tf = participant.publisher(node, f"/{{name}}/tf", kind, TF)
    participant.static_broadcaster(node, f"/{{name}}/tf_static").send([stamped("base", "lidar", {x})])
    print("ready", flush=True)
    while True:
        from coframe.messages import codec
        tf.write(codec.serialize(kind(transforms=[stamped("map", "odom", {x}), stamped("odom", "base", 0.0)])))
        time.sleep(0.02)
"""


@pytest.fixture
def robot(child):
    """Return a function that starts a robot in its own process."""

    def start(name, x=1.0, *, offset=0):
        process = child(ROBOT.format(name=name, x=x, offset=offset))
        assert process.read() == "ready"
        return process

    return start


@pytest.fixture
def fleet(domain_id):
    """Return a function that creates relays and connections, which are closed after the test."""
    opened = []

    def make(what, *arguments, **options):
        opened.append(what(*arguments, domain=domain_id, **options))
        return opened[-1]

    yield make
    for thing in reversed(opened):
        thing.close()


def test_two_robots_are_merged_into_one_tree(robot, fleet, eventually):
    """Late listeners receive all transforms, a stopped robot does not affect the other, clock errors are reported."""
    warnings = []
    relay = fleet(coframe.relay, "robot1,robot2", prefix_each=True, keep="map,world", warn=warnings.append)
    first, _ = robot("robot1", 1.0), robot("robot2", 2.0, offset=10**9)
    eventually(lambda: [one.state for one in relay.robots] == ["live", "live"])

    ros = fleet(coframe.connect, "late")
    for name, x in (("robot1", 2.0), ("robot2", 4.0)):
        eventually(lambda name=name: ros.buffer.can_transform("map", f"{name}/lidar"))
        assert ros.buffer.lookup("map", f"{name}/lidar").translation[0] == x
    assert "odom" not in ros.buffer

    # The name of a node can be discovered after its first messages.
    eventually(lambda: all(edge[5] == f"/{edge[3]}/driver" for edge in relay.edges()))
    edges = {edge.child: edge for edge in relay.edges()}
    assert set(edges) == {f"{name}/{frame}" for name in ("robot1", "robot2") for frame in ("odom", "base", "lidar")}
    for name in ("robot1", "robot2"):
        assert edges[f"{name}/odom"][:7] == (
            "map",
            f"{name}/odom",
            False,
            name,
            f"/{name}/tf",
            f"/{name}/driver",
            "/tf",
        )
        assert edges[f"{name}/lidar"].target == "/tf_static"
        assert not edges[f"{name}/odom"].conflicting_robot

    named = re.compile(r"robot2: the clock of /robot2/driver on /robot2/tf is (1\.0|0\.[6-9])\d s ahead")
    eventually(lambda: any(map(named.match, warnings)))
    assert not any("/robot1/driver" in text for text in warnings)

    first.kill()
    eventually(lambda: relay.robots[0].state in {"stale", "gone"})
    assert relay.robots[1].state == "live"
    at = ros.buffer.lookup("map", "robot2/base").stamp
    eventually(lambda: ros.buffer.lookup("map", "robot2/base").stamp > at)
    frames = {frame.name: frame for frame in ros.buffer.frames()}
    assert frames["robot1/base"].newest < frames["robot2/base"].newest - 10**9
    eventually(lambda: any(text.startswith(("robot1 is stale", "robot1 is gone")) for text in warnings))
    assert not any(text.startswith(("robot2 is stale", "robot2 is gone")) for text in warnings)


def test_a_common_prefix_and_a_static_topic_with_another_name(participant, node, fleet, eventually):
    common = {"common": "/fleet/tf", "common_static": "/fleet/still", "prefix": "fleet/", "keep": "map"}
    there = fleet(coframe.relay, "robot1", prefix_each=True, **common)
    back = fleet(coframe.relay, "robot2", split=True, **common)
    assert "/robot1/tf_static -> /fleet/still, adding prefix fleet/robot1/" in there.routes
    assert "/fleet/still -> /robot2/tf_static, removing prefix fleet/robot2/" in back.routes
    kind = find("tf2_msgs/msg/TFMessage")
    for topic, child in (("/robot1/tf_static", "odom"), ("/fleet/still", "fleet/robot2/odom")):
        mount = coframe.Buffer(None)
        mount.set("map", child, coframe.Transform(), static=True)
        participant.publisher(node, topic, kind, TF_STATIC_WRITER).write(mount.encode(static=True))
    for topic, frame in (("/fleet/still", "fleet/robot1/odom"), ("/robot2/tf_static", "odom")):
        ros = fleet(coframe.connect, "listener", tf_static_topic=topic)
        eventually(lambda ros=ros, frame=frame: ros.buffer.can_transform("map", frame))


def test_a_frame_that_two_robots_publish_is_reported_and_taken_from_the_first(robot, fleet, eventually):
    warnings = []
    relay = fleet(coframe.relay, ["robot1", "robot2"], warn=warnings.append)  # without prefixes
    robot("robot1", 1.0)
    ros = fleet(coframe.connect, "listener")
    eventually(lambda: ros.buffer.can_transform("map", "base"))
    robot("robot2", 2.0)
    eventually(
        lambda: (
            {edge.child for edge in relay.edges() if edge.conflicting_robot == "robot2"} >= {"odom", "base", "lidar"}
        )
    )
    eventually(lambda: any("robot1 and robot2 both publish a transform to 'odom'" in text for text in warnings))
    assert ros.buffer.lookup("map", "odom").translation[0] == 1.0


def test_what_cannot_be_relayed_is_counted_and_reported_once(participant, node, fleet, eventually):
    warnings = []
    relay = fleet(coframe.relay, "robot1", prefix_each=True, warn=warnings.append)
    kind, stamped = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
    tf = participant.raw_publisher(node, "/robot1/tf", "tf2_msgs/msg/TFMessage", TF)
    own_parent = stamped(child_frame_id="odom")
    own_parent.header.frame_id = "odom"
    message = serialize(kind(transforms=[own_parent]))

    def counted():
        tf.write(message)
        tf.write(message[:-9])
        [robot] = relay.robots
        return min(robot.not_relayed[:2]) >= 3

    eventually(counted)
    eventually(lambda: len(warnings) >= 2)
    assert sorted(warnings) == [
        "/tester on /robot1/tf publishes messages that are not valid TFMessages, which are not relayed",
        "/tester on /robot1/tf publishes transforms with invalid frame names or values, which are not relayed",
    ]
    assert re.fullmatch(r"\d+ malformed messages, \d+ invalid transforms", str(relay.robots[0].not_relayed))
    assert relay.edges() == []


def test_transforms_of_a_relay_are_not_relayed_again(robot, fleet, eventually):
    """A relay that merges and one that splits its output, which would make an endless loop."""
    warnings = []
    merge = fleet(coframe.relay, "robot1", prefix_each=True, keep="map", node_name="merge")
    split = fleet(coframe.relay, "robot1", split=True, keep="map", node_name="split", warn=warnings.append)
    robot("robot1")
    eventually(lambda: any("/merge on /tf is a relay" in text for text in warnings))
    assert split.edges() == []
    # The name of a node can be discovered after its first messages.
    eventually(lambda: {edge.node for edge in merge.edges()} == {"/robot1/driver"})


def test_split_removes_the_prefix_of_each_robot(fleet, eventually):
    with coframe.connect("talker", tf_topic="/elsewhere") as talker:
        statics = talker.participant.static_broadcaster(talker.node, "/tf_static")
        fleet(coframe.relay, "robot1,robot2", split=True, keep="map")
        from coframe.messages.conversions import to_transform_stamped

        edges = [("map", "robot1/odom", 1.0), ("robot1/odom", "robot1/base", 1.0), ("map", "robot2/odom", 5.0)]
        for parent, child, x in edges:
            statics.send([to_transform_stamped(parent, child, coframe.Transform([x, 0, 0]), 0)])
        for name, frame, x in (("robot1", "base", 2.0), ("robot2", "odom", 5.0)):
            topics = {"tf_topic": f"/{name}/tf", "tf_static_topic": f"/{name}/tf_static"}
            ros = fleet(coframe.connect, f"listener_{name}", **topics)
            eventually(lambda ros=ros, frame=frame: ros.buffer.can_transform("map", frame))
            assert ros.buffer.lookup("map", frame).translation[0] == x
            assert not any("/" in known for known in ros.buffer.frame_names())


def test_a_listener_with_a_prefix(robot, fleet, eventually):
    """The listener adds the prefix, without a relay."""
    robot("robot1", 3.0, offset=-(10**9))
    topics = {"tf_topic": "/robot1/tf", "tf_static_topic": "/robot1/tf_static"}
    ros = fleet(coframe.connect, "listener", **topics, prefix="robot1/", keep=["map"])
    eventually(lambda: ros.buffer.can_transform("map", "robot1/lidar"))
    assert sorted(ros.buffer.frame_names()) == ["map", "robot1/base", "robot1/lidar", "robot1/odom"]
    eventually(lambda: any(publisher.clock_problem() for publisher in ros.publishers()))
    [moving] = [publisher for publisher in ros.publishers() if not publisher.static]
    assert moving.node == "/robot1/driver"
    assert re.search(r"is 1\.\d\d s behind the clock of this machine", moving.clock_problem())


def test_naming_problems_are_reported_once(participant: Participant, node, eventually):
    warnings = []
    participant.on_warning(warnings.append)
    from coframe.frame_names import renaming
    from coframe.messages.conversions import to_transform_stamped

    readers = [
        participant.tf_reader(
            node, "/tf_static", coframe.Buffer(), static=True, authority=None, renaming=renaming("robot1/")
        )
        for _ in range(2)
    ]
    statics = participant.static_broadcaster(participant.add_node("/", "talker"), "/tf_static")
    for parent, child in (("/map", "odom"), ("robot1/odom", "base")):
        statics.send([to_transform_stamped(parent, child, coframe.Transform(), 0)])
    eventually(lambda: len(warnings) >= 2)
    assert [text for text in warnings if "/talker on /tf_static publishes the frame '/map'" in text]
    assert [text for text in warnings if "for only some of its frames: 'robot1/odom' and 'map'" in text]
    assert len(warnings) == len(set(warnings)) == 2
    assert all(reader.matched for reader in readers)


@pytest.mark.parametrize(
    ("arguments", "options", "text"),
    [
        ([], {}, "needs robots"),
        (["robot1"], {"common": "/robot1/tf"}, "is both an input and an output of the relay"),
        ([], {"sources": ["/tf"]}, "is both an input and an output of the relay"),
        ([], {"sources": ["/other"], "prefix_each": True}, "no namespace to use as the robot's name"),
        ([], {"sources": {"/robot1/tf": "/robot1/"}}, "begins with a slash"),
        (["robot1"], {"rate": 0.0}, "above 0 Hz"),
    ],
)
def test_invalid_arguments_of_a_relay_raise_an_error(arguments, options, text):
    with pytest.raises(ValueError, match=text):
        coframe.relay(*arguments, **options)


def test_sources_with_their_own_prefixes_and_a_rate_limit(robot, fleet, eventually):
    relay = fleet(coframe.relay, sources={"/robot1/tf": "r1_"}, keep="map", rate=10.0)
    robot("robot1")
    eventually(lambda: any(edge.skipped > 20 for edge in relay.edges()))
    edges = {edge.child: edge for edge in relay.edges()}
    assert set(edges) == {"r1_odom", "r1_base", "r1_lidar"}
    total = edges["r1_odom"].forwarded + edges["r1_odom"].skipped
    assert 0.1 < edges["r1_odom"].forwarded / total < 0.4  # 10 of 50 Hz


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_a_relay_of_ten_robots_loses_no_transforms():
    """10 robots with 20 frames each at 50 Hz, each robot in its own process, into one buffer."""
    from benchmarks.fleet import measure

    outcomes = [measure(10, 20, 50.0, 10.0) for _ in range(2)]  # the machine may be busy in one of the runs
    assert [(outcome.sent, outcome.lost) for outcome in outcomes] == [(100_000, 0)] * 2
    assert min(outcome.cpu for outcome in outcomes) < 10.0, outcomes


def test_a_relay_with_a_maximum_error_omits_what_can_be_interpolated(robot, fleet, eventually):
    """The robot stands still: it is sent every half second, and subscribers do not take it for stale."""
    relay = fleet(coframe.relay, "robot1", max_error="1mm,0.1deg")
    robot("robot1")
    ros = fleet(coframe.connect, "listener")
    eventually(lambda: ros.buffer.can_transform("map", "lidar"))
    moving = {edge.child: edge for edge in relay.edges() if not edge.static}
    eventually(lambda: min(edge.forwarded for edge in relay.edges() if not edge.static) >= moving["odom"].forwarded + 3)
    for edge in relay.edges():
        if not edge.static:
            assert edge.skipped > edge.forwarded
            stamps = edge.newest - ros.buffer.lookup("map", "base").stamp
            assert stamps < 2 * 10**9
