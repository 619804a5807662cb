# SPDX-License-Identifier: Apache-2.0
"""The steps of a scenario: the operations on coframe and on ROS 1, and the expected answers.

As long as both follow the same rules, their histories are equal and their answers are compared with each other. If a
rule of ros1_rules.json applies to an insertion, the two histories of that frame differ from then on. Each is then
checked against the rules of its own version: lookups at, between and after the samples, and the YAML of the frame.
Before the next query, coframe's history is made equal to that of ROS 1, which is the reference and never changed.
ROS 1 rejects or stores unchanged quaternions that are not of unit length, so it also receives them normalized.
"""

import bisect
import math
from typing import Any, NamedTuple

from real_tf2.histories import Ros1History, Ros2History, Sample, canonical
from real_tf2.rules import ADAPTED, LOGS, explain_insertion

UNIT_TOLERANCE = (
    1e-9  # with a larger error of the squared length, the answers of ROS 1 differ by more than the tolerance
)
ROS1_TOLERANCE = 0.01


class Step(NamedTuple):
    number: int  # index of the operation in the scenario
    ours: list | None  # the operation on coframe
    theirs: list | None  # the operation on ROS 1
    our_answer: Any = None  # None: the same as that of ROS 1
    their_answer: Any = None
    rule: str | None = None  # the rule that explains a difference


def script(scenario):
    """Return the steps of a scenario."""
    return _Writer(scenario).steps


class _Writer:
    def __init__(self, scenario):
        self.cache = scenario["cache"]
        self.ours, self.theirs = {}, {}  # child: history
        self.known = set()  # frames
        self.different = set()  # children whose histories differ
        self.steps = []
        for self.number, operation in enumerate(scenario["operations"]):
            if operation[0] == "set":
                self.insert(operation)
            else:
                self.question(operation)

    def add(self, ours, theirs, *answers, rule=None):
        self.steps.append(Step(self.number, ours, theirs, *answers, rule=rule))

    def question(self, operation):
        for child in sorted(self.different):
            self.make_equal(child)
        self.different.clear()
        if operation[0] == "clear":
            for history in (*self.ours.values(), *self.theirs.values()):
                history.clear()
        if operation[0] == "chain":
            self.chain(operation)
        else:
            self.add(operation, operation)

    def chain(self, operation):
        kind, target, target_stamp, source, source_stamp, fixed = operation
        if source not in self.known:
            text = f'"{source}" passed to lookupTransform argument source_frame does not exist. '
            self.add(operation, None, ("raises", "LookupException", text), rule=ADAPTED["chain of unknown frames"])
        elif target_stamp == source_stamp and target != fixed:
            their = [kind, fixed, target_stamp, source, source_stamp, fixed]
            self.add(operation, their if fixed in self.known else None, rule=ADAPTED["chain"])
        elif {target, fixed} <= self.known:
            self.add(operation, operation)

    def insert(self, operation):
        _, parent, child, stamp, values, static, authority = operation
        parent, child = _without_slash(parent), _without_slash(child)
        if parent == child or not parent or not child or any(map(math.isnan, values)) or not any(values[3:]):
            self.add(operation, operation)
            return
        self.known.update((parent, child))
        sample = Sample(parent, (*values[:3], *canonical(values[3:])), values)
        given = self.given_to_ros1(operation, child, sample)
        ours = self.ours.setdefault(child, Ros2History(self.cache))
        theirs = self.theirs.setdefault(child, Ros1History(self.cache))
        our_outcome = ours.insert(stamp, sample, static, authority)
        their_outcome = theirs.insert(stamp, sample, static, authority)
        rule = None
        if child in self.different:
            if ours.same_as(theirs):
                self.different.remove(child)
        elif our_outcome != their_outcome:
            rule = explain_insertion(our_outcome, their_outcome)
            self.different.add(child)
        our_log, their_log = (_log(outcome, child, stamp, authority) for outcome in (our_outcome, their_outcome))
        self.add(operation, given, our_log, their_log, rule=rule)
        if child in self.different:
            self.check(child, stamp)

    def given_to_ros1(self, operation, child, sample):
        """Return the operation if its quaternion has unit length, else one that has the same effect in ROS 1."""
        kind, parent, sent_child, stamp, values, static, authority = operation
        off = abs(sum(x * x for x in values[3:]) - 1)
        if off < UNIT_TOLERANCE:
            return operation
        if off < ROS1_TOLERANCE:
            self.add(None, None, rule=ADAPTED["nearly normalized"])
        else:
            line = LOGS["unnormalized"].format(child=child, authority=authority, q=values[3:])
            self.add(None, operation, None, ("log", (("error", line),)), rule=ADAPTED["unnormalized"])
        return [kind, parent, sent_child, stamp, list(sample.values), static, authority]

    def check(self, child, stamp):
        ours, theirs = self.ours[child], self.theirs[child]
        for question, answer in _lookups(ours, child, stamp):
            self.add(question, None, answer)
        self.add(["all_frames_as_yaml"], None, ("block", child, ours.block()))
        self.add(None, ["all_frames_as_yaml"], None, ("block", child, theirs.block()))

    def make_equal(self, child):
        ours, theirs = self.ours[child], self.theirs[child]
        for parent, stamp, values, static in _repairing_insertions(ours, theirs):
            # One leading slash is removed by the buffer.
            again = ["set", f"/{parent}", f"/{child}", stamp, values, static, theirs.authority]
            self.add(again, None, ("log", ()), None)
        ours.take_over(theirs)


def _repairing_insertions(ours, theirs):
    """Return the insertions that make `ours` equal to `theirs`.

    Repeating the last one is enough in some cases. Otherwise, a change to static clears the history, and all samples
    are inserted again.
    """
    last = theirs.samples[-1]
    newest = (last.parent, theirs.stamps[-1], last.sent, theirs.static)
    trial = ours.copy()
    trial.insert(theirs.stamps[-1], last, theirs.static, theirs.authority)
    if trial.same_as(theirs):
        return [newest]
    flip = [] if ours.static else [(last.parent, 0, last.sent, True)]
    samples = zip(theirs.stamps, theirs.samples, strict=True)
    return [*flip, *((sample.parent, stamp, sample.sent, False) for stamp, sample in samples)]


def _lookups(history, child, stamp):
    """Return lookups on one edge, mostly around a stamp, with the answers expected from a history."""
    for when in (stamp,) if history.static else {0, *_stamps_around(history.stamps, stamp)}:
        sample = history.at(when)
        stamp_of_answer = when if when or history.static else history.stamps[-1]
        if "/" not in (sample.parent[0], child[0]):  # frames with a slash cannot be looked up
            yield ["lookup", sample.parent, child, when], ("pose", stamp_of_answer, sample.values)


def _stamps_around(stamps, stamp):
    """Return both ends, the stamp between them, its neighbors, and the times halfway to these."""
    if not stamps[0] <= stamp <= stamps[-1]:
        return {stamps[0], stamps[-1]}
    before = stamps[max(0, bisect.bisect_left(stamps, stamp) - 1)]
    after = stamps[min(len(stamps) - 1, bisect.bisect_right(stamps, stamp))]
    return {stamps[0], before, (before + stamp) // 2, stamp, (stamp + after) // 2, after, stamps[-1]}


def _log(outcome, child, stamp, authority):
    """Return the log lines of ROS 2 for an insertion with this result."""
    template = LOGS.get(outcome.partition(",")[0])
    if template is None:
        return ("log", ())
    line = template.format(child=child, stamp=stamp * 1e-9, authority=authority)
    return ("log", (("warning", line),))


def _without_slash(name):
    return name.removeprefix("/")
