# SPDX-License-Identifier: Apache-2.0
"""Event handlers of test descriptions."""

from launch_testing.event_handlers.stdout_ready_listener import StdoutReadyListener

__all__ = ["StdoutReadyListener"]
