# SPDX-License-Identifier: Apache-2.0
"""A robot arm from its URDF, and the points that its tool can reach.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe
from coframe.robots import parse_urdf

ARM = """
<robot name="arm">
  <link name="base_link"/> <link name="upper_arm"/> <link name="forearm"/> <link name="tool"/>
  <joint name="turn" type="continuous">
    <parent link="base_link"/> <child link="upper_arm"/> <origin xyz="0 0 0.3"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper_arm"/> <child link="forearm"/> <origin xyz="0.4 0 0"/> <axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="10" velocity="1"/>
  </joint>
  <joint name="wrist" type="fixed"> <parent link="forearm"/> <child link="tool"/> <origin xyz="0.3 0 0"/> </joint>
</robot>
"""


def show_scene() -> coframe.viewer.Viewer:
    """Show the frames of the arm in one position, and its workspace as a cloud."""
    robot = parse_urdf(ARM)
    buffer = coframe.Buffer()
    for joint in robot.joint_transforms({"turn": 0.5, "elbow": -0.8}).values():
        buffer.set(joint.target, joint.source, joint, static=True)
    viewer = coframe.show(buffer, fixed="base_link")
    turn, elbow = (axis.ravel() for axis in np.meshgrid(np.linspace(-np.pi, np.pi, 90), np.linspace(-1.5, 1.5, 40)))
    reached = robot.frames({"turn": turn, "elbow": elbow})["tool"].translation
    viewer.scene.add_points("workspace", reached, color="#30a46c", point_size=0.012)
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
