# SPDX-License-Identifier: Apache-2.0
"""Buffer: stores transforms over time and answers "what is the pose of frame A relative to frame B at time t?".

`buffer` has the class, and `many_lookups` its lookups at many times. `storing` checks stored values, `waiting` waits
for transforms, and `edge_info` describes frames and edges.
"""

from coframe.buffer._waiting import CallbackHandle
from coframe.buffer.buffer import Buffer
from coframe.buffer.edge_info import EdgeInfo, FrameInfo

__all__ = ["Buffer", "CallbackHandle", "EdgeInfo", "FrameInfo"]
