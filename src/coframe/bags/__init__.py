"""Recordings without ROS: rosbag2 (MCAP, SQLite) and bags of ROS 1."""

from coframe.bags.batch import Answer, answer, answer_all
from coframe.bags.cloud_files import CLOUD_FORMATS, write_clouds
from coframe.bags.clouds import Cloud, Clouds
from coframe.bags.instants import parse_instant
from coframe.bags.mcap_writer import COMPRESSIONS
from coframe.bags.offered_qos import OfferedQos, from_yaml
from coframe.bags.questions import Question
from coframe.bags.recording import RecordedMessage, Recording, Topic, open_bag
from coframe.bags.repair import Mended, mend
from coframe.bags.summary import EdgeSummary, SensorSummary, Summary, TreeSummary, summarize
from coframe.bags.trajectories import FORMATS, format_of, write_trajectory
from coframe.bags.writer import Writer
from coframe.errors import RecordingError

__all__ = [
    "CLOUD_FORMATS",
    "COMPRESSIONS",
    "FORMATS",
    "Answer",
    "Cloud",
    "Clouds",
    "EdgeSummary",
    "Mended",
    "OfferedQos",
    "Question",
    "RecordedMessage",
    "Recording",
    "RecordingError",
    "SensorSummary",
    "Summary",
    "Topic",
    "TreeSummary",
    "Writer",
    "answer",
    "answer_all",
    "format_of",
    "from_yaml",
    "mend",
    "open_bag",
    "parse_instant",
    "summarize",
    "write_clouds",
    "write_trajectory",
]
