"""Recordings without ROS: rosbag2 (MCAP, SQLite) and bags of ROS 1."""

from coframe.bags.recording import RecordedMessage, Recording, Topic, open_bag
from coframe.errors import RecordingError

__all__ = ["RecordedMessage", "Recording", "RecordingError", "Topic", "open_bag"]
