# SPDX-License-Identifier: Apache-2.0
"""Player: replays recordings on the graph."""

from __future__ import annotations

import threading
import weakref
from typing import TYPE_CHECKING

from coframe.errors import RecordingError, WireError
from coframe.recorder import play as start_playing
from rosbag2_py._options import StorageOptions
from rosbag2_py._transport_options import PlayOptions

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.recorder import Player as RunningPlayer

__all__ = ["Player"]

_DISCOVERY = 0.5  # seconds before the first message, without which subscriptions in other processes would miss it
_PERIOD = "0.05s"  # between two checks for cancellation
_running: weakref.WeakSet[Player] = weakref.WeakSet()


class Player:
    """Replays recordings, in either of upstream's two forms. Errors are RuntimeError, as upstream's.

    Until Kilted, ``Player().play(storage_options, play_options)`` returns at the end of the replay. In Lyrical,
    ``Player(storage_options, play_options)`` has methods that control the replay, and ``play()`` returns at once.

    Args:
        storage_options: The recording, or a list of recordings.
        play_options: How it is replayed.
        log_level: Not used.
        node_name: Not used.
    """

    def __init__(
        self,
        storage_options: StorageOptions | Sequence[StorageOptions] | str | None = None,
        play_options: PlayOptions | None = None,
        log_level: str = "info",
        node_name: str = "rosbag2_player",
    ) -> None:
        del log_level, node_name
        # Jazzy's only argument is the level of the log.
        self.__storage = None if isinstance(storage_options, str) else storage_options
        self.__options = play_options or PlayOptions()
        self.__player: RunningPlayer | None = None
        self.__cancelled = threading.Event()
        _running.add(self)

    def play(
        self,
        storage_options: StorageOptions | Sequence[StorageOptions] | None = None,
        play_options: PlayOptions | None = None,
    ) -> None:
        """Start the replay of the constructor's recording, or replay a recording to its end."""
        if storage_options is None:
            self.__opened()
            if not self.__options.start_paused:
                self.resume()
            return
        with self.__start(storage_options, play_options or PlayOptions()) as player:
            self.__wait(player)

    def burst(self, storage_options: StorageOptions, play_options: PlayOptions, num_messages: int) -> None:
        """Publish messages without pauses.

        Args:
            storage_options: The recording.
            play_options: How it is replayed.
            num_messages: The number of messages, or 0 for all.
        """
        with self.__start(storage_options, play_options, paused=True) as player:
            player.step(num_messages or sum(topic.messages for topic in player.recording.topics.values()))
            while player.clock.steps and not (player.wait(_PERIOD) or self.__cancelled.is_set()):
                pass

    def start_spin(self) -> None:
        """Open the recording. The threads of coframe run without an executor."""
        self.__opened()

    def stop_spin(self) -> None:
        """Stop the replay."""
        self.stop()

    def stop(self) -> None:
        """Stop the replay and close the recording."""
        player, self.__player = self.__player, None
        if player is not None:
            player.close()

    def pause(self) -> None:
        """Pause the replay."""
        self.__opened().pause()

    def resume(self) -> None:
        """Continue the replay."""
        self.__opened().resume()

    def toggle_paused(self) -> None:
        """Pause the replay, or continue it."""
        self.resume() if self.is_paused() else self.pause()

    def is_paused(self) -> bool:
        """Return whether the replay is paused."""
        return self.__opened().clock.paused

    def get_rate(self) -> float:
        """Return the rate in recorded seconds per real second."""
        return self.__opened().clock.rate

    def set_rate(self, rate: float) -> bool:
        """Set the rate, or False if it is not above 0 and at most 1000."""
        try:
            self.__opened().set_rate(rate)
        except ValueError:
            return False
        return True

    def play_next(self) -> bool:
        """Publish the next message of a paused replay, or False if there is none, or if it is not paused."""
        player = self.__opened()
        if not player.clock.paused:
            return False
        before = player.played
        player.step()
        while player.played == before:
            if player.wait(_PERIOD):
                return player.played > before
        return True

    def seek(self, time_point: float) -> None:
        """Continue at a receive time in nanoseconds."""
        self.__opened().seek(int(time_point))

    def get_starting_time(self) -> int:
        """Return the receive time of the first message in nanoseconds."""
        return self.__opened().recording.received_start

    def get_playback_duration(self) -> int:
        """Return the duration of the recording in nanoseconds."""
        return self.__opened().recording.duration

    def wait_for_playback_to_start(self, timeout: float = -1.0) -> bool:
        """Wait until the first message is published. A negative timeout means no limit."""
        return self.__opened().wait_for_start(_timedelta(timeout))

    def wait_for_playback_to_finish(self, timeout: float = -1.0) -> bool:
        """Wait until the replay ends. A negative timeout means no limit."""
        return self.__opened().wait(_timedelta(timeout))

    wait_for_playback_to_start_exclusively = wait_for_playback_to_start
    wait_for_playback_to_finish_exclusively = wait_for_playback_to_finish

    @staticmethod
    def cancel() -> None:
        """End the replays of this process."""
        for player in list(_running):
            player.__cancelled.set()  # noqa: SLF001 - of the same class

    def __opened(self) -> RunningPlayer:
        if self.__player is None:
            if self.__storage is None:
                raise RuntimeError("The player has no recording: give StorageOptions to its constructor.")
            self.__player = self.__start(self.__storage, self.__options, paused=True)
        return self.__player

    def __start(
        self, storage: StorageOptions | Sequence[StorageOptions], options: PlayOptions, *, paused: bool | None = None
    ) -> RunningPlayer:
        self.__cancelled.clear()
        paths = [each.uri for each in ([storage] if isinstance(storage, StorageOptions) else storage)]
        until = options.playback_until_timestamp
        try:
            return start_playing(
                paths,
                topics=options.topics_to_filter or None,
                regex=options.regex_to_filter or options.topics_regex_to_filter or None,
                exclude=options.exclude_regex_to_filter or options.topics_regex_to_exclude or None,
                exclude_topics=options.exclude_topics_to_filter,
                remap=_remappings(options.topic_remapping_options),
                rate=options.rate,
                loop=options.loop,
                start_offset=int(options.start_offset * 1e9),
                duration=int(options.playback_duration * 1e9) if options.playback_duration >= 0 else None,
                end=until if until >= 0 else None,
                paused=options.start_paused if paused is None else paused,
                clock=options.clock_publish_frequency or None,
                delay=int((options.delay or _DISCOVERY) * 1e9),
            )
        except (RecordingError, WireError, ValueError) as error:
            raise RuntimeError(str(error)) from error

    def __wait(self, player: RunningPlayer) -> None:
        while not (player.wait(_PERIOD) or self.__cancelled.is_set()):
            pass


def _timedelta(seconds: float) -> int | None:
    return None if seconds < 0 else int(seconds * 1e9)


def _remappings(words: list[str]) -> dict[str, str]:
    """Return the remappings in words such as ``--ros-args --remap /a:=/b``."""
    return {old: new for old, sign, new in (word.partition(":=") for word in words) if sign}
