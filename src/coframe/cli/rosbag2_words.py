# SPDX-License-Identifier: Apache-2.0
"""The options of ``ros2 bag`` that have another name or form in coframe.

``ros2 bag record`` and its relatives have dozens of options. Each is either an option of coframe's command, translated
to one here, without effect because coframe does by itself what it is for, or refused with the reason.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from coframe.cli.declaration import Command
from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Mapping

    import click

__all__ = ["BAG_WORDS", "PLAY_WORDS", "RECORD_WORDS", "Rosbag2Command", "Rosbag2Words", "remove_formats"]

_FORMATS = ("mcap", "sqlite3")
_QOS = "coframe uses the QoS of the publishers, and of the recording."
_STORAGE_FILE = "coframe has no settings for storage plug-ins; --compression selects the compression of MCAP files."


class Rosbag2Words(NamedTuple):
    """The options of a command of ``ros2 bag``.

    Attributes:
        new_names: Options with another name in coframe.
        list_options: Options of coframe's command that take all words up to the next option in rosbag2. If the command
            has the argument BAG, this only applies when the recording comes first or is the value of --input, because
            it could be the last of the words otherwise.
        zero_is_none: Renamed options whose value 0 means that there is no limit.
        ignored_options: Options without effect, with the number of their values.
        unsupported: Options that coframe does not support, with the alternative.
    """

    new_names: Mapping[str, str] = MappingProxyType({})
    list_options: frozenset[str] = frozenset()
    has_bag: bool = True
    zero_is_none: frozenset[str] = frozenset()
    ignored_options: Mapping[str, int] = MappingProxyType({})
    unsupported: Mapping[str, str] = MappingProxyType({})

    def translate(self, args: list[str]) -> list[str]:
        """Translate the command line to coframe's options, or end the command if an option is not supported."""
        words: list[str] = []
        repeated = ""  # the option that takes the words up to the next option
        skipped = 0
        is_bag_known = not self.has_bag or "-i" in args or "--input" in args or not "".join(args[:1]).startswith("-")
        for position, word in enumerate(args):
            if word == "--":
                return [*words, *args[position:]]
            if skipped:
                skipped -= 1
                continue
            name, equals, value = word.partition("=")
            name = self.new_names.get(name, name)
            if not word.startswith("-") or _is_number(word):
                words += [repeated, word] if repeated and words[-1:] != [repeated] else [word]
                continue
            repeated = ""
            if name in self.unsupported:
                fail(f"{name} does not exist in coframe", self.unsupported[name], code=2)
            if name in self.ignored_options:
                skipped = 0 if equals else self.ignored_options[name]
                continue
            if name in self.zero_is_none and (value or "".join(args[position + 1 : position + 2])) == "0":
                skipped = 0 if equals else 1
                continue
            words.append(f"{name}={value}" if equals else name)
            repeated = name if name in self.list_options and is_bag_known and not equals else ""
        return words


class Rosbag2Command(Command):
    """A command that also accepts the options of rosbag2.

    Attributes:
        rosbag2: The options.
    """

    rosbag2 = Rosbag2Words()

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Translate the options of rosbag2, then parse as usual."""
        return super().parse_args(ctx, self.rosbag2.translate(args))


def remove_formats(args: list[str]) -> list[str]:
    """Return the words without the formats that may follow recordings: ``-i run sqlite3`` is ``-i run``."""
    return [
        word for i, word in enumerate(args) if not (word in _FORMATS and args[i - 2 : i - 1] in (["-i"], ["--input"]))
    ]


def _is_number(word: str) -> bool:
    try:
        return float(word) is not None
    except ValueError:
        return False


_COMMON_UNSUPPORTED: dict[str, str] = {
    "--qos-profile-overrides-path": _QOS,
    "--storage-config-file": _STORAGE_FILE,
}
RECORD_WORDS = Rosbag2Words(
    new_names={
        "--max-bag-size": "--max-size",
        "-b": "--max-size",
        "--max-bag-duration": "--max-duration",
        "-d": "--max-duration",
        "--exclude-regex": "--exclude",
        "-s": "--storage",
        "--max-cache-size": "--backlog",
        "-p": "--polling-interval",
        "-f": "--serialization-format",
    },
    list_options=frozenset(
        {"--topics", "--topic-types", "--services", "--exclude-topics", "--exclude-topic-types", "--exclude-services"}
    ),
    has_bag=False,
    zero_is_none=frozenset({"--max-size", "--max-duration", "--backlog"}),
    ignored_options={
        "--polling-interval": 1,  # Discovery is not polled.
        "--include-unpublished-topics": 0,  # Topics are recorded as soon as they have a publisher.
        "--repeat-transient-local": 0,  # Each file begins with the latched messages.
        "--repeat-all-transient-local": 0,
        "--disable-keyboard-controls": 0,
        "--compression-queue-size": 1,
        "--compression-threads": 1,
        "--compression-threads-priority": 1,
        "--max-cache-duration": 1,
        "--log-level": 1,
    },
    unsupported={
        **_COMMON_UNSUPPORTED,
        "--snapshot-mode": "Record with --max-duration and keep the newest files.",
        "--start-paused": "Start the command when the recording should begin.",
        "--no-discovery": "Select topics, or exclude topics with --exclude.",
        "--use-sim-time": "Messages are recorded with the system time at which they arrive; record /clock as well.",
        "--ignore-leaf-topics": "A subscription does not start a lazy publisher's work unless its topic is selected: "
        "exclude it with --exclude-topics.",
        "--node-name": "The node is named coframe_record.",
        "--custom-data": "Write it with coframe.bags.Writer, or into a file next to the recording.",
        "--max-bag-files": "Delete old files while recording, or limit the size of each with --max-size.",
        "--all-actions": "Record the topics of actions with --include-hidden-topics --regex '.*/_action/.*'.",
        "--actions": "Record the topics of an action with --regex '/NAME/_action/.*'.",
        "--exclude-actions": "Exclude the topics of an action with --exclude '/NAME/_action/.*'.",
        "--serialization-format": "Messages are recorded as they arrive, in CDR.",
        "--storage-preset-profile": _STORAGE_FILE,
    },
)
PLAY_WORDS = Rosbag2Words(
    new_names={
        "-l": "--loop",
        "-p": "--start-paused",
        "-d": "--delay",
        "--exclude-regex": "--exclude",
        "-x": "--exclude",
    },
    list_options=frozenset({"--topics", "--exclude-topics", "--remap", "-m"}),
    ignored_options={
        "--storage": 1,  # The format of a recording is detected.
        "-s": 1,
        "--read-ahead-queue-size": 1,
        "--wait-for-all-acked": 1,  # Reliable publishers keep messages until they are acknowledged.
        "--disable-loan-message": 0,
        "--log-level": 1,
        "--progress-bar-update-rate": 1,
        "--progress-bar-separation-lines": 1,
    },
    unsupported={
        **_COMMON_UNSUPPORTED,
        "--clock-topics": "--clock HZ publishes /clock at a fixed rate.",
        "--clock-topics-all": "--clock HZ publishes /clock at a fixed rate.",
        "--services": "Requests of recorded services are not sent again: call them with coframe service call.",
        "--exclude-services": "Exclude the topics of a service with --exclude '/NAME/_service_event'.",
        "--publish-service-requests": "Send requests with coframe service call.",
        "--service-requests-source": "Send requests with coframe service call.",
        "--actions": "Goals of recorded actions are not sent again: send them with coframe action send_goal.",
        "--exclude-actions": "Exclude the topics of an action with --exclude '/NAME/_action/.*'.",
        "--send-actions-as-client": "Send goals with coframe action send_goal.",
        "--message-order": "Messages are replayed in the order in which they were received.",
    },
)
# The other commands, such as `bag info`: the format of a recording is detected.
BAG_WORDS = Rosbag2Words(ignored_options={"--storage": 1, "-s": 1})
