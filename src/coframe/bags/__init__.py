# SPDX-License-Identifier: Apache-2.0
"""Recordings without ROS: rosbag2 (MCAP, SQLite) and ROS 1 bags."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coframe.bags._bag_repair import RepairReport, repair
    from coframe.bags._cloud_files import CLOUD_FORMATS, write_clouds
    from coframe.bags._clouds import Cloud, Clouds
    from coframe.bags._mcap_writer import COMPRESSIONS
    from coframe.bags._offered_qos import OfferedQos, from_yaml
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.bags._writer import Writer
    from coframe.bags.batch import Omission, QueryResult, query_recording, query_recordings
    from coframe.bags.copying import CopyReport, copy_recordings
    from coframe.bags.editing import EditReport, Recipe, edit
    from coframe.bags.recording import RecordedMessage, RecordedTopic, Recording, open_bag
    from coframe.bags.summary import EdgeSummary, SensorSummary, Summary, TreeSummary, summarize
    from coframe.bags.tables import Column, Table, TableQuery, write_table
    from coframe.bags.time_points import parse_time_point
    from coframe.errors import RecordingError
    from coframe.trajectories import FORMATS, format_of, write_trajectory

__all__ = [
    "CLOUD_FORMATS",
    "COMPRESSIONS",
    "FORMATS",
    "Cloud",
    "Clouds",
    "Column",
    "CopyReport",
    "EdgeSummary",
    "EditReport",
    "OfferedQos",
    "Omission",
    "QueryResult",
    "Recipe",
    "RecordedMessage",
    "RecordedTopic",
    "Recording",
    "RecordingError",
    "RecordingFormat",
    "RepairReport",
    "SensorSummary",
    "Summary",
    "Table",
    "TableQuery",
    "TrajectoryQuery",
    "TreeSummary",
    "Writer",
    "copy_recordings",
    "edit",
    "format_of",
    "from_yaml",
    "open_bag",
    "parse_time_point",
    "query_recording",
    "query_recordings",
    "repair",
    "summarize",
    "write_clouds",
    "write_table",
    "write_trajectory",
]

# Names are imported on first use: completions and help texts need the suffixes in `formats`, without NumPy.
_MODULES = {
    "CLOUD_FORMATS": "coframe.bags._cloud_files",
    "COMPRESSIONS": "coframe.bags._mcap_writer",
    "Cloud": "coframe.bags._clouds",
    "Clouds": "coframe.bags._clouds",
    "Column": "coframe.bags.tables",
    "CopyReport": "coframe.bags.copying",
    "EdgeSummary": "coframe.bags.summary",
    "EditReport": "coframe.bags.editing",
    "FORMATS": "coframe.trajectories",
    "OfferedQos": "coframe.bags._offered_qos",
    "Omission": "coframe.bags.batch",
    "QueryResult": "coframe.bags.batch",
    "Recipe": "coframe.bags.editing",
    "RecordedMessage": "coframe.bags.recording",
    "Recording": "coframe.bags.recording",
    "RecordingError": "coframe.errors",
    "RecordingFormat": "coframe.bags._recording_format",
    "RepairReport": "coframe.bags._bag_repair",
    "SensorSummary": "coframe.bags.summary",
    "Summary": "coframe.bags.summary",
    "RecordedTopic": "coframe.bags.recording",
    "Table": "coframe.bags.tables",
    "TableQuery": "coframe.bags.tables",
    "TrajectoryQuery": "coframe.bags._trajectory_query",
    "TreeSummary": "coframe.bags.summary",
    "Writer": "coframe.bags._writer",
    "copy_recordings": "coframe.bags.copying",
    "edit": "coframe.bags.editing",
    "format_of": "coframe.trajectories",
    "from_yaml": "coframe.bags._offered_qos",
    "open_bag": "coframe.bags.recording",
    "parse_time_point": "coframe.bags.time_points",
    "query_recording": "coframe.bags.batch",
    "query_recordings": "coframe.bags.batch",
    "repair": "coframe.bags._bag_repair",
    "summarize": "coframe.bags.summary",
    "write_clouds": "coframe.bags._cloud_files",
    "write_table": "coframe.bags.tables",
    "write_trajectory": "coframe.trajectories",
}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = globals()[name] = getattr(importlib.import_module(_MODULES[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
