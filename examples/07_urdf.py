# SPDX-License-Identifier: Apache-2.0
"""Compute where the links of a robot are from its URDF and the positions of its joints."""

from __future__ import annotations

import numpy as np

import coframe
from coframe.robots import parse_urdf

ARM = """
<robot name="arm">
  <link name="base_link"/> <link name="upper_arm"/> <link name="forearm"/> <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/> <child link="upper_arm"/> <origin xyz="0 0 0.3"/> <axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="10" velocity="1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper_arm"/> <child link="forearm"/> <origin xyz="0.4 0 0"/> <axis xyz="0 1 0"/>
    <limit lower="0" upper="2" effort="10" velocity="1"/>
  </joint>
  <joint name="wrist" type="fixed">
    <parent link="forearm"/> <child link="tool"/> <origin xyz="0.3 0 0"/>
  </joint>
</robot>
"""


def main() -> None:
    robot = parse_urdf(ARM)
    tool = robot.frames({"shoulder": -0.5, "elbow": 1.0})["tool"]
    print(f"tool relative to {robot.root}: {tool.translation.round(3).tolist()} m")

    # A thousand configurations in one call: the workspace of the arm.
    angles = np.linspace(-1.5, 1.5, 1000)
    tools = robot.frames({"shoulder": angles, "elbow": np.full(1000, 1.0)})["tool"]
    print(f"height of the tool: {tools.translation[:, 2].min():.2f} to {tools.translation[:, 2].max():.2f} m")

    # The same transforms in a buffer, so that they combine with others.
    buffer = coframe.Buffer()
    for joint in robot.joint_transforms({"shoulder": -0.5, "elbow": 1.0}).values():
        buffer.set(joint.target, joint.source, joint, 1_000_000_000)
    print(f"chain: {' -> '.join(frame for frame in ('base_link', 'upper_arm', 'forearm', 'tool') if frame in buffer)}")
    assert np.allclose(buffer.lookup("base_link", "tool").translation, tool.translation)


if __name__ == "__main__":
    main()
