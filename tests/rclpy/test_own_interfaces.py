# SPDX-License-Identifier: Apache-2.0
"""A user's own message, service and action between two processes, without a build step."""

import textwrap
from pathlib import Path
from typing import Any

import pytest

from coframe.messages import find, packages, registry
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor

DEFINITIONS = {
    "msg/Count.msg": "uint8 LAST=3\nint64 number -1\nwstring<=8 name\nPart[<=2] parts\n",
    "msg/Part.msg": "float32[2] size\nstd_msgs/Header header\n",
    "srv/Count.srv": "Part part\n---\nfloat64 area\n",
    "action/Count.action": "int64 to\n---\nint64[] numbers\n---\nCount count\n",
}
SERVER = """
    import rclpy
    from own_msgs.action import Count as CountTo
    from own_msgs.msg import Count, Part
    from own_msgs.srv import Count as Area
    from rclpy.action import ActionServer
    from rclpy.node import Node

    class Server(Node):
        def __init__(self):
            super().__init__("server")
            self.publisher = self.create_publisher(Count, "counts", 10)
            self.create_service(Area, "area", self.area)
            self.action = ActionServer(self, CountTo, "count_to", self.count)
            self.create_timer(0.02, self.tick)

        def tick(self):
            self.publisher.publish(Count(number=Count.LAST, name="wörld", parts=[Part(size=[1.5, 2.0])]))

        def area(self, request, response):
            response.area = float(request.part.size[0] * request.part.size[1])
            return response

        def count(self, goal):
            for number in range(goal.request.to):
                goal.publish_feedback(CountTo.Feedback(count=Count(number=number)))
            goal.succeed()
            return CountTo.Result(numbers=range(goal.request.to))

    rclpy.init()
    rclpy.spin(Server())
"""


@pytest.fixture
def _definitions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    for name, text in DEFINITIONS.items():
        (tmp_path / "own_msgs" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "own_msgs" / name).write_text(text)
    monkeypatch.setenv("COFRAME_INTERFACES", str(tmp_path))
    packages.forget()
    yield
    packages.forget()
    for name in [name for name in registry.classes if name.startswith("own_msgs/")]:
        del registry.classes[name]


@pytest.mark.usefixtures("_definitions")
def test_own_types_on_the_wire(run_script: Any, make_node: Any, context: Any, wait_until: Any) -> None:
    run_script(textwrap.dedent(SERVER))
    node = make_node()
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    received: list[Any] = []
    node.create_subscription(find("own_msgs/msg/Count"), "counts", received.append, 10)
    wait_until(lambda: received, lambda: executor.spin_once(timeout_sec=0.05))
    assert (received[0].number, received[0].name, received[0].parts[0].size.tolist()) == (3, "wörld", [1.5, 2.0])

    area = find("own_msgs/srv/Count")
    client = node.create_client(area, "area")
    assert client.wait_for_service(10.0)
    answer = client.call_async(area.Request(part=find("own_msgs/msg/Part")(size=[2.0, 3.0])))
    executor.spin_until_future_complete(answer, 10.0)
    assert answer.result() == area.Response(area=6.0)

    count_to = find("own_msgs/action/Count")
    action = ActionClient(node, count_to, "count_to")
    assert action.wait_for_server(10.0)
    feedback: list[int] = []
    sent = action.send_goal_async(count_to.Goal(to=3), lambda message: feedback.append(message.feedback.count.number))
    executor.spin_until_future_complete(sent, 10.0)
    result = sent.result().get_result_async()
    executor.spin_until_future_complete(result, 10.0)
    assert result.result().result.numbers.tolist() == [0, 1, 2]
    wait_until(lambda: feedback == [0, 1, 2], lambda: executor.spin_once(timeout_sec=0.05))
    action.destroy()
