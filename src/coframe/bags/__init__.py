# SPDX-License-Identifier: Apache-2.0
"""Recordings without ROS: rosbag2 (MCAP, SQLite) and bags of ROS 1."""

from coframe.bags.bag_repair import RepairReport, repair
from coframe.bags.batch import QueryResult, query_recording, query_recordings
from coframe.bags.cloud_files import CLOUD_FORMATS, write_clouds
from coframe.bags.clouds import Cloud, Clouds
from coframe.bags.mcap_writer import COMPRESSIONS
from coframe.bags.offered_qos import OfferedQos, from_yaml
from coframe.bags.recording import RecordedMessage, Recording, Topic, open_bag
from coframe.bags.summary import EdgeSummary, SensorSummary, Summary, TreeSummary, summarize
from coframe.bags.time_points import parse_time_point
from coframe.bags.trajectory_query import TrajectoryQuery
from coframe.bags.writer import Writer
from coframe.errors import RecordingError
from coframe.trajectories import FORMATS, format_of, write_trajectory

__all__ = [
    "CLOUD_FORMATS",
    "COMPRESSIONS",
    "FORMATS",
    "Cloud",
    "Clouds",
    "EdgeSummary",
    "OfferedQos",
    "QueryResult",
    "RecordedMessage",
    "Recording",
    "RecordingError",
    "RepairReport",
    "SensorSummary",
    "Summary",
    "Topic",
    "TrajectoryQuery",
    "TreeSummary",
    "Writer",
    "format_of",
    "from_yaml",
    "open_bag",
    "parse_time_point",
    "query_recording",
    "query_recordings",
    "repair",
    "summarize",
    "write_clouds",
    "write_trajectory",
]


def __dir__() -> list[str]:
    return sorted(__all__)
