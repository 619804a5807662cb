# SPDX-License-Identifier: Apache-2.0
"""A node with topics, a service, an action and parameters, which the commands find in the graph."""

import rclpy
from geometry_msgs.msg import PointStamped
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState
from std_msgs.msg import String
from std_srvs.srv import SetBool
from tf2_msgs.action import LookupTransform


class Program(Node):
    def __init__(self):
        super().__init__("program", namespace="/robot1")
        limits = [FloatingPointRange(from_value=0.5, to_value=100.0)]
        self.declare_parameter("rate", 50.0, ParameterDescriptor(description="in Hz", floating_point_range=limits))
        self.declare_parameter("arm.joints", ["a", "b"])
        self.add_on_set_parameters_callback(self.check)
        self.chatter = self.create_publisher(String, "/chatter", 10)
        self.point = self.create_publisher(PointStamped, "/point", 10)
        self.create_subscription(String, "/commands", lambda message: print(message.data, flush=True), 10)
        switch = self.create_service(SetBool, "/switch", self.switch)
        switch.configure_introspection(self.get_clock(), QoSProfile(depth=10), ServiceIntrospectionState.CONTENTS)
        self.lookup = ActionServer(self, LookupTransform, "/lookup", self.execute)
        self.create_timer(0.02, self.publish)
        self.count = 0

    def check(self, parameters):
        bad = [each for each in parameters if each.name == "arm.joints" and len(each.value) != 2]
        return SetParametersResult(successful=not bad, reason="the arm has two joints" if bad else "")

    def publish(self):
        self.count += 1
        self.chatter.publish(String(data=f"hello {self.count}"))
        point = PointStamped()
        point.header.frame_id = "map"
        point.header.stamp = self.get_clock().now().to_msg()
        point.point.x = 1.5
        self.point.publish(point)

    def switch(self, request, response):
        response.success = request.data
        response.message = "on" if request.data else "off"
        return response

    def execute(self, goal):
        goal.succeed()
        result = LookupTransform.Result()
        result.transform.child_frame_id = goal.request.source_frame
        return result


rclpy.init()
node = Program()
print("ready", flush=True)
rclpy.spin(node)
