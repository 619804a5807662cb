# SPDX-License-Identifier: Apache-2.0
"""Record topics to a bag, and replay a bag.

It connects `bags`, which reads and writes files, with `wire`, which communicates with the graph.
"""

from coframe.recorder._player import MAX_RATE, Player, play
from coframe.recorder._topic_filter import TopicFilter
from coframe.recorder.recorder import Recorder, RecorderStatistics, record

__all__ = ["MAX_RATE", "Player", "Recorder", "RecorderStatistics", "TopicFilter", "play", "record"]


def __dir__() -> list[str]:
    return sorted(__all__)
