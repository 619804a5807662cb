# SPDX-License-Identifier: Apache-2.0
"""The state of one client: fixed frame, time, displays and joints."""

from __future__ import annotations

import contextlib
import dataclasses
import itertools
from typing import TYPE_CHECKING

from coframe._output.formatting import error_text
from coframe.errors import ViewerError, WireError
from coframe.viewer._failures import report_failure
from coframe.viewer._state import FRAME_TIMEOUT
from coframe.viewer.clients._panels import ClientPanels
from coframe.viewer.clients._playback_clock import PlaybackClock
from coframe.viewer.clients._scripting import SentRecords
from coframe.viewer.displays.display import Display
from coframe.viewer.displays.resources import Resources
from coframe.viewer.displays.rows import row_of
from coframe.viewer.protocol.requests import BadRequestError
from coframe.viewer.protocol.schema import shorten
from coframe.viewer.sources.requested_quality import RequestedQuality

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.viewer._state import ViewerState
    from coframe.viewer._uploads import Upload
    from coframe.viewer.displays import Options
    from coframe.viewer.robots.joints import JointPublisher

__all__ = ["MAX_FRAME_RATE", "ClientState", "Subscription"]

# Frame updates per second: RViz's default, and the maximum.
FRAME_RATE, MAX_FRAME_RATE = 30.0, 60.0
_MAX_DISPLAYS = 100
_serial_numbers = itertools.count(1)


class Subscription:
    """A display to which the client has subscribed.

    Attributes:
        topic: The name of the topic.
        options: The drawing options.
        display: The display; None while the topic does not exist or cannot be opened.
        problem: Why the topic cannot be displayed, or "".
        resources: What the display uses besides its topic.
        missing: Other topics of the display that do not exist yet.
        serial: A number that differs between all subscriptions.
    """

    def __init__(self, topic: str, options: Options) -> None:
        self.topic = topic
        self.options = options
        self.display: Display | None = None
        self.resources = Resources(topic)
        self.missing: tuple[str, ...] = ()
        self.problem = ""
        self.serial = next(_serial_numbers)


class ClientState:
    """The state of one client.

    Args:
        viewer: The state that all clients share.

    Attributes:
        clock: The displayed time.
        frame_timeout: The number of seconds for which a frame stays visible after its last sample.
        rviz: The configuration that the client has loaded.
        requested_rate: The requested number of frame updates per second, or None for the default.
        requested_fixed: The requested fixed frame; "" selects the root of the largest tree.
        origin: The origin of the client's times, in nanoseconds.
        subscriptions: The subscribed displays by the client's id.
        panels: The contents of the panels.
        nodes: The nodes that were sent.
        widgets: The widgets that were sent.
        upload: The files that the client is sending, or None.
        starts_together: Whether several recordings of the upload begin at the same time.
    """

    def __init__(self, viewer: ViewerState) -> None:
        self.viewer = viewer
        self.clock = PlaybackClock()
        self.frame_timeout = FRAME_TIMEOUT
        self.rviz = viewer.rviz
        self.requested_rate: float | None = None if viewer.rviz is None else viewer.rviz.frame_rate
        self.requested_fixed = viewer.fixed
        self.origin = viewer.origin
        self.subscriptions: dict[int, Subscription] = {}
        self.panels = ClientPanels(viewer)
        self.nodes, self.widgets = SentRecords(), SentRecords()
        self.upload: Upload | None = None
        self.starts_together = False
        self._joints: dict[int, JointPublisher] = {}

    @property
    def frame_rate(self) -> float:
        """The maximum number of frame updates per second."""
        return min(self.requested_rate or FRAME_RATE, MAX_FRAME_RATE)

    @property
    def fixed(self) -> str:
        """The fixed frame."""
        return self.requested_fixed or self.viewer.scene.structure.largest

    @property
    def at(self) -> int:
        """The displayed time in nanoseconds; 0 is the newest."""
        return 0 if self.clock.live else self.clock.at(self.viewer.span)

    def displays(self) -> list[Display]:
        """Return the displays whose topics exist."""
        return [one.display for one in self.subscriptions.values() if one.display is not None]

    def subscribe(self, number: int, topic: str, options: Options) -> None:
        """Display a topic, replacing any display with the same id.

        Raises:
            BadRequestError: There are too many displays.
        """
        self.unsubscribe(number)
        if len(self.subscriptions) >= _MAX_DISPLAYS:
            raise BadRequestError(f"a page has at most {_MAX_DISPLAYS} displays", "Remove a display.")
        self.subscriptions[number] = Subscription(topic, options)
        self._open(number, self.subscriptions[number])

    def unsubscribe(self, number: int) -> None:
        """Remove a display, if it exists."""
        subscription = self.subscriptions.pop(number, None)
        if subscription is not None:
            self._close(subscription)

    def open_late_displays(self) -> None:
        """Open the displays whose topics did not exist until now. Those that failed are not tried again."""
        for number, subscription in self.subscriptions.items():
            if subscription.display is None and not subscription.problem:
                self._open(number, subscription)
            elif subscription.missing:
                self._open_others(subscription)

    def fail(self, subscription: Subscription, error: Exception) -> None:
        """Close a display that failed unexpectedly, until the page subscribes to it again."""
        report_failure(f"the display of {shorten(subscription.topic)} failed; the others continue", error)
        subscription.problem = f"The display failed: {type(error).__name__}: {error}"
        self._close(subscription)

    def restart(self) -> None:
        """Restart after a change of the source or the origin: close all displays, to be reopened later."""
        self.origin = self.viewer.origin
        self.panels.close()
        self.nodes, self.widgets = SentRecords(), SentRecords()
        for subscription in self.subscriptions.values():
            self._close(subscription)
            subscription.problem = ""
            subscription.serial = next(_serial_numbers)
            subscription.options = dataclasses.replace(subscription.options, origin=self.origin)

    def set_joints(self, number: int, positions: Mapping[str, float]) -> None:
        """Publish positions of a robot's joints from now on.

        Raises:
            ValueError: The robot or a joint does not exist.
            ViewerError: The source is not the ROS graph.
            WireError: The middleware cannot create the publisher.
        """
        known = self.viewer.descriptions.known.get(number)
        if known is None:
            raise ValueError(f"there is no robot with the id {number}")
        publisher = self._joints.get(number)
        if publisher is None:
            publisher = self._joints[number] = self.viewer.joint_publisher(known.robot)
        publisher.set(positions)

    def stop_joints(self, number: int) -> None:
        """Stop publishing the positions of a robot's joints."""
        publisher = self._joints.pop(number, None)
        if publisher is not None:
            publisher.close()

    def publish_joints(self) -> None:
        """Publish all joint positions that are due."""
        for publisher in self._joints.values():
            with contextlib.suppress(WireError):  # An unresponsive subscriber must not stop the client.
                publisher.publish_if_due()

    def close(self) -> None:
        """Close all displays and publishers, and cancel an upload."""
        if self.upload is not None:
            self.upload.cancel()
            self.upload = None
        self.panels.close()
        for number in list(self.subscriptions):
            self.unsubscribe(number)
        for number in list(self._joints):
            self.stop_joints(number)

    def _open(self, number: int, subscription: Subscription) -> None:
        try:
            self._open_all(number, subscription)
        except (ViewerError, WireError) as error:
            subscription.problem = error_text(error)
        except Exception as error:  # noqa: BLE001 - one failure must not stop the others
            self.fail(subscription, error)

    def _open_all(self, number: int, subscription: Subscription) -> None:
        viewer = self.viewer
        options = subscription.options
        quality = RequestedQuality(options.reliability, options.durability, options.depth)
        messages = viewer.open(subscription.topic, quality)
        if messages is None:
            return
        row = row_of(messages.type, subscription.options)
        subscription.missing = () if row is None else row.other_topics(subscription.topic, subscription.options)
        subscription.resources = Resources(
            subscription.topic, viewer.meshes.url_or_problem, connection=viewer.source.connection
        )
        subscription.display = Display(number, messages, subscription.options, subscription.resources, viewer.executor)
        self._open_others(subscription)

    def _open_others(self, subscription: Subscription) -> None:
        """Open the other topics of a display that exist by now. Without one that cannot be opened, it shows less."""
        for topic in subscription.missing:
            try:
                messages = self.viewer.open(topic)
            except (ViewerError, WireError) as error:
                report_failure(f"the display of {shorten(subscription.topic)} cannot use {shorten(topic)}", error)
                subscription.missing = tuple(other for other in subscription.missing if other != topic)
                continue
            if messages is not None:
                subscription.resources.others[topic] = messages
        subscription.missing = tuple(one for one in subscription.missing if one not in subscription.resources.others)

    def _close(self, subscription: Subscription) -> None:
        if subscription.display is not None:
            subscription.display.close()
            self.viewer.release(subscription.display.messages)
            subscription.display = None
        for messages in subscription.resources.others.values():
            self.viewer.release(messages)
        subscription.resources, subscription.missing = Resources(subscription.topic), ()
