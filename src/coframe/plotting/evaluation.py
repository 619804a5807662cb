# SPDX-License-Identifier: Apache-2.0
"""Evaluate expressions on a recording."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe import _core
from coframe._output.formatting import did_you_mean
from coframe.analysis.clocks import clock_of
from coframe.bags.tables.columns import FieldSource
from coframe.bags.tables.topic_poses import has_pose, topic_poses
from coframe.bags.transforms import ingest_for
from coframe.errors import DecodeError, PlotError
from coframe.messages.slices import Slices
from coframe.plotting._figure import Series
from coframe.plotting.expressions import (
    Expression,
    FieldExpression,
    PoseExpression,
    TimingExpression,
    parse_expression,
)
from coframe.plotting.values import NoElementError, axis_title, field_value, rates
from coframe.time import SECOND
from coframe.transform.quantities import POSE_QUANTITIES, coordinate

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray

    from coframe.bags import Recording
    from coframe.bags.storage import Channel
    from coframe.buffer import Buffer
    from coframe.transform.transform import Transform

    Stamped = tuple[NDArray[np.int64], NDArray[np.float64]]

__all__ = ["check_edge", "evaluate", "trajectory_curves"]

_BATCH = 5_000  # messages
_PROGRESS_INTERVAL = 500  # messages between two reports of the progress
_MAX_LISTED_NAMES = 12  # names in a hint


def evaluate(
    expressions: Iterable[Expression | str],
    recording: Recording,
    start: int | None = None,
    stop: int | None = None,
    *,
    progress: Callable[[str, int, int], object] | None = None,
) -> list[Series]:
    """Return the curves of expressions.

    A pose has a value at each sample of the edges between its frames. A rate is the mean over the second before each
    message, based on receive times for a topic and on stamps for an edge. A delay is the receive time minus the stamp;
    in a simulation, the time of ``/clock`` at receipt minus the stamp.

    Args:
        expressions: Expressions, or strings for :func:`parse_expression`.
        recording: The recording that contains the topics and transforms.
        start: The first stamp, in nanoseconds.
        stop: The last stamp, in nanoseconds.
        progress: Called regularly with an expression, the number of messages read and the total number.

    Raises:
        PlotError: An expression is invalid, a topic or field does not exist, or there are no values.
        TransformException: A frame does not exist, or the frames are not connected.
    """
    parsed = [parse_expression(each) if isinstance(each, str) else each for each in expressions]
    report = progress or (lambda _text, _done, _total: None)
    curves = []
    for each in parsed:
        curve = _evaluate(each, recording, report)
        inside = np.ones(len(curve.stamps), dtype=bool)
        if start is not None:
            inside &= curve.stamps >= start
        if stop is not None:
            inside &= curve.stamps <= stop
        order = np.argsort(curve.stamps[inside], kind="stable")
        chosen = Series(
            curve.label, curve.stamps[inside][order], curve.values[inside][order], curve.panel, curve.skipped
        )
        if not np.isfinite(chosen.values).any():
            between = "" if start is None and stop is None else " between the start and the stop"
            raise PlotError(f"{each.text} has no values{between}")
        curves.append(chosen)
    return curves


def trajectory_curves(quantities: Iterable[str], poses: Transform) -> list[Series]:
    """Return curves of a trajectory, such as one that was read from a file.

    Args:
        quantities: ``x``, ``y``, ``z`` and ``distance`` in meters, ``roll``, ``pitch`` and ``yaw`` in radians.
        poses: A batch of shape (N,) with stamps.

    Raises:
        PlotError: A quantity is unknown, or the poses have no stamps.
    """
    if poses.stamps is None:
        raise PlotError("the poses have no stamps, so they cannot be plotted over time", hint="KITTI has no stamps.")
    curves = []
    order = np.argsort(poses.stamps, kind="stable")
    for text in quantities:
        if text not in POSE_QUANTITIES:
            raise PlotError(
                f"{text!r} is not a quantity of poses",
                hint=f"{did_you_mean(text, POSE_QUANTITIES)} Quantities: {', '.join(POSE_QUANTITIES)}.".lstrip(),
            )
        expression = PoseExpression(text, "", "", text)
        values = coordinate(poses, text)[order]
        curves.append(Series(text, np.asarray(poses.stamps)[order], values, axis_title(expression)))
    return curves


def _evaluate(expression: Expression, recording: Recording, report: Callable[[str, int, int], object]) -> Series:
    if isinstance(expression, PoseExpression):
        return _pose_curve(expression, recording)
    if isinstance(expression, FieldExpression):
        return _field_curve(expression, recording, report)
    return _timing_curve(expression, recording, report)


def _pose_curve(expression: PoseExpression, recording: Recording) -> Series:
    poses = recording.buffer.trajectory(expression.target, expression.source)
    stamps = np.asarray(poses.stamps, dtype=np.int64)
    values = coordinate(poses, expression.quantity)
    if len(stamps) == 1 and stamps[0] == 0:  # All edges are static.
        stamps, values = np.array(recording.span, dtype=np.int64), np.repeat(values, 2)
    return Series(expression.text, stamps, values, axis_title(expression))


def _field_curve(
    expression: FieldExpression, recording: Recording, report: Callable[[str, int, int], object]
) -> Series:
    topic = _check_topic(recording, expression.topic)
    if (poses := _topic_poses(recording, topic, expression)) is not None:
        return poses
    total = recording.topics[topic].messages
    stamps, values = [], []
    missing = damaged = 0
    for done, message in enumerate(recording.messages(topic), start=1):
        try:
            value = field_value(message.message, expression, message.type)
        except DecodeError:
            damaged += 1
            continue
        except NoElementError:
            missing += 1
            value = float("nan")
        stamps.append(message.stamp)
        values.append(value)
        if done % _PROGRESS_INTERVAL == 0 or done == total:
            report(expression.text, done, total)
    if values and missing == len(values):
        raise PlotError(f"{expression.text}: no message on {topic} has an element with this index")
    return Series(
        expression.text,
        np.array(stamps, dtype=np.int64),
        np.array(values, dtype=np.float64),
        axis_title(expression),
        damaged + missing,
    )


def _topic_poses(recording: Recording, topic: str, expression: FieldExpression) -> Series | None:
    """Return the quantity of the poses on a topic, such as ``/odom.yaw``, or None if the expression is a field."""
    *path, quantity = expression.path
    source = FieldSource(topic, expression.path)
    if quantity not in POSE_QUANTITIES or not recording.topics[topic].messages or not has_pose(recording, source):
        return None
    poses = topic_poses(recording, FieldSource(topic, tuple(path)), lambda _sentence: None)
    as_pose = PoseExpression(expression.text, "", "", str(quantity))
    values = coordinate(poses, str(quantity))
    return Series(expression.text, np.asarray(poses.stamps, dtype=np.int64), values, axis_title(as_pose))


def _timing_curve(
    expression: TimingExpression, recording: Recording, report: Callable[[str, int, int], object]
) -> Series:
    delays = expression.quantity == "delay"
    if expression.edge is None:
        topic = _check_topic(recording, str(expression.topic))
        stamps, received = recording.stamps(topic), recording.received(topic)
        if delays and np.array_equal(stamps, recording.to_ros_time(received)):
            raise PlotError(
                f"{expression.text}: the messages of type {recording.topics[topic].type} have no stamp and "
                "therefore no delay",
                hint=f"Their rate can be plotted: {topic}.rate.",
            )
        values = _delays(expression, recording, stamps, received) if delays else rates(received)
    else:
        check_edge(expression, recording.buffer)
        if delays:
            stamps, received = _received_transforms(expression, recording, report)
            values = _delays(expression, recording, stamps, received)
        else:
            stamps = _edge_stamps(recording, *expression.edge)
            values = rates(stamps)
    return Series(expression.text, stamps, values, axis_title(expression))


def _delays(
    expression: TimingExpression, recording: Recording, stamps: NDArray[np.int64], received: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the receive times minus the stamps in seconds, on the clock of the stamps."""
    if not stamps.size:
        raise PlotError(f"{expression.text} has no values: the topic has no messages")
    simulated = recording.to_ros_time(received)
    clock = clock_of(
        float(np.median(received - stamps)),
        None if np.array_equal(simulated, received) else float(np.median(simulated - stamps)),
    )
    if clock == "other":
        raise PlotError(
            f"{expression.text}: the stamps and the receive times are on different clocks, so there is no delay",
            hint="A recording of a simulation must contain the topic /clock.",
        )
    return np.asarray(((simulated if clock == "simulated" else received) - stamps) / SECOND)


def check_edge(expression: TimingExpression, buffer: Buffer) -> None:
    """Check that the frames are parent and child of an edge with stamps.

    Raises:
        PlotError: They are not, or the edge is static.
        TransformException: A frame does not exist, or the frames are not connected.
    """
    parent, child = expression.edge or ("", "")
    parents = {edge.child: edge for edge in buffer.edges()}
    if child in parents and parents[child].parent == parent:
        if parents[child].static:
            raise PlotError(f"{expression.text}: {parent} -> {child} is static, so it has no {expression.quantity}")
        return
    buffer.lookup(parent, child)  # raises an error if a frame does not exist
    if parent in parents and parents[parent].parent == child:
        hint = f"The parent comes first: {child}->{parent}.{expression.quantity}."
    else:
        hint = f"The parent of {child!r} is {parents[child].parent!r}." if child in parents else ""
    raise PlotError(f"{expression.text}: {parent!r} is not the parent of {child!r}", hint=hint)


def _edge_stamps(recording: Recording, parent: str, child: str) -> NDArray[np.int64]:
    stamps, _, parents, names = _core.samples_of(recording.buffer.snapshot(), child)
    of_parent = np.frombuffer(parents, dtype=np.uint32) == names.index(parent)
    return np.unique(np.frombuffer(stamps, dtype=np.int64)[of_parent])


def _received_transforms(
    expression: TimingExpression, recording: Recording, report: Callable[[str, int, int], object]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the stamps and the receive times of all transforms of an edge."""
    parent, child = expression.edge or ("", "")
    topics = {
        channel.topic
        for channel in recording.channels()
        if ingest_for(channel) and recording.choice.selects(channel.topic)
    }
    stamps, received = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    total, done = sum(recording.topics[topic].messages for topic in topics), 0
    for channel, times, messages in _batches(recording, topics):
        ingest = ingest_for(channel)
        if ingest is not None:
            columns = ingest.columns(messages)
            names = [recording.frame(name) for name in columns.names]
            is_edge = np.array([name == parent for name in names], dtype=bool)[columns.parent]
            is_edge &= np.array([name == child for name in names], dtype=bool)[columns.child]
            stamps.append(columns.stamp[is_edge])
            received.append(times[columns.message[is_edge]])
        done += len(times)
        report(expression.text, done, total)
    return np.concatenate(stamps), np.concatenate(received)


def _batches(recording: Recording, topics: set[str]) -> Iterator[tuple[Channel, NDArray[np.int64], Slices]]:
    pending: dict[int, tuple[Channel, list[int], list[bytes]]] = {}
    for channel, time, data in recording.in_order(sorted(topics)):
        _, times, messages = pending.setdefault(id(channel), (channel, [], []))
        times.append(time)
        messages.append(data)
        if len(messages) >= _BATCH:
            del pending[id(channel)]
            yield channel, np.array(times, dtype=np.int64), Slices.join(messages)
    for channel, times, messages in pending.values():
        yield channel, np.array(times, dtype=np.int64), Slices.join(messages)


def _check_topic(recording: Recording, name: str) -> str:
    if name in recording.topics:
        return name
    names = list(recording.topics)
    known = (
        f"Topics: {', '.join(names[:_MAX_LISTED_NAMES])}{', ...' if len(names) > _MAX_LISTED_NAMES else ''}."
        if names
        else ""
    )
    raise PlotError(f"{recording.path} has no topic {name!r}", hint=f"{did_you_mean(name, names)} {known}".strip())
