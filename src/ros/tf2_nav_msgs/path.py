"""Transformation of paths."""

import tf2_ros
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Path
from std_msgs.msg import Header
from tf2_geometry_msgs import do_transform_pose


def do_transform_path(path: Path, transform: TransformStamped) -> Path:
    """Transform a path at the time of its header. The result has the header of the transform.

    All poses are transformed by the same transform. Each pose keeps the stamp of its header, which is the planned time
    of the pose, and gets the new frame.

    Raises:
        InvalidArgumentException: The frame of a pose differs from that of the path.
    """
    frame = path.header.frame_id
    result = Path(header=transform.header)
    for number, pose in enumerate(path.poses):
        if pose.header.frame_id not in {"", frame}:
            raise tf2_ros.InvalidArgumentException(
                f"Pose {number} of the path is expressed in frame {pose.header.frame_id!r}, but the path in frame "
                f"{frame!r}. Transform the poses one by one with Buffer.transform()."
            )
    result.poses = [
        PoseStamped(
            header=Header(stamp=pose.header.stamp, frame_id=transform.header.frame_id),
            pose=do_transform_pose(pose.pose, transform),
        )
        for pose in path.poses
    ]
    return result


tf2_ros.TransformRegistration().add(Path, do_transform_path)
