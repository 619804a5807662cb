# SPDX-License-Identifier: Apache-2.0
"""bag_rewrite: copies recordings to one or more new ones, as ``ros2 bag convert`` does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES, read_yaml
from coframe._files.os_errors import explain
from coframe._files.regular_files import read_regular
from coframe.bags import open_bag
from coframe.bags.copying import copy_recordings
from coframe.errors import RecordingError
from coframe.recorder import TopicFilter
from rosbag2_py._defaults import get_default_storage_id

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosbag2_py._options import StorageOptions

__all__ = ["bag_rewrite"]

_OUTPUTS = "output_bags"
_SECOND = 1_000_000_000


def bag_rewrite(input_options: Sequence[StorageOptions], output_config_file: str) -> None:
    """Copy the messages of recordings to the recordings that a YAML file describes.

    Args:
        input_options: The recordings to read; their messages are merged by receive time.
        output_config_file: File with the list ``output_bags``. Each entry has the ``uri`` of a new folder, and options
            of `StorageOptions` and `RecordOptions` such as ``storage_id``, ``all_topics``, ``topics`` and ``regex``.

    Raises:
        RuntimeError: A file cannot be read or written, or an option is invalid.
    """
    sources = [each.uri for each in input_options]
    try:
        outputs = _outputs(output_config_file)
        topics = _topics(sources)
        for output in outputs:
            _copy(sources, topics, output)
    except (RecordingError, OSError, ValueError) as error:
        raise RuntimeError(explain(error)) from error


def _outputs(path: str) -> list[dict[str, Any]]:
    content = read_yaml(read_regular(path, MAX_BYTES))
    outputs = content.get(_OUTPUTS) if isinstance(content, dict) else None
    if not isinstance(outputs, list) or not all(isinstance(each, dict) and each.get("uri") for each in outputs):
        raise ValueError(f"{path} has no list {_OUTPUTS!r} whose entries have a 'uri'")
    return outputs


def _topics(sources: list[str]) -> dict[str, str]:
    """Return the types of all topics of recordings by name."""
    types: dict[str, str] = {}
    for source in sources:
        with open_bag(source, transforms=False) as recording:
            types.update((name, topic.type) for name, topic in recording.topics.items())
    return types


def _copy(sources: list[str], topics: dict[str, str], output: dict[str, Any]) -> None:
    everything = output.get("all_topics") or output.get("all")
    selects = TopicFilter(
        None if everything else output.get("topics") or None,
        None if everything else output.get("regex") or None,
        output.get("exclude_regex") or output.get("exclude") or None,
        types=() if everything else output.get("topic_types") or (),
        services=() if everything else output.get("all_services") is True or output.get("services") or (),
        hidden=bool(everything),
        exclude_topics=output.get("exclude_topics") or (),
        exclude_types=output.get("exclude_topic_types") or (),
        exclude_services=output.get("exclude_service_events") or (),
    )
    chosen = [name for name, ros_type in topics.items() if selects(name, ros_type)]
    is_compressed = str(output.get("compression_mode") or "none").lower() != "none"
    copy_recordings(
        sources,
        str(output["uri"]),
        topics=chosen,
        storage=output.get("storage_id") or get_default_storage_id(),
        compression=(output.get("compression_format") or "zstd") if is_compressed else "none",
        max_size=output.get("max_bagfile_size") or None,
        max_duration=int(output.get("max_bagfile_duration") or 0) * _SECOND or None,
    )
