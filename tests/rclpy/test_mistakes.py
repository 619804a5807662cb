"""The mistakes that everybody makes once: each is met by a sentence that helps."""

import pytest

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.duration import Duration
from rclpy.exceptions import NoTypeSupportImportedException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_srvs.srv import Trigger


def test_a_forgotten_super_init():
    class Forgetful(Node):
        def __init__(self):
            self.timer = self.create_timer(1.0, print)

    class Logging(Forgetful):
        def __init__(self):
            self.get_logger()

    for kind in (Forgetful, Logging):
        with pytest.raises(AttributeError, match=r"its __init__ must call super\(\).__init__"):
            kind()


def test_an_attribute_that_a_node_has_not(node):
    with pytest.raises(AttributeError, match="'Node' object has no attribute 'create_subscripton'"):
        node.create_subscripton()
    assert not hasattr(node, "timer")


def test_a_callback_that_was_called_instead_of_given(node):
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_timer(1.0, print())
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_subscription(PoseStamped, "/pose", print(), 10)
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_service(Trigger, "trigger", print())


def test_a_message_where_its_class_is_wanted(node):
    with pytest.raises(NoTypeSupportImportedException, match="the class PoseStamped, got an object of it"):
        node.create_publisher(PoseStamped(), "/pose", 10)


@pytest.mark.parametrize("kind", [Duration, Time])
def test_a_number_that_is_still_text(kind):
    with pytest.raises(TypeError, match="got the text '1'"):
        kind(seconds="1")
    with pytest.raises(TypeError, match="got the text '1'"):
        kind(nanoseconds="1")


@pytest.mark.usefixtures("domain_id")
def test_spinning_a_node_of_before_the_shutdown():
    rclpy.init(args=[])
    node = rclpy.create_node("old")
    rclpy.shutdown()
    rclpy.init(args=[])
    try:
        with SingleThreadedExecutor() as executor, pytest.raises(RuntimeError, match=r"has ended with rclpy.shutdown"):
            executor.add_node(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()
