# SPDX-License-Identifier: Apache-2.0
"""BasicNavigator: a node that sends Nav2's goals and waits for their results."""

from __future__ import annotations

import time
from enum import Enum
from typing import TYPE_CHECKING, Any

import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
from nav2_msgs.action import (
    AssistedTeleop,
    BackUp,
    ComputePathThroughPoses,
    ComputePathToPose,
    FollowPath,
    FollowWaypoints,
    NavigateThroughPoses,
    NavigateToPose,
    SmoothPath,
    Spin,
)
from nav2_msgs.srv import ClearEntireCostmap, GetCostmap, LoadMap, ManageLifecycleNodes
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["BasicNavigator", "TaskResult"]

_PERIOD = 0.1  # seconds that isTaskComplete waits


class TaskResult(Enum):
    """How a task has ended."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


_RESULTS = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
}


class BasicNavigator(Node):
    """Sends goals to Nav2. Names and defaults are the same as in Nav2.

    Args:
        node_name: Name of the node.
        namespace: Namespace of the node and of Nav2.
    """

    def __init__(self, node_name: str = "basic_navigator", namespace: str = "") -> None:
        super().__init__(node_name=node_name, namespace=namespace)
        self.initial_pose = PoseStamped()
        self.initial_pose.header.frame_id = "map"
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        self.initial_pose_received = False
        self.nav_through_poses_client = ActionClient(self, NavigateThroughPoses, "navigate_through_poses")
        self.nav_to_pose_client = ActionClient(self, NavigateToPose, "navigate_to_pose")
        self.follow_waypoints_client = ActionClient(self, FollowWaypoints, "follow_waypoints")
        self.follow_path_client = ActionClient(self, FollowPath, "follow_path")
        self.compute_path_to_pose_client = ActionClient(self, ComputePathToPose, "compute_path_to_pose")
        self.compute_path_through_poses_client = ActionClient(
            self, ComputePathThroughPoses, "compute_path_through_poses"
        )
        self.smoother_client = ActionClient(self, SmoothPath, "smooth_path")
        self.spin_client = ActionClient(self, Spin, "spin")
        self.backup_client = ActionClient(self, BackUp, "backup")
        self.assisted_teleop_client = ActionClient(self, AssistedTeleop, "assisted_teleop")
        latched = QoSProfile(
            durability=QoSDurabilityPolicy.TRANSIENT_LOCAL,
            reliability=QoSReliabilityPolicy.RELIABLE,
            history=QoSHistoryPolicy.KEEP_LAST,
            depth=1,
        )
        self.localization_pose_sub = self.create_subscription(
            PoseWithCovarianceStamped, "amcl_pose", self._on_localization, latched
        )
        self.initial_pose_pub = self.create_publisher(PoseWithCovarianceStamped, "initialpose", 10)
        self.change_maps_srv = self.create_client(LoadMap, "map_server/load_map")
        self.clear_costmap_global_srv = self.create_client(
            ClearEntireCostmap, "global_costmap/clear_entirely_global_costmap"
        )
        self.clear_costmap_local_srv = self.create_client(
            ClearEntireCostmap, "local_costmap/clear_entirely_local_costmap"
        )
        self.get_costmap_global_srv = self.create_client(GetCostmap, "global_costmap/get_costmap")
        self.get_costmap_local_srv = self.create_client(GetCostmap, "local_costmap/get_costmap")

    def destroyNode(self) -> None:
        """Destroy the node."""
        self.destroy_node()

    def setInitialPose(self, initial_pose: PoseStamped) -> None:
        """Publish the initial pose of the localization."""
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._setInitialPose()

    def goThroughPoses(self, poses: list[PoseStamped], behavior_tree: str = "") -> bool:
        """Send the goal to drive through poses, and return whether it was accepted."""
        goal = NavigateThroughPoses.Goal(poses=poses, behavior_tree=behavior_tree)
        self.info(f"Navigating with {len(poses)} goals....")
        return self._send(self.nav_through_poses_client, goal, f"Goal with {len(poses)} poses was rejected!")

    def goToPose(self, pose: PoseStamped, behavior_tree: str = "") -> bool:
        """Send the goal to drive to a pose, and return whether it was accepted."""
        where = f"{pose.pose.position.x} {pose.pose.position.y}"
        self.info(f"Navigating to goal: {where}...")
        goal = NavigateToPose.Goal(pose=pose, behavior_tree=behavior_tree)
        return self._send(self.nav_to_pose_client, goal, f"Goal to {where} was rejected!")

    def followWaypoints(self, poses: list[PoseStamped]) -> bool:
        """Send the goal to stop at each of some poses, and return whether it was accepted."""
        self.info(f"Following {len(poses)} goals....")
        goal = FollowWaypoints.Goal(poses=poses)
        return self._send(self.follow_waypoints_client, goal, f"Following {len(poses)} waypoints request was rejected!")

    def spin(self, spin_dist: float = 1.57, time_allowance: int = 10) -> bool:
        """Send the goal to turn by an angle in radians, and return whether it was accepted."""
        self.info(f"Spinning to angle {spin_dist}....")
        goal = Spin.Goal(target_yaw=float(spin_dist), time_allowance=Duration(sec=time_allowance))
        return self._send(self.spin_client, goal, "Spin request was rejected!")

    def backup(self, backup_dist: float = 0.15, backup_speed: float = 0.025, time_allowance: int = 10) -> bool:
        """Send the goal to drive backwards by a distance in meters, and return whether it was accepted."""
        self.info(f"Backing up {backup_dist} m at {backup_speed} m/s....")
        goal = BackUp.Goal(
            target=Point(x=float(backup_dist)),
            speed=float(backup_speed),
            time_allowance=Duration(sec=time_allowance),
        )
        return self._send(self.backup_client, goal, "Backup request was rejected!")

    def assistedTeleop(self, time_allowance: int = 30) -> bool:
        """Send the goal to follow commands of an operator, and return whether it was accepted."""
        self.info("Waiting for 'assisted_teleop' action server")
        goal = AssistedTeleop.Goal(time_allowance=Duration(sec=time_allowance))
        return self._send(self.assisted_teleop_client, goal, "Assisted Teleop request was rejected!")

    def followPath(self, path: Any, controller_id: str = "", goal_checker_id: str = "") -> bool:
        """Send the goal to follow a path, and return whether it was accepted."""
        self.info("Executing path...")
        goal = FollowPath.Goal(path=path, controller_id=controller_id, goal_checker_id=goal_checker_id)
        return self._send(self.follow_path_client, goal, "Follow path was rejected!")

    def cancelTask(self) -> None:
        """Cancel the current task."""
        self.info("Canceling current task.")
        if self.result_future and self.goal_handle is not None:
            rclpy.spin_until_future_complete(self, self.goal_handle.cancel_goal_async())

    def isTaskComplete(self) -> bool:
        """Wait for a tenth of a second, and return whether the current task has ended."""
        if not self.result_future:
            return True  # It was canceled, or there was none.
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=_PERIOD)
        if self.result_future.result() is None:
            return False
        self.status = self.result_future.result().status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self.debug(f"Task with failed with status code: {self.status}")
        else:
            self.debug("Task succeeded!")
        return True

    def getFeedback(self) -> Any:
        """Return the last feedback of the current task, or None if there was none."""
        return self.feedback

    def getResult(self) -> TaskResult:
        """Return how the last task has ended."""
        return _RESULTS.get(self.status, TaskResult.UNKNOWN)  # type: ignore[arg-type]

    def waitUntilNav2Active(self, navigator: str = "bt_navigator", localizer: str = "amcl") -> None:
        """Wait until the nodes of Nav2 are active and the robot is localized."""
        if localizer != "robot_localization":  # It is no lifecycle node.
            self._waitForNodeToActivate(localizer)
        if localizer == "amcl":
            self._waitForInitialPose()
        self._waitForNodeToActivate(navigator)
        self.info("Nav2 is ready for use!")

    def getPath(self, start: PoseStamped, goal: PoseStamped, planner_id: str = "", use_start: bool = False) -> Any:
        """Return a path to a pose, or None if there is none."""
        request = ComputePathToPose.Goal(start=start, goal=goal, planner_id=planner_id, use_start=use_start)
        result = self._result(self.compute_path_to_pose_client, request, "Get path was rejected!", "Getting path")
        return None if result is None else result.path

    def getPathThroughPoses(
        self, start: PoseStamped, goals: list[PoseStamped], planner_id: str = "", use_start: bool = False
    ) -> Any:
        """Return a path through poses, or None if there is none."""
        request = ComputePathThroughPoses.Goal(start=start, goals=goals, planner_id=planner_id, use_start=use_start)
        client = self.compute_path_through_poses_client
        result = self._result(client, request, "Get path was rejected!", "Getting path")
        return None if result is None else result.path

    def smoothPath(
        self, path: Any, smoother_id: str = "", max_duration: float = 2.0, check_for_collision: bool = False
    ) -> Any:
        """Return a smoothed path, or None if that fails."""
        request = SmoothPath.Goal(path=path, smoother_id=smoother_id, check_for_collisions=check_for_collision)
        request.max_smoothing_duration = rclpy.duration.Duration(seconds=max_duration).to_msg()
        result = self._result(self.smoother_client, request, "Smooth path was rejected!", "Smoothing path")
        return None if result is None else result.path

    def changeMap(self, map_filepath: str) -> bool:
        """Load another map, and return whether that succeeded."""
        response = self._call(self.change_maps_srv, LoadMap.Request(map_url=map_filepath), "change map")
        if response.result != LoadMap.Response.RESULT_SUCCESS:
            self.error("Change map request failed!")
            return False
        self.info("Change map request was successful!")
        return True

    def clearAllCostmaps(self) -> None:
        """Clear both costmaps."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:
        """Clear the local costmap."""
        self._call(self.clear_costmap_local_srv, ClearEntireCostmap.Request(), "clear local costmaps")

    def clearGlobalCostmap(self) -> None:
        """Clear the global costmap."""
        self._call(self.clear_costmap_global_srv, ClearEntireCostmap.Request(), "clear global costmaps")

    def getGlobalCostmap(self) -> Any:
        """Return the global costmap."""
        return self._call(self.get_costmap_global_srv, GetCostmap.Request(), "get global costmaps").map

    def getLocalCostmap(self) -> Any:
        """Return the local costmap."""
        return self._call(self.get_costmap_local_srv, GetCostmap.Request(), "get local costmaps").map

    def lifecycleStartup(self) -> None:
        """Start the nodes of Nav2."""
        self._manage(ManageLifecycleNodes.Request.STARTUP)

    def lifecycleShutdown(self) -> None:
        """Shut the nodes of Nav2 down."""
        self._manage(ManageLifecycleNodes.Request.SHUTDOWN)

    def info(self, msg: str) -> None:
        """Log a message."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Log a warning."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Log an error."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Log a message for debugging."""
        self.get_logger().debug(msg)

    def _send(self, client: ActionClient, goal: Any, rejected: str) -> bool:
        """Send the goal of a task; `isTaskComplete` waits for its end."""
        self.feedback = None
        handle = self._send_goal(client, goal, self._feedbackCallback)
        self.goal_handle = handle
        if not handle.accepted:
            self.error(rejected)
            return False
        self.result_future = handle.get_result_async()
        return True

    def _result(self, client: ActionClient, goal: Any, rejected: str, what: str) -> Any:
        """Send a goal and return its result, or None if it failed."""
        handle = self._send_goal(client, goal, None)
        self.goal_handle = handle
        if not handle.accepted:
            self.error(rejected)
            return None
        self.result_future = handle.get_result_async()
        rclpy.spin_until_future_complete(self, self.result_future)
        self.status = self.result_future.result().status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self.warn(f"{what} failed with status code: {self.status}")
            return None
        return self.result_future.result().result

    def _send_goal(self, client: ActionClient, goal: Any, feedback: Any) -> Any:
        self.debug("Waiting for an action server")
        while not client.wait_for_server(timeout_sec=1.0):
            self.info(f"'{client._action_name.lstrip('/')}' action server not available, waiting...")  # noqa: SLF001
        sent = client.send_goal_async(goal, feedback)
        rclpy.spin_until_future_complete(self, sent)
        return sent.result()

    def _call(self, client: Any, request: Any, what: str) -> Any:
        while not client.wait_for_service(timeout_sec=1.0):
            self.info(f"{what} service not available, waiting...")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def _manage(self, command: int) -> None:
        """Send a command to all lifecycle managers."""
        for name in self._managers():
            client = self.create_client(ManageLifecycleNodes, name)
            self._call(client, ManageLifecycleNodes.Request(command=command), name)
            self.destroy_client(client)

    def _managers(self) -> Iterable[str]:
        kind = "nav2_msgs/srv/ManageLifecycleNodes"
        return [name for name, types in self.get_service_names_and_types() if kind in types]

    def _waitForNodeToActivate(self, node_name: str) -> None:
        client = self.create_client(GetState, f"{node_name}/get_state")
        state = "unknown"
        while state != "active":
            state = self._call(client, GetState.Request(), f"{node_name}/get_state").current_state.label
            if state != "active":
                time.sleep(2.0)
        self.destroy_client(client)

    def _waitForInitialPose(self) -> None:
        while not self.initial_pose_received:
            self.info("Setting initial pose")
            self._setInitialPose()
            self.info("Waiting for amcl_pose to be received")
            rclpy.spin_once(self, timeout_sec=1.0)

    def _setInitialPose(self) -> None:
        message = PoseWithCovarianceStamped()
        message.pose.pose = self.initial_pose.pose
        message.header = self.initial_pose.header
        self.info("Publishing Initial Pose")
        self.initial_pose_pub.publish(message)

    def _on_localization(self, _message: Any) -> None:
        self.debug("Received amcl pose")
        self.initial_pose_received = True

    def _feedbackCallback(self, message: Any) -> None:
        self.feedback = message.feedback
