# SPDX-License-Identifier: Apache-2.0
"""What the nodes of a process cost each other: the number of messages about them and of calls of the middleware."""

import contextlib
from collections import Counter

import pytest

from coframe import _core
from coframe.wire.dds import topics
from coframe.wire.dds.session import DdsSession
from coframe.wire.rtps import announcer
from std_msgs.msg import String

NODES = 12


@pytest.fixture
def calls(monkeypatch):
    """Count the messages about nodes, the nodes that are serialized for them, and the topics that are created."""
    counter = Counter()

    def counted(name, function):
        def call(*arguments):
            counter[name] += 1
            return function(*arguments)

        return call

    message = announcer.NodeAnnouncer._message
    monkeypatch.setattr(announcer.NodeAnnouncer, "_message", counted("messages", message))
    monkeypatch.setattr(announcer, "encode_node", counted("nodes", announcer.encode_node))
    created = counted("topics", topics._core.create_unchecked_topic)
    monkeypatch.setattr(topics, "_core", _Core(created))
    return counter


class _Core:
    """The native module with another function that creates topics."""

    EndpointError = _core.EndpointError

    def __init__(self, create_unchecked_topic):
        self.create_unchecked_topic = create_unchecked_topic


def taken(calls):
    """Return what was counted since the last call."""
    counted = dict(calls)
    calls.clear()
    return counted


@pytest.fixture
def make_whole_node(context):
    """Return a function that creates nodes with all services."""
    import rclpy

    with contextlib.ExitStack() as stack:
        yield lambda name: stack.enter_context(rclpy.create_node(name, context=context))


@pytest.mark.cyclone_only("Fast DDS has topics of its own, and Zenoh announces each endpoint by itself")
def test_a_node_is_announced_once_however_many_there_are(make_whole_node, calls):
    first = make_whole_node("first")
    endpoints = len(first._Coframe__graph_node.endpoints)
    assert taken(calls).keys() >= {"messages", "topics"}
    for number in range(NODES):
        make_whole_node(f"node_{number}")
        assert taken(calls) == {"messages": 1, "nodes": 1, "topics": endpoints}


@pytest.mark.cyclone_only("Zenoh announces each endpoint by itself")
def test_an_endpoint_is_one_message_about_one_node(make_whole_node, calls):
    nodes = [make_whole_node(f"node_{number}") for number in range(NODES)]
    calls.clear()
    publisher = nodes[3].create_publisher(String, "words", 1)
    assert taken(calls) == {"messages": 1, "nodes": 1, "topics": 1}
    nodes[3].destroy_publisher(publisher)
    assert taken(calls) == {"messages": 1, "nodes": 1}


@pytest.mark.cyclone_only("Zenoh announces each endpoint by itself")
def test_a_node_leaves_with_one_message(make_whole_node, calls):
    nodes = [make_whole_node(f"node_{number}") for number in range(NODES)]
    calls.clear()
    nodes[3].destroy_node()
    assert taken(calls) == {"messages": 1}
    names = nodes[0].get_node_names()
    assert "node_3" not in names
    assert len(names) == NODES - 1


@pytest.mark.cyclone_only("joins with a participant of Cyclone DDS")
def test_others_see_a_node_with_all_its_endpoints_from_the_start(make_whole_node, domain_id, wait_until):
    nodes = [make_whole_node("node_0")]  # before the other one, because the first participant ends last
    other = DdsSession(domain_id, _core.Event())
    try:
        nodes += [make_whole_node(f"node_{number}") for number in range(1, NODES)]
        seen = {}

        def look():
            other.graph.refresh()
            for infos in other.graph._nodes.values():
                for info in infos:
                    seen.setdefault(info.name, info)

        wait_until(lambda: look() or len(seen) == NODES)
    finally:
        other.close()
    for node in nodes:
        own, first = node._Coframe__graph_node.info(), seen[node.get_name()]
        assert len(own.readers + own.writers) > 10
        assert first == own


def test_a_node_that_cannot_be_created_is_never_announced(context, make_node):
    import rclpy
    from rclpy.parameter import Parameter

    watcher = make_node("watcher")
    with pytest.raises(Exception, match="use_sim_time"):
        rclpy.create_node("broken", context=context, parameter_overrides=[Parameter("use_sim_time", value="often")])
    assert watcher.get_node_names() == ["watcher"]
