"""Between the wire and recordings: `record` writes down what is said on the graph, `play` says it again.

It stands on `bags`, which knows files only, and on `wire`, which knows the graph only.
"""

from coframe.recorder.player import FASTEST, Player, play
from coframe.recorder.recorder import Recorder, RecorderStatistics, record

__all__ = ["FASTEST", "Player", "Recorder", "RecorderStatistics", "play", "record"]
