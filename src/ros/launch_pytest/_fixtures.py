# SPDX-License-Identifier: Apache-2.0
"""The fixtures of tests with launch fixtures: the launch service, its context and its event loop."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from launch_pytest._running_launch import RunningLaunch, launch_of

if TYPE_CHECKING:
    import asyncio

    from launch import LaunchContext, LaunchService

__all__ = ["event_loop", "launch_context", "launch_service"]


@pytest.fixture
def event_loop(request: pytest.FixtureRequest) -> asyncio.AbstractEventLoop:
    """The event loop of the launch fixture of the test."""  # noqa: D401 - a fixture is a value
    return _launch(request).loop


@pytest.fixture
def launch_service(request: pytest.FixtureRequest) -> LaunchService:
    """The launch service of the launch fixture of the test."""  # noqa: D401 - a fixture is a value
    return _launch(request).service


@pytest.fixture
def launch_context(request: pytest.FixtureRequest) -> LaunchContext:
    """The launch context of the launch fixture of the test."""  # noqa: D401 - a fixture is a value
    return _launch(request).service.context


def _launch(request: pytest.FixtureRequest) -> RunningLaunch:
    if request.node.get_closest_marker("launch") is None:
        raise pytest.UsageError(
            f"{request.node.nodeid}: the fixture {request.fixturename} needs @pytest.mark.launch(fixture=...)"
        )
    return launch_of(request.node, request)
