# SPDX-License-Identifier: Apache-2.0
"""Warnings about messages that could not be passed on. Fast DDS itself drops what is too short off the network."""

import itertools

from coframe_fastdds._ignored import IgnoredMessages

import coframe
from coframe.messages import find

STRING = find("std_msgs/msg/String")


def test_a_topic_is_reported_at_most_every_ten_seconds() -> None:
    warnings: list[str] = []
    now = itertools.count(100.0, 4.0)
    ignored = IgnoredMessages(warnings.append, lambda: next(now))
    for count in (3, 5, 7, 1):
        ignored.add([("rt/news", count)])
    assert [warning.split(":")[0] for warning in warnings] == [
        "Ignored 3 messages of /news",
        "Ignored 13 messages of /news",
    ]


def test_nothing_is_ignored_where_all_messages_arrive(domain_id: int, eventually) -> None:
    with coframe.connect("both", domain=domain_id, wire="fastdds") as ros:
        received = ros.subscribe("/news", STRING)
        publisher = ros.publisher("/news", STRING)
        eventually(lambda: publisher.publish(STRING(data="")) or received.receive("0.05s"))
        assert ros.participant._session.native.take_ignored() == []
