# SPDX-License-Identifier: Apache-2.0
"""Nodes for the tests of packages that scripts import."""

import time
from collections.abc import Callable, Iterator

import pytest

import rclpy
from rclpy.context import Context
from rclpy.node import Node


@pytest.fixture
def make_node(domain_id: int) -> Iterator[Callable[..., Node]]:
    """Return a function that creates nodes in a DDS domain that no other test uses."""
    context = Context()
    context.init([], domain_id=domain_id)
    nodes: list[Node] = []

    def make(name: str = "tester", **options) -> Node:
        nodes.append(rclpy.create_node(name, context=context, start_parameter_services=False, **options))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


@pytest.fixture
def node(make_node: Callable[..., Node]) -> Node:
    """Return a node."""
    return make_node()


@pytest.fixture
def wait_until() -> Callable[..., None]:
    """Return a function that waits for a condition and calls `meanwhile` in the meantime."""

    def wait(
        condition: Callable[[], object],
        meanwhile: Callable[[], object] = lambda: time.sleep(0.005),
        timeout: float = 10.0,
    ) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, "the condition did not come true in time"
            meanwhile()

    return wait
