# SPDX-License-Identifier: Apache-2.0
"""The metadata.yaml of a folder of rosbag2: it lists files and topics, and may be missing."""

from __future__ import annotations

import errno
from contextlib import closing
from typing import TYPE_CHECKING, Any, Final

from coframe._files.bounded_yaml import read_yaml
from coframe._files.regular_files import UnsuitableFileError, read_regular
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import Source
from coframe.bags.formats import METADATA
from coframe.bags.storage import Channel

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems

__all__ = ["listed_files", "listed_topics", "read_metadata", "word"]

_MAX_METADATA_BYTES: Final = 16 << 20


def read_metadata(file: Readable, problems: Problems) -> dict[str, Any]:
    """Return the contents of metadata.yaml; empty if it is missing or damaged, because it is not required."""
    found: dict[str, Any] = {}
    try:
        text = _content(file)
        found = dict(read_yaml(text, _MAX_METADATA_BYTES)["rosbag2_bagfile_information"])
    except FileNotFoundError:
        pass
    except RemoteFileError as error:
        if error.errno != errno.ENOENT:
            raise
    except UnsuitableFileError as error:
        problems.add(f"{METADATA} cannot be read: {error.strerror}; the files were read without it")
    except ModuleNotFoundError:
        problems.add(f"{METADATA} was not read: the package PyYAML is not installed")
    except (ValueError, TypeError, KeyError) as error:
        reason = " ".join(str(error).split())[:200]
        problems.add(f"{METADATA} is damaged ({reason}); the files were read without it")
    return found


def word(metadata: dict[str, Any], key: str) -> str:
    """Return a string value, or "" for another type."""
    value = metadata.get(key)
    return value if isinstance(value, str) else ""


def listed_topics(metadata: dict[str, Any]) -> Iterator[Channel]:
    """Yield the topics in the metadata, which also lists those without messages."""
    entries = metadata.get("topics_with_message_count")
    for entry in entries if isinstance(entries, list) else []:
        topic = entry.get("topic_metadata") if isinstance(entry, dict) else None
        if isinstance(topic, dict) and isinstance(topic.get("name"), str) and isinstance(topic.get("type"), str):
            offered = topic.get("offered_qos_profiles")
            yield Channel(
                topic["name"],
                topic["type"],
                word(topic, "serialization_format") or "cdr",
                offered_qos=offered if isinstance(offered, str) else "",
            )


def listed_files(metadata: dict[str, Any]) -> list[str]:
    """Return the names of the files in the metadata, in their order."""
    names = metadata.get("relative_file_paths")
    return [name for name in names if isinstance(name, str) and name] if isinstance(names, list) else []


def _content(file: Readable) -> bytes:
    if not isinstance(file, Source):
        return read_regular(file, _MAX_METADATA_BYTES)
    with closing(file):
        if file.size > _MAX_METADATA_BYTES:
            raise ValueError(f"it is larger than the maximum of {_MAX_METADATA_BYTES >> 20} MiB")
        return file.read(0, file.size)
