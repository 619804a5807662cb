# SPDX-License-Identifier: Apache-2.0
"""Extension 4, 10 points: a monitor that reports transforms that stopped, and frames with two parents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course.criteria.common import Task, run_program
from coframe.course.rubric import RUBRIC
from coframe.time import SECOND
from coframe.transform.transform import Transform
from std_msgs.msg import String

if TYPE_CHECKING:
    from coframe.course._world import Received

__all__ = ["check"]

_TOPIC = "/tf_problems"
_READ = "handbook chapter 10, finding errors"


def check(task: Task) -> Sheet:
    """Check ``tf_monitor.py``."""
    sheet = Sheet.of(RUBRIC["monitor"])
    world = task.world
    robot = SimulatedRobot(task.assignment)
    period = round(SECOND / task.assignment.dynamic_rate)

    def publish(now: int, *, arm: bool = True, second_parent: bool = False) -> None:
        if now % period == 0:
            world.publish_transforms([robot.base(now), *(robot.arm_at(now) if arm else [])], now)
            if second_parent:
                world.publish_transforms([Transform(target="map", source="base_link")], now)

    with run_program(task, sheet) as program:
        problems = world.watch(_TOPIC, String)
        if program is not None:
            world.start(program)
            world.run(3.0, publish)
        healthy = len(problems)
        if program is not None:
            world.run(3.0, lambda now: publish(now, arm=False))
        stale = problems[healthy:]
        if program is not None:
            world.run(3.0, lambda now: publish(now, second_parent=True))
        reparented = problems[healthy + len(stale) :]
        is_alive = program is not None and program.is_running()
        sheet.check(
            3,
            "the node publishes nothing if there is no problem",
            is_alive and not healthy and bool(problems),
            expected=f"no message on {_TOPIC} until there is a problem",
            observed=f"{healthy} messages" if healthy else "no message, even when there is a problem",
            read=_READ,
        )
        sheet.check(
            4,
            "the node reports a transform that stopped",
            _names(stale, "end_effector") or _names(stale, "link1"),
            expected="a message with link1, link2 or end_effector within 3 s",
            observed=_quote_messages(stale),
            read=_READ,
        )
        sheet.check(
            3,
            "the node reports a frame with two parents",
            _names(reparented, "base_link"),
            expected="a message with base_link within 3 s",
            observed=_quote_messages(reparented),
            read=_READ,
        )
    return sheet


def _names(messages: list[Received], frame: str) -> bool:
    return any(frame in each.message.data for each in messages)


def _quote_messages(messages: list[Received]) -> str:
    return f"{messages[-1].message.data[:80]!r}" if messages else "no message"
