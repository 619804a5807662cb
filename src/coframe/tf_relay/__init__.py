# SPDX-License-Identifier: Apache-2.0
"""Relay of transforms: merge the trees of several robots into one topic, or split one topic by robot.

- `status`: the state of the edges and robots of a relay.
- `robots`: the robots of a relay, their topics and prefixes.
- `forwarding`: the thread that reads and writes transforms, and the function `relay`.
"""

from coframe.tf_relay.forwarding import Relay, relay
from coframe.tf_relay.status import RelayedEdge, RelayedRobot

__all__ = ["Relay", "RelayedEdge", "RelayedRobot", "relay"]
