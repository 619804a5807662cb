# SPDX-License-Identifier: Apache-2.0
"""Functions shared by the criteria: run a program, compare poses, and measure rates."""

from __future__ import annotations

import contextlib
import subprocess
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._files.os_errors import explain
from coframe._output.formatting import error_text
from coframe.course._program import StudentProgram
from coframe.course.criteria.causes import BLOCKED_CAUSE, log_cause
from coframe.course.submitted import MISSING_FILE, check_submitted, is_submitted
from coframe.errors import CoframeError, CourseError
from coframe.robots.files import expand_xacro
from coframe.robots.xacro_process import MAX_SECONDS
from coframe.time import SECOND
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from coframe.course._confinement import Confinement
    from coframe.course._sheet import Sheet
    from coframe.course._world import Received, World
    from coframe.course.assignment import Assignment

__all__ = [
    "TOLERANCE",
    "Task",
    "difference_text",
    "expanded_xacro",
    "mean_rate",
    "norm_of",
    "read_edge",
    "read_pose",
    "run_program",
    "stamp_ns",
    "to_seconds",
    "transforms_on_tf",
]

TOLERANCE = 1e-6  # meters, and components of unit quaternions


class Task(NamedTuple):
    """The context of a criterion.

    Attributes:
        folder: The student's folder.
        assignment: The numbers of the assignment.
        world: The simulated environment.
        scratch: A folder for the output of programs.
        confinement: The restrictions of the programs.
    """

    folder: Path
    assignment: Assignment
    world: World
    scratch: Path
    confinement: Confinement


@contextlib.contextmanager
def run_program(
    task: Task, sheet: Sheet, *, outputs: Sequence[str] = (), silence_cause: Callable[[str], str] = log_cause
) -> Iterator[StudentProgram | None]:
    """Yield the program of a sheet, or None if its file does not exist; stop it after the block.

    Problems of the program are then recorded on the sheet. A program that publishes nothing, or publishes on topics
    of the simulation, gets no points for the facts added in the block.

    Args:
        task: The context of the criterion: the student's folder and the simulated world.
        sheet: The sheet; its file is the program.
        outputs: More topics on which it may publish by mistake. A single message at startup may be lost, so a program
            with a publisher there is examined even if nothing has arrived.
        silence_cause: Returns why a program publishes nothing, given its output, or "" if that is not known.
    """
    first = len(sheet.facts)
    file = task.folder / sheet.file
    if reason := _file_problem(task.folder, sheet.file):
        yield None
        task.world.stop()
        sheet.withdraw(first, reason)
        return
    world = task.world
    program = StudentProgram(file, task.scratch, task.confinement)
    silence = cause = ""
    try:
        yield program
        intruder = _intruder_reason(world)
        if not world.has_received():
            silence = _silence_reason(sheet.file, world, outputs)
            cause = silence_cause(program.output().decode(errors="replace")) if silence else ""
        elif world.is_blocked():
            cause = BLOCKED_CAUSE
    finally:
        world.stop()
        world.stop_publishing()
    cheat = program.attempt() or intruder
    problem = cheat or program.crash_reason()
    sheet.add_problem(problem)
    if problem or silence:
        sheet.last_lines = program.last_lines()
    if cheat:
        sheet.withdraw(0, cheat)
    elif silence and not problem:
        sheet.withdraw(first, silence)
        sheet.set_cause(first, cause)
    elif program.violation or cause == BLOCKED_CAUSE:
        # What was observed has this cause, whatever else would explain it.
        sheet.set_cause(first, _as_cause(program.violation) or cause, replace=True)
    else:
        sheet.set_cause(first, _as_cause(problem) or cause)


def _as_cause(problem: str) -> str:
    """Return the problem of a program as the cause of lost points."""
    return problem[:1].lower() + problem[1:].rstrip(".")


def _silence_reason(file: str, world: World, outputs: Sequence[str]) -> str:
    """Return a message about a program that publishes nothing, or "" if it has a publisher on one of the topics."""
    if any(world.publishers_of(topic) for topic in outputs):
        return ""
    topics = [topic for topic in world.watched_topics() if world.publishers_of(topic)]
    if not topics:
        return f"{file} publishes nothing yet. Its first lines describe the task."
    method = "sendTransform()" if topics[0] in {"/tf", "/tf_static"} else "publish()"
    return f"{file} publishes nothing: it has a publisher on {topics[0]}, but {method} is never called."


def expanded_xacro(task: Task, file: Path) -> tuple[str, str]:
    """Expand a student's xacro file as a confined program, because it can contain arbitrary Python expressions.

    Returns:
        The URDF, and a message about an attempt to use solutions of the lab, or "".

    Raises:
        CourseError: xacro fails.
    """
    program = StudentProgram(file, task.scratch, task.confinement)

    def run(words: Sequence[str], request: bytes) -> subprocess.CompletedProcess[bytes]:
        code = program.run(MAX_SECONDS, words, request)
        # The output also contains what the file prints; the answer is its last line.
        return subprocess.CompletedProcess(words, code, program.output().rpartition(b"\n")[2])

    try:
        text = expand_xacro(file, run=run)
    except (CoframeError, OSError) as error:
        if attempt := program.attempt():
            return "", attempt
        raise CourseError(program.violation or explain(error)) from None
    return text, program.attempt()


def _file_problem(folder: Path, name: str) -> str:
    """Return why a program cannot be started, or "" if it can."""
    if not is_submitted(folder, name):
        return f"{MISSING_FILE} {name}."
    try:
        check_submitted(folder / name)
    except CourseError as error:
        return error_text(error)
    return ""


def _intruder_reason(world: World) -> str:
    for topic, names in world.intruders().items():
        return f"The program publishes on {topic} (node {', '.join(names)}), on which only the simulation may publish."
    return ""


def stamp_ns(message: Any) -> int:
    """Return the stamp of a message with a header, in nanoseconds."""
    stamp = message.header.stamp
    return int(stamp.sec) * SECOND + int(stamp.nanosec)


def to_seconds(nanoseconds: int) -> float:
    """Return nanoseconds in seconds."""
    return nanoseconds / SECOND


def transforms_on_tf(messages: list[Received], latched_messages: list[Received]) -> list[Received]:
    """Return the messages of a program on /tf, given those of a volatile and of a transient local subscription.

    A graded program also stores messages of /tf, so that those before its discovery are not lost. The publishers of
    other programs offer only volatile messages.
    """
    return latched_messages or messages


def norm_of(quaternion: Any) -> float:
    """Return the length of a Quaternion message."""
    return float(np.linalg.norm([quaternion.x, quaternion.y, quaternion.z, quaternion.w]))


def read_edge(message: Any) -> Transform:
    """Return a TransformStamped message as a transform without normalizing its quaternion."""
    translation, rotation = message.transform.translation, message.transform.rotation
    values = np.array([rotation.x, rotation.y, rotation.z, rotation.w])
    norm = float(np.linalg.norm(values))
    return Transform(
        [translation.x, translation.y, translation.z],
        values / norm if norm > 0 and np.isfinite(norm) else [0.0, 0.0, 0.0, 1.0],
        target=message.header.frame_id,
        source=message.child_frame_id,
    )


def read_pose(message: Any) -> Transform:
    """Return the pose of a PoseStamped message as a transform."""
    position, rotated = message.pose.position, message.pose.orientation
    values = np.array([rotated.x, rotated.y, rotated.z, rotated.w])
    norm = float(np.linalg.norm(values))
    return Transform(
        [position.x, position.y, position.z],
        values / norm if norm > 0 and np.isfinite(norm) else [0.0, 0.0, 0.0, 1.0],
    )


def difference_text(pose: Transform, correct: Transform, tolerance: float = TOLERANCE) -> str:
    """Return how a pose differs from the correct one, or "" if it is within the tolerance.

    The quaternions q and -q are the same rotation.
    """
    offset = float(np.abs(pose.translation - correct.translation).max())
    if not offset <= tolerance:
        return f"position {_numbers(pose.translation)} m instead of {_numbers(correct.translation)} m"
    rotated = 1.0 - abs(float(pose.quaternion @ correct.quaternion))
    if not rotated <= tolerance**2 + 1e-13:
        return f"rotation {_numbers(pose.quaternion)} (x, y, z, w) instead of {_numbers(correct.quaternion)}"
    return ""


def mean_rate(messages: list[Received]) -> float:
    """Return the mean rate of messages in Hz, or 0 if there are fewer than two.

    Messages that arrive at the same time, such as one for each edge, count once.
    """
    times = sorted({each.time for each in messages})
    if len(times) < 2:
        return 0.0
    return (len(times) - 1) / to_seconds(times[-1] - times[0])


def _numbers(values: Any) -> str:
    return "[" + ", ".join(f"{value:.7g}" for value in values) + "]"
