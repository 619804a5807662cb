# SPDX-License-Identifier: Apache-2.0
"""Events of processes."""

from launch.events.process.process_io import ProcessIO, ProcessStderr, ProcessStdin, ProcessStdout
from launch.events.process.process_matchers import (
    for_all_processes,
    matches_executable,
    matches_name,
    matches_pid,
)
from launch.events.process.process_targeted_event import (
    ProcessTargetedEvent,
    ShutdownProcess,
    SignalProcess,
)
from launch.events.process.running_process_event import ProcessExited, ProcessStarted, RunningProcessEvent

__all__ = [
    "ProcessExited",
    "ProcessIO",
    "ProcessStarted",
    "ProcessStderr",
    "ProcessStdin",
    "ProcessStdout",
    "ProcessTargetedEvent",
    "RunningProcessEvent",
    "ShutdownProcess",
    "SignalProcess",
    "for_all_processes",
    "matches_executable",
    "matches_name",
    "matches_pid",
]
