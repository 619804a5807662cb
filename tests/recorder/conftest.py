# SPDX-License-Identifier: Apache-2.0
"""A participant that publishes and subscribes next to the recorder or the player."""

from collections.abc import Iterator

import pytest

pytest.importorskip("dds_library", reason="recording and replay need DDS")

from coframe.wire import GraphNode, Participant


@pytest.fixture
def participant(domain_id: int) -> Iterator[Participant]:
    joined = Participant.get(domain_id)
    yield joined
    joined.close()


@pytest.fixture
def node(participant: Participant) -> GraphNode:
    return participant.add_node("/", "tester")
