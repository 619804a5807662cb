# SPDX-License-Identifier: Apache-2.0
"""Type checking of user programs with mypy."""

import subprocess
import sys
import textwrap

import pytest

pytest.importorskip("mypy", reason="the type checker")

PROGRAM = """
    import rclpy
    from example_interfaces.srv import AddTwoInts
    from geometry_msgs.msg import PointStamped
    from rclpy.duration import Duration
    from rclpy.node import Node
    from rclpy.time import Time
    from nav2_msgs.action import NavigateToPose
    from shape_msgs.msg import SolidPrimitive
    from std_srvs.srv import SetBool
    from tf2_geometry_msgs import do_transform_point
    from tf2_ros import Buffer, TransformException, TransformListener

    class Program(Node):
        def __init__(self) -> None:
            super().__init__("program")
            self.buffer = Buffer()
            self.listener = TransformListener(self.buffer, self)
            self.create_service(SetBool, "switch", self.switch)

        def switch(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
            response.success = request.data
            response.message = request.data  # wrong
            return response

        def shipped_as_data(self) -> int:
            goal = NavigateToPose.Goal(behavior_tree="tree.xml")  # wrong
            goal.pose.header.frame_id = 1  # wrong
            cylinder = SolidPrimitive(type=SolidPrimitive.CYLINDER, dimensions=[1.0, 2.0])
            cylinder.dimensions[0] = "high"  # wrong
            return AddTwoInts.Request(a=1, b=2).a

        def look(self) -> PointStamped:
            transform = self.buffer.lookup_transform("a", "b", Time(), timeout=Duration(seconds=0.1))
            transform.transform.tranlation.x = 1.0  # wrong
            self.buffer.lookup_transform("a", "b", 0)  # wrong
            self.serch()  # wrong
            return do_transform_point(PointStamped(), transform)
"""


@pytest.mark.slow
def test_mypy_finds_only_the_errors(tmp_path):
    source = textwrap.dedent(PROGRAM).strip()
    (tmp_path / "program.py").write_text(source)
    wrong = [number for number, line in enumerate(source.splitlines(), 1) if line.endswith("# wrong")]
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "program.py"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=110, check=False)
    found = [int(line.split(":")[1]) for line in result.stdout.splitlines() if ": error:" in line]
    assert found == wrong, result.stdout + result.stderr
