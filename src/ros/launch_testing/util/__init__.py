# SPDX-License-Identifier: Apache-2.0
"""Helpers of test descriptions and assertions."""

from launch_testing.util.keep_alive_process import KeepAliveProc
from launch_testing.util.proc_lookup import NO_CMD_ARGS, NoMatchingProcessException, resolveProcesses

__all__ = ["NO_CMD_ARGS", "KeepAliveProc", "NoMatchingProcessException", "resolveProcesses"]
