# SPDX-License-Identifier: Apache-2.0
"""Base class of events."""

__all__ = ["Event"]


class Event:
    """Something that happened while the system was launched; event handlers react to it."""

    name = "launch.Event"
