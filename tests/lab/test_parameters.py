# SPDX-License-Identifier: Apache-2.0
"""Changes of the lab nodes' parameters while they run (`ros2 param set`): they take effect or are refused."""

import pytest

from coframe.lab.complete_tf_tree import CompleteTFTree
from coframe.lab.dynamic_tf_broadcaster import DynamicFramePublisher
from coframe.lab.sensor_transform import SensorTransformNode
from coframe.lab.simulated_lidar import SimulatedLidar
from coframe.lab.static_tf_broadcaster import StaticFramePublisher
from coframe.lab.tf_listener import TransformListenerNode
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient

RATED = [DynamicFramePublisher, CompleteTFTree, SimulatedLidar, TransformListenerNode]


def test_a_new_rate_takes_effect_through_the_parameter_service(start):
    observer = start()
    node = observer.add(DynamicFramePublisher())
    client = AsyncParameterClient(observer.node, "/dynamic_tf_broadcaster")
    assert client.wait_for_services(10)

    def change(rate: float) -> tuple[bool, str]:
        future = client.set_parameters([Parameter("rate", value=rate)])
        observer.until(future.done)
        [result] = future.result().results
        return result.successful, result.reason

    assert change(200.0) == (True, "")
    assert node.timer.timer_period_ns == 5_000_000
    assert change(-3.0) == (False, "the rate must be greater than 0 Hz")
    assert node.get_parameter("rate").value == 200.0
    dynamic, _ = observer.hear_tf()

    def faster_than_before() -> bool:
        """Whether more than 40 messages arrive in half a second; at 50 Hz there would be 25."""
        before = len(dynamic)
        observer.spin_for(0.5)
        return len(dynamic) - before > 40

    observer.until(faster_than_before)  # A busy machine needs several attempts.


@pytest.mark.parametrize("node_class", [*RATED, SensorTransformNode, StaticFramePublisher])
def test_every_parameter_is_changed_or_refused_with_a_reason(start, node_class):
    node = start().add(node_class())
    assert node.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
    for name, parameter in node.get_parameters_by_prefix("").items():
        if name in ("use_sim_time", "start_type_description_service"):
            continue
        [result] = node.set_parameters([parameter])
        assert result.successful == (name == "rate")
        assert result.successful or "restart the node" in result.reason
