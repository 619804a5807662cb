# SPDX-License-Identifier: Apache-2.0
"""Reads recordings completely with little memory, and prints their problems: ``python hostile.py FILE...``."""

import contextlib
import json
import sys
import time

import coframe
from coframe.bags import from_yaml
from coframe.doctor import diagnose, observe_recording

_MAX_MEMORY = 2 << 30  # bytes of addresses; the libraries take about half of it


def examine(path):
    """Do with a recording what `bag info`, `doctor` and `bag fix` do; return its problems."""
    with coframe.open_bag(path) as recording:
        for channel in recording.channels():
            from_yaml(channel.offered_qos)
        for topic in recording.topics:
            recording.stamps(topic)
            for message in recording.messages(topic):
                with contextlib.suppress(coframe.DecodeError):
                    _ = message.message
        for observation in observe_recording(path).values():
            diagnose(observation)
        return recording.problems


if __name__ == "__main__":
    with contextlib.suppress(ModuleNotFoundError):  # on Windows
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (_MAX_MEMORY, _MAX_MEMORY))
    for path in sys.argv[1:]:
        started = time.process_time()  # the machine may be busy
        try:
            problems = examine(path)
        except Exception as error:  # noqa: BLE001 - any one is printed
            problems = [f"{type(error).__name__}: {error}"]
        print(json.dumps([problems, time.process_time() - started]), flush=True)
