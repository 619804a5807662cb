# SPDX-License-Identifier: Apache-2.0
"""A query that kills its process, as a lack of memory would; in a module that worker processes can import."""

import os

from coframe.bags import TrajectoryQuery


class DeadlyQuery(TrajectoryQuery):
    def run(self, recording):
        if "deadly" in recording.path.name:
            os._exit(9)
        return super().run(recording)
