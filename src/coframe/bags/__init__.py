"""Recordings without ROS: rosbag2 (MCAP, SQLite) and bags of ROS 1."""

from coframe.bags.instants import parse_instant
from coframe.bags.mcap_writer import COMPRESSIONS
from coframe.bags.mending import Mended, mend
from coframe.bags.offered_qos import OfferedQos, from_yaml
from coframe.bags.recording import RecordedMessage, Recording, Topic, open_bag
from coframe.bags.summary import EdgeSummary, SensorSummary, Summary, TreeSummary, summarize
from coframe.bags.trajectories import FORMATS, format_of, write_trajectory
from coframe.bags.writer import Writer
from coframe.errors import RecordingError

__all__ = [
    "COMPRESSIONS",
    "FORMATS",
    "EdgeSummary",
    "Mended",
    "OfferedQos",
    "RecordedMessage",
    "Recording",
    "RecordingError",
    "SensorSummary",
    "Summary",
    "Topic",
    "TreeSummary",
    "Writer",
    "format_of",
    "from_yaml",
    "mend",
    "open_bag",
    "parse_instant",
    "summarize",
    "write_trajectory",
]
