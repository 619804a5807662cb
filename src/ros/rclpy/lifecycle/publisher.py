# SPDX-License-Identifier: Apache-2.0
"""Publishers of lifecycle nodes."""

from __future__ import annotations

from functools import partial
from typing import Any

from rclpy import _absent
from rclpy.lifecycle.managed_entity import SimpleManagedEntity
from rclpy.publisher import Publisher


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Publisher that publishes only while its node is active. Create it with `create_lifecycle_publisher`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    @SimpleManagedEntity.when_enabled
    def publish(self, msg: Any) -> None:
        """Publish a message. Do nothing unless the node is active."""
        Publisher.publish(self, msg)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
