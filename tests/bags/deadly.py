"""What ends the process that asks it, as a lack of memory would; in a module that other processes can import."""

import os

from coframe.bags import Question


class DeadlyQuestion(Question):
    def ask(self, recording):
        if "deadly" in recording.path.name:
            os._exit(9)
        return super().ask(recording)
