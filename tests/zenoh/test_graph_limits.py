# SPDX-License-Identifier: Apache-2.0
"""The graph from Zenoh's tokens has limits, which a process that announces anything cannot exceed."""

import pytest

from coframe.errors import WireError
from coframe.messages import find
from coframe.wire import Participant, QoS
from coframe.wire.zenoh import _graph as graph
from coframe.wire.zenoh import _token_limits as token_limits

STRING = find("std_msgs/msg/String")


def topics(participant):
    return {name for name in participant.topics() if name.startswith(("/many", "/own"))}


def test_more_endpoints_than_the_limit_are_not_listed_and_this_is_said_once(
    participant, node, ros_peer, eventually, monkeypatch, caplog
):
    monkeypatch.setattr(token_limits, "MAX_TOKENS", 100)
    ros_peer("announce_many", "/many", 150)
    eventually(lambda: len(topics(participant)) > 90)
    ros_peer("announce_nodes", 20)
    publisher = participant.publisher(node, "/own", STRING, QoS())
    eventually(lambda: "/own" in topics(participant))  # those of this process are always listed
    assert 90 < len(topics(participant)) <= 101
    warnings = [record.getMessage() for record in caplog.records if "are on the graph" in record.getMessage()]
    assert len(warnings) == 1
    assert warnings[0].startswith("More than 100 nodes and endpoints, or 64 MiB of their names, are on the graph.")
    ros_peer("leave")
    eventually(lambda: topics(participant) == {"/own"})
    ros_peer("announce_many", "/many_new", 5)
    eventually(lambda: len(topics(participant)) == 6)  # there is room again
    publisher.close()


def test_the_names_of_all_tokens_have_a_limit(participant, ros_peer, eventually, monkeypatch, caplog):
    monkeypatch.setattr(token_limits, "MAX_TOKEN_BYTES", 20_000)
    ros_peer("announce_many", "/many", 100, 200)
    eventually(lambda: topics(participant) and "are on the graph" in caplog.text)
    assert 30 < len(topics(participant)) < 20_000 / 200
    ros_peer("leave")
    eventually(lambda: not topics(participant))


def test_a_long_name_is_not_listed_and_this_is_said_once(participant, ros_peer, eventually, caplog):
    ros_peer("announce_many", "/many_long", 3, 300)
    ros_peer("announce_many", "/many", 1)
    eventually(lambda: topics(participant) == {"/many0_"})
    (warning,) = [record.getMessage() for record in caplog.records if "not valid" in record.getMessage()]
    assert "contains too long a name: @ros2_lv/" in warning
    assert len(warning) < 400


def test_a_process_joins_a_graph_with_more_tokens_than_the_queue_holds(zenoh_domain, ros_peer, eventually, monkeypatch):
    monkeypatch.setattr(graph, "_MAX_QUEUED", 100)
    ros_peer("announce_many", "/many", 1000)
    participant = Participant.get(zenoh_domain)
    eventually(lambda: len(topics(participant)) >= 50)
    participant.close()


def test_tokens_are_processed_in_a_process_that_never_asks_for_the_graph(
    participant, ros_peer, eventually, monkeypatch
):
    monkeypatch.setattr(graph, "_MAX_PENDING", 50)
    ros_peer("announce_many", "/many", 1000)
    eventually(lambda: len(participant._graph.by_topic(writers=True)) >= 950)
    assert len(participant._graph._pending) < 100
    ros_peer("leave")
    eventually(lambda: not topics(participant))


@pytest.mark.parametrize(
    ("topic", "ros_type"),
    [("/" + "x" * 70_000, "std_msgs/msg/String"), ("/x", "std_msgs/msg/" + "X" * 70_000)],
)
def test_names_that_would_end_the_process_are_errors(participant, node, topic, ros_type):
    """Zenoh aborts when it declares a key of 64 KiB."""
    for create in (participant.raw_publisher, participant.raw_subscription):
        with pytest.raises(WireError, match=r"has 70\d\d\d bytes\. The limit is 256 bytes"):
            create(node, topic, ros_type, QoS())


@pytest.mark.parametrize(
    ("topic", "reason"),
    [("/*", r"contains '\*'"), ("/a/$*", "contains"), ("/a#", "contains"), ("/\udcff", "not valid UTF-8")],
)
def test_names_that_zenoh_cannot_announce_are_errors(participant, node, topic, reason):
    for create in (participant.raw_publisher, participant.raw_subscription):
        with pytest.raises(WireError, match=reason):
            create(node, topic, "std_msgs/msg/String", QoS())
