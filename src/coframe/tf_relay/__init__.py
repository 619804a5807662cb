# SPDX-License-Identifier: Apache-2.0
"""Relay transforms: merge the trees of several robots into one topic, or split one topic by robot.

- `status`: the state of the edges and robots of a relay.
- `max_error`: the maximum error of thinned transforms.
- `robots`: the robots of a relay, their topics and prefixes.
- `forwarding`: the thread that reads and writes transforms.
- `starting`: the function `relay`.
"""

from coframe.tf_relay._forwarding import Relay
from coframe.tf_relay._max_error import MaxError
from coframe.tf_relay._status import NotRelayed, RelayedEdge, RelayedRobot
from coframe.tf_relay.starting import relay

__all__ = ["MaxError", "NotRelayed", "Relay", "RelayedEdge", "RelayedRobot", "relay"]
