# SPDX-License-Identifier: Apache-2.0
"""What a listener receives is one value, which is checked when it is created."""

import dataclasses
from datetime import timedelta

import pytest

import coframe
from coframe.connection.listener_config import ListenerConfig
from coframe.messages import find
from coframe.wire import selection

TRANSFORM = find("geometry_msgs/msg/TransformStamped")


def test_defaults_are_those_of_the_environment(domain_id):
    assert ListenerConfig.of() == ListenerConfig(domain=domain_id, wire=selection.resolve(None))


@pytest.mark.parametrize(
    ("arguments", "topics"),
    [
        ({}, ("/tf", "/tf_static")),
        ({"namespace": "/robot1"}, ("/robot1/tf", "/robot1/tf_static")),
        ({"namespace": "robot1/"}, ("/robot1/tf", "/robot1/tf_static")),
        ({"namespace": "/"}, ("/tf", "/tf_static")),
        ({"namespace": "/robot1", "tf_static_topic": "/tf_static"}, ("/robot1/tf", "/tf_static")),
        ({"tf_topic": "/a/tf"}, ("/a/tf", "/tf_static")),
    ],
)
def test_a_namespace_stands_for_its_two_topics(arguments, topics):
    assert ListenerConfig.of(**arguments).topics == topics


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        ({"prefix": "/robot1"}, ValueError, "begins with a slash"),
        ({"keep": [1]}, TypeError, "must be strings, not 1"),
        ({"cache": timedelta(seconds=-1)}, ValueError, "cache must not be negative"),
        ({"cache": 1.5}, TypeError, "duration"),
        ({"domain": 233}, coframe.WireError, "0 to 232"),
        ({"wire": "smoke"}, coframe.WireError, "'smoke' is not a middleware"),
    ],
)
def test_invalid_values_are_refused_before_the_graph_is_joined(arguments, error, text):
    before = dict(coframe.wire.participant.Participant._instances)
    with pytest.raises(error, match=text):
        coframe.connect(**arguments)
    assert coframe.wire.participant.Participant._instances == before


def test_equal_configurations_are_one_value_that_cannot_change():
    one = ListenerConfig.of(prefix="r/", keep=["world", "/map"], cache="3s")
    assert one == ListenerConfig.of(prefix="r/", keep="map,world", cache=3_000_000_000)
    assert hash(one) == hash(ListenerConfig.of(prefix="r/", keep="map,world", cache="3s"))
    assert one != ListenerConfig.of(prefix="r/", keep="map", cache="3s")
    with pytest.raises(dataclasses.FrozenInstanceError):
        one.prefix = "s/"
    assert (one.frame("base"), one.frame("map")) == ("r/base", "map")


@pytest.mark.parametrize("cache", [None, "50us", "10s"])
def test_its_buffers_have_its_cache(cache):
    assert ListenerConfig.of(cache=cache).new_buffer().cache_ns == coframe.Buffer(cache).cache_ns


def test_a_connection_receives_the_transforms_of_a_namespace(domain_id):
    with coframe.connect("listener", namespace="/robot1", prefix="robot1/", domain=domain_id) as ros:
        message = TRANSFORM()
        message.header.frame_id, message.child_frame_id = "odom", "base"
        broadcaster = ros.participant.static_broadcaster(ros.node, "/robot1/tf_static")
        broadcaster.send([message])
        ros.buffer.wait("robot1/odom", "robot1/base", timeout="20s")
