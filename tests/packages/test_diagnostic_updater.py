# SPDX-License-Identifier: Apache-2.0
"""diagnostic_updater: statuses of tasks, and what another node receives on /diagnostics."""

import pytest

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater import (
    CompositeDiagnosticTask,
    DiagnosedPublisher,
    DiagnosticStatusWrapper,
    DiagnosticTask,
    DiagnosticTaskVector,
    FrequencyStatus,
    FrequencyStatusParam,
    FunctionDiagnosticTask,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
    TopicDiagnostic,
    Updater,
)
from geometry_msgs.msg import PointStamped
from rclpy.time import Time

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class SteppedClock:
    """A clock that stands still until it is set."""

    def __init__(self):
        self.seconds = 0.0

    def now(self):
        return Time(seconds=self.seconds)


def values(status):
    return {entry.key: entry.value for entry in status.values}


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ((OK, ""), (OK, "fine"), (OK, "fine")),
        ((OK, "a"), (OK, "b"), (OK, "a; b")),
        ((OK, "a"), (WARN, "b"), (WARN, "b")),
        ((ERROR, "a"), (OK, "b"), (ERROR, "a")),
        ((WARN, "a"), (ERROR, "b"), (ERROR, "a; b")),
        ((ERROR, "a"), (WARN, "b"), (ERROR, "a; b")),
    ],
)
def test_summaries_are_merged(first, second, expected):
    status = DiagnosticStatusWrapper()
    status.summary(*first)
    other = DiagnosticStatusWrapper()
    other.summary(*second)
    status.mergeSummary(other)
    assert (status.level, status.message) == expected
    status.clearSummary()
    assert (status.level, status.message) == (OK, "")


def test_tasks_are_combined():
    def warn(status):
        status.summary(WARN, "hot")
        status.add("temperature", 80)
        return status

    composite = CompositeDiagnosticTask("motor")
    composite.addTask(FunctionDiagnosticTask("heat", warn))
    composite.addTask(Heartbeat())
    status = composite.run(DiagnosticStatusWrapper())
    assert (status.level, status.message, values(status)) == (WARN, "hot", {"temperature": "80"})
    assert composite.getName() == "motor"
    with pytest.raises(NotImplementedError):
        DiagnosticTask("nothing").run(status)
    tasks = DiagnosticTaskVector()
    tasks.add("heat", warn)
    tasks.add(Heartbeat())
    assert [task.name for task in tasks.tasks] == ["heat", "Heartbeat"]
    assert tasks.removeByName("heat")
    assert not tasks.removeByName("heat")


@pytest.mark.parametrize(
    ("events", "level", "message"),
    [
        (0, ERROR, "No events recorded."),
        (5, WARN, "Frequency too low."),
        (9, OK, "Desired frequency met"),
        (22, OK, "Desired frequency met"),
        (23, WARN, "Frequency too high."),
    ],
)
def test_rates(events, level, message):
    task = FrequencyStatus(FrequencyStatusParam({"min": 10.0, "max": 20.0}, tolerance=0.1, window_size=2))
    task.clock = SteppedClock()
    task.clear()
    for _ in range(events):
        task.tick()
    task.clock.seconds = 1.0
    status = task.run(DiagnosticStatusWrapper())
    assert (status.level, status.message) == (level, message)
    found = values(status)
    assert (found["Events in window"], found["Actual frequency (Hz)"]) == (str(events), f"{events:f}")
    assert (found["Minimum acceptable frequency (Hz)"], found["Maximum acceptable frequency (Hz)"]) == (
        "9.000000",
        "22.000000",
    )
    task.clock.seconds = 2.0
    assert values(task.run(DiagnosticStatusWrapper()))["Duration of window (s)"] == "2.000000"
    task.clock.seconds = 3.0
    assert task.run(DiagnosticStatusWrapper()).message == "No events recorded.", "the events have left the window"


def test_stamps():
    task = TimeStampStatus(TimeStampStatusParam(min_acceptable=-1, max_acceptable=5))
    task.clock = SteppedClock()
    task.clock.seconds = 100.0
    assert task.run(DiagnosticStatusWrapper()).message == "No data since last update."
    for stamp, level, message in (
        (99.0, OK, "Timestamps are reasonable."),
        (Time(seconds=94), ERROR, "Timestamps too far in past seen."),
        (Time(seconds=102).to_msg(), ERROR, "Timestamps too far in future seen."),
    ):
        task.tick(stamp)
        status = task.run(DiagnosticStatusWrapper())
        assert (status.level, status.message) == (level, message)
    task.tick(99.0)
    task.tick(0.0)
    status = task.run(DiagnosticStatusWrapper())
    assert status.message == "Zero timestamp seen."
    assert [values(status)[f"{kind} diagnostic update count:"] for kind in ("Late", "Early", "Zero seen")] == ["1"] * 3


def test_statuses_are_published(node, make_node, wait_until):
    received = []
    listener = make_node("listener")
    listener.create_subscription(DiagnosticArray, "/diagnostics", received.append, 10)
    updater = Updater(node, period=30.0)
    wait_until(updater.publisher.get_subscription_count)
    assert node.get_parameter("diagnostic_updater.period").value == updater.period == 30.0
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(listener)

    def next_array():
        received.clear()
        return lambda: wait_until(lambda: received, meanwhile=lambda: executor.spin_once(timeout_sec=0.1))

    wait = next_array()
    updater.add(Heartbeat())
    wait()
    assert [(s.name, s.level, s.message) for s in received[0].status] == [("tester: Heartbeat", OK, "Node starting up")]
    updater.setHardwareID("robot 7")
    publisher = DiagnosedPublisher(
        node.create_publisher(PointStamped, "points", 1),
        updater,
        FrequencyStatusParam({"min": 0.1}),
        TimeStampStatusParam(),
    )
    assert isinstance(publisher, TopicDiagnostic)
    message = PointStamped()
    message.header.stamp = node.get_clock().now().to_msg()
    publisher.publish(message)
    updater.add("silent", lambda status: status)
    wait_until(lambda: len(received) >= 3, meanwhile=lambda: executor.spin_once(timeout_sec=0.1))
    wait = next_array()
    updater.force_update()
    wait()
    heartbeat, topic, silent = received[0].status
    assert received[0].header.stamp.sec > 0
    assert (heartbeat.message, heartbeat.hardware_id) == ("Alive", "robot 7")
    assert topic.name == "tester: /points topic status"
    assert (topic.level, topic.message) == (OK, "Desired frequency met; Timestamps are reasonable.")
    assert (silent.level, silent.message) == (ERROR, "No message was set")
    wait = next_array()
    updater.broadcast(WARN, "shutting down")
    wait()
    assert {(s.level, s.message) for s in received[0].status} == {(WARN, "shutting down")}


def test_period_can_be_changed(node, wait_until):
    updater = Updater(node, period=30.0)
    runs = []
    updater.add("count", lambda status: runs.append(1) or status)
    updater.period = 0.01
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    wait_until(lambda: len(runs) > 2, meanwhile=lambda: executor.spin_once(timeout_sec=0.1))
    assert updater.period == 0.01
