# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of topics."""

from typing import Any

from diagnostic_updater._diagnostic_updater import CompositeDiagnosticTask, DiagnosticTaskVector
from diagnostic_updater._update_functions import (
    FrequencyStatus,
    FrequencyStatusParam,
    TimeStampStatus,
    TimeStampStatusParam,
)
from rclpy.publisher import Publisher

__all__ = ["DiagnosedPublisher", "HeaderlessTopicDiagnostic", "TopicDiagnostic"]


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """A task that checks the rate of a topic.

    Args:
        name: Name of the topic.
        diag: Updater to which the task is added.
        freq: Limits of the rate.
    """

    def __init__(self, name: str, diag: DiagnosticTaskVector, freq: FrequencyStatusParam) -> None:
        super().__init__(f"{name} topic status")
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        diag.add(self)

    def tick(self, *args: Any) -> None:
        """Count a message."""
        del args
        self.freq.tick()

    def clear_window(self) -> None:
        """Forget all messages."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """A task that checks the rate and the stamps of a topic.

    Args:
        name: Name of the topic.
        diag: Updater to which the task is added.
        freq: Limits of the rate.
        stamp: Limits of the delay of stamps.
    """

    def __init__(
        self, name: str, diag: DiagnosticTaskVector, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.stamp.clock = getattr(diag, "clock", self.stamp.clock)
        self.addTask(self.stamp)

    def tick(self, *args: Any) -> None:
        """Count a message with the stamp that is the only argument."""
        (stamp,) = args
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """A publisher of messages with headers, whose rate and stamps are checked.

    Args:
        pub: The publisher.
        diag: Updater to which the task is added.
        freq: Limits of the rate.
        stamp: Limits of the delay of stamps.
    """

    def __init__(
        self, pub: Publisher, diag: DiagnosticTaskVector, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(pub.topic_name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Publish a message and check its stamp."""
        self.tick(message.header.stamp)
        self.publisher.publish(message)
