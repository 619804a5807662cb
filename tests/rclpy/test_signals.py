# SPDX-License-Identifier: Apache-2.0
"""Ends of programs: SIGINT, SIGTERM, shutdown in other threads, and missing shutdowns."""

import os
import signal

import pytest

NODE = """
import threading, time
import rclpy
from rclpy.node import Node
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from std_msgs.msg import String
from std_srvs.srv import Trigger

rclpy.init()
node = Node("ender")
node.create_timer(0.01, lambda: None)
"""

CAREFUL = (
    NODE
    + """
print("ready")
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    print("interrupted")
finally:
    node.destroy_node()
    rclpy.shutdown()
print("end")
"""
)

CARELESS = (
    NODE
    + """
print("ready")
rclpy.spin(node)
node.destroy_node()
rclpy.shutdown()
print("end")
"""
)

BLOCKED = {
    "spin": "rclpy.spin(node)",
    "pool": "executor = MultiThreadedExecutor(); executor.add_node(node); executor.spin()",
    "spin_once": "while True: rclpy.spin_once(node)",
    "sleep_for": "node.get_clock().sleep_for(rclpy.duration.Duration(seconds=60))",
    "rate": "rate = node.create_rate(0.01); rate.sleep()",
    "wait_for_service": "node.create_client(Trigger, 'x').wait_for_service()",
    "threads": ("thread = threading.Thread(target=lambda: rclpy.spin(node)); thread.start(); time.sleep(60)"),
}


@pytest.fixture
def ready(run_script, wait_until):
    def start(text, *args):
        script = run_script(text, *args)
        wait_until(lambda: "ready" in script.output or script.process.poll() is not None, timeout=30)
        assert "ready" in script.output, script.errors
        return script

    return start


def test_sigint_raises_keyboard_interrupt(ready):
    script = ready(CAREFUL)
    script.process.send_signal(signal.SIGINT)
    assert script.end() == 0
    assert script.output.split() == ["ready", "interrupted", "end"]
    assert script.errors == ""


def test_sigterm_ends_the_spin(ready):
    script = ready(CAREFUL)
    script.process.send_signal(signal.SIGTERM)
    assert script.end() == 0
    assert script.output.split() == ["ready", "end"]
    assert script.errors == ""


def test_publishing_after_a_signal(ready):
    script = ready(
        f"{NODE}\npublisher = node.create_publisher(String, 'a', 10)\nprint('ready')\ntry:\n    rclpy.spin(node)\n"
        "except KeyboardInterrupt:\n    publisher.publish(String(data='stop'))\n    print('said')\n"
    )
    script.process.send_signal(signal.SIGINT)
    assert script.end() == 0
    assert script.output.split() == ["ready", "said"]


def test_uncaught_interrupt_prints_no_traceback(ready):
    script = ready(CARELESS)
    script.process.send_signal(signal.SIGINT)
    assert script.end() in {130, -signal.SIGINT}
    assert script.errors == ""


@pytest.mark.parametrize("statement", BLOCKED.values(), ids=BLOCKED.keys())
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM], ids=["SIGINT", "SIGTERM"])
def test_signals_end_blocking_calls_without_a_traceback(ready, statement, number):
    if "time.sleep" in statement and number == signal.SIGTERM:
        statement = statement.replace("time.sleep(60)", "thread.join()")
    script = ready(f"{NODE}\nprint('ready')\n{statement}\n")
    script.process.send_signal(number)
    script.end()
    assert script.errors == ""


def test_an_interrupt_that_python_ignores_prints_no_traceback(ready):
    script = ready(f"""{NODE}
import os, signal, weakref
ended = node.create_timer(60, lambda: None)
reference = weakref.ref(ended, lambda _: os.kill(os.getpid(), signal.SIGINT))
node.destroy_timer(ended)
del ended
print("ready")
rclpy.spin(node)
""")
    script.end()
    assert script.errors == ""


def test_an_interrupt_while_a_thread_of_a_pool_starts_ends_the_program(ready):
    script = ready(f"""{NODE}
import os, signal
start = threading.Thread.start

def interrupt(thread):
    threading.Thread.start = start
    thread.start()
    os.kill(os.getpid(), signal.SIGINT)

executor = MultiThreadedExecutor()
executor.add_node(node)
threading.Thread.start = interrupt
print("ready")
executor.spin()
""")
    assert script.end() in {130, -signal.SIGINT}
    assert script.errors == ""


def test_other_exceptions_keep_their_traceback(ready):
    script = ready(f"{NODE}\nprint('ready')\ntry:\n    rclpy.spin(node)\nexcept KeyboardInterrupt:\n    1 / 0\n")
    script.process.send_signal(signal.SIGINT)
    assert script.end() == 1
    assert "ZeroDivisionError" in script.errors


def test_interrupts_without_a_signal_keep_their_traceback(ready):
    script = ready(f"{NODE}\nprint('ready')\nraise KeyboardInterrupt\n")
    script.end()
    assert "KeyboardInterrupt" in script.errors


def test_shutdown_in_another_thread_ends_the_spin(ready):
    script = ready(
        f"{NODE}\nthreading.Timer(0.1, rclpy.shutdown).start()\nprint('ready')\nrclpy.spin(node)\nprint('end')\n"
    )
    assert script.end() == 0
    assert script.output.split() == ["ready", "end"]
    assert script.errors == ""


def test_shutdown_in_a_callback_ends_the_spin(ready):
    script = ready(f"{NODE}\nnode.create_timer(0.05, rclpy.shutdown)\nprint('ready')\nrclpy.spin(node)\nprint('end')\n")
    assert script.end() == 0
    assert script.output.split() == ["ready", "end"]


@pytest.mark.parametrize(
    "statement",
    [
        "",
        "threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()",
        "pool = MultiThreadedExecutor(); pool.add_node(node); threading.Thread(target=pool.spin, daemon=True).start()",
    ],
    ids=["idle", "spinning thread", "pool"],
)
def test_programs_without_shutdown_do_not_hang(ready, statement):
    script = ready(f"{NODE}\n{statement}\nprint('ready')\n")
    assert script.end() == 0
    assert script.errors == ""


def test_shutdown_restores_pythons_signal_handlers(ready):
    script = ready(
        "import signal, sys, rclpy\nbefore = signal.getsignal(signal.SIGINT), sys.excepthook\nrclpy.init()\n"
        "assert signal.getsignal(signal.SIGINT) is not before[0]\nrclpy.shutdown()\n"
        "assert (signal.getsignal(signal.SIGINT), sys.excepthook) == before\nprint('ready')\n"
    )
    assert script.end() == 0


def test_signal_handlers_can_be_disabled(ready):
    script = ready(
        "import signal, rclpy\nfrom rclpy.signals import SignalHandlerOptions\n"
        "before = signal.getsignal(signal.SIGINT)\n"
        "rclpy.init(signal_handler_options=SignalHandlerOptions.NO)\n"
        "assert signal.getsignal(signal.SIGINT) is before\nprint('ready')\n"
    )
    assert script.end() == 0


def test_handlers_of_the_program_are_called_as_well(ready):
    script = ready(
        "import signal, rclpy\nsignal.signal(signal.SIGINT, lambda *_: print('mine'))\nrclpy.init()\n"
        "node = rclpy.create_node('ender')\nprint('ready')\nrclpy.spin(node)\nprint('end')\n"
    )
    script.process.send_signal(signal.SIGINT)
    assert script.end() == 0
    assert script.output.split() == ["ready", "mine", "end"]


def test_command_line_reaches_the_node(ready):
    script = ready(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('a')\n"
        "print('ready', node.get_fully_qualified_name(), node.declare_parameter('x', 1).value)\n"
        "node.get_logger().debug('shown')\n",
        "--ros-args",
        "-r",
        "__node:=b",
        "-r",
        "__ns:=/c",
        "-p",
        "x:=2",
        "--log-level",
        "debug",
    )
    assert script.end() == 0
    assert script.output == "ready /c/b 2\n"
    assert "[DEBUG]" in script.errors


forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork()")
FORK = """
import contextlib, os, signal, sys, warnings
warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of what these tests are about
"""


@forks
def test_sigterm_ends_a_forked_process_and_not_its_parent(ready):
    script = ready(f"""{FORK}{NODE}
reader, writer = os.pipe()
child = os.fork()
if child == 0:
    os.write(writer, b"x")
    time.sleep(60)
os.read(reader, 1)
os.kill(child, signal.SIGTERM)
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == -signal.SIGTERM
print("ready")
with contextlib.suppress(ExternalShutdownException):
    rclpy.spin(node)
print("end")
""")
    script.process.send_signal(signal.SIGTERM)
    assert script.end() == 0
    assert script.output.split() == ["ready", "end"]


@forks
def test_a_forked_process_can_handle_signals_itself(ready):
    script = ready(f"""{FORK}
import rclpy
from rclpy.signals import SignalHandlerOptions, get_current_signal_handlers_options
rclpy.init()
child = os.fork()
if child == 0:
    assert get_current_signal_handlers_options() == SignalHandlerOptions.NO
    rclpy.shutdown()
    rclpy.init()
    assert get_current_signal_handlers_options() == SignalHandlerOptions.ALL
    os.kill(os.getpid(), signal.SIGTERM)
    os._exit(0 if not rclpy.ok() else 1)
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
assert rclpy.ok()
print("ready")
""")
    assert script.end() == 0


@forks
def test_pools_of_forked_processes_end_next_to_a_listener(ready):
    script = ready(f"""{FORK}{NODE}
import multiprocessing
from geometry_msgs.msg import TransformStamped
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener
buffer = Buffer()
listener = TransformListener(buffer, node, spin_thread=True)
broadcaster = TransformBroadcaster(node)

def publish():
    while rclpy.ok():
        message = TransformStamped(child_frame_id="base")
        message.header.frame_id, message.header.stamp = "odom", node.get_clock().now().to_msg()
        broadcaster.sendTransform([message] * 100)
        time.sleep(0.001)

def look_up(number):
    return buffer.lookup_transform("odom", "base", rclpy.time.Time()).child_frame_id

threading.Thread(target=publish, daemon=True).start()
while not buffer.can_transform("odom", "base", rclpy.time.Time()):
    time.sleep(0.01)
for _ in range(5):
    with multiprocessing.get_context("fork").Pool(4) as pool:
        assert pool.map_async(look_up, range(8), chunksize=1).get(30) == ["base"] * 8
print("ready")
os._exit(0)
""")
    assert script.end() == 0
