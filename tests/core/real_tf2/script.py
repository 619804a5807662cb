"""A scenario, worked out: what coframe is told and asked, what ROS 1 is, and what has to come of it.

Where both rule alike they hold the same, and each question's answers are compared with each other. Where an insertion
is treated otherwise by a rule of ros1_rules.json, coframe's frame and ROS 1's differ from then on. The frame is then
checked by itself, on each side against its own rules: what look-ups at, between and after its samples give, and what
the YAML tells of it. Before anything else is asked, coframe's frame is brought to what ROS 1's holds; ROS 1's is never
touched, so that it is the measure throughout. Quaternions that are not of unit length, which ROS 1 refuses or leaves
as they are, it is given once more normalised.
"""

import bisect
import math
from typing import Any, NamedTuple

from real_tf2.histories import Ros1History, Ros2History, Sample, canonical
from real_tf2.rules import ADAPTED, LOGS, explain_insertion

UNIT_TOLERANCE = 1e-9  # beyond it, in the square, ROS 1's answers are off by more than is compared
ROS1_TOLERANCE = 0.01


class Step(NamedTuple):
    number: int  # of the scenario's operation
    ours: list | None  # what coframe is told or asked
    theirs: list | None  # what ROS 1 is
    our_answer: Any = None  # None: as theirs
    their_answer: Any = None
    rule: str | None = None  # that explains it


def script(scenario):
    """Return the steps of a scenario."""
    return _Writer(scenario).steps


class _Writer:
    def __init__(self, scenario):
        self.cache = scenario["cache"]
        self.ours, self.theirs = {}, {}  # child: history
        self.known = set()  # frames
        self.apart = set()  # children whose histories differ
        self.steps = []
        for self.number, operation in enumerate(scenario["operations"]):
            if operation[0] == "set":
                self.insert(operation)
            else:
                self.question(operation)

    def add(self, ours, theirs, *answers, rule=None):
        self.steps.append(Step(self.number, ours, theirs, *answers, rule=rule))

    def question(self, operation):
        for child in sorted(self.apart):
            self.bring_together(child)
        self.apart.clear()
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
        if child in self.apart:
            if ours.same_as(theirs):
                self.apart.remove(child)
        elif our_outcome != their_outcome:
            rule = explain_insertion(our_outcome, their_outcome)
            self.apart.add(child)
        our_log, their_log = (_log(outcome, child, stamp, authority) for outcome in (our_outcome, their_outcome))
        self.add(operation, given, our_log, their_log, rule=rule)
        if child in self.apart:
            self.check(child, stamp)

    def given_to_ros1(self, operation, child, sample):
        """The operation, where its quaternion is of unit length; else one that ROS 1 understands alike."""
        kind, parent, told_child, stamp, values, static, authority = operation
        off = abs(sum(x * x for x in values[3:]) - 1)
        if off < UNIT_TOLERANCE:
            return operation
        if off < ROS1_TOLERANCE:
            self.add(None, None, rule=ADAPTED["nearly normalised"])
        else:
            line = LOGS["unnormalised"].format(child=child, authority=authority, q=values[3:])
            self.add(None, operation, None, ("log", (("error", line),)), rule=ADAPTED["unnormalised"])
        return [kind, parent, told_child, stamp, list(sample.values), static, authority]

    def check(self, child, stamp):
        ours, theirs = self.ours[child], self.theirs[child]
        for question, answer in _look_ups(ours, child, stamp):
            self.add(question, None, answer)
        self.add(["all_frames_as_yaml"], None, ("block", child, ours.block()))
        self.add(None, ["all_frames_as_yaml"], None, ("block", child, theirs.block()))

    def bring_together(self, child):
        ours, theirs = self.ours[child], self.theirs[child]
        for parent, stamp, told, static in _way_back(ours, theirs):
            # With a slash in front: one is taken off again.
            again = ["set", f"/{parent}", f"/{child}", stamp, told, static, theirs.authority]
            self.add(again, None, ("log", ()), None)
        ours.take_over(theirs)


def _way_back(ours, theirs):
    """What makes `ours` hold what `theirs` does: a repetition where that suffices, else a flip and everything anew."""
    last = theirs.samples[-1]
    newest = (last.parent, theirs.stamps[-1], last.told, theirs.static)
    trial = ours.copy()
    trial.insert(theirs.stamps[-1], last, theirs.static, theirs.authority)
    if trial.same_as(theirs):
        return [newest]
    flip = [] if ours.static else [(last.parent, 0, last.told, True)]
    samples = zip(theirs.stamps, theirs.samples, strict=True)
    return [*flip, *((sample.parent, stamp, sample.told, False) for stamp, sample in samples)]


def _look_ups(history, child, stamp):
    """Return lookups on one edge, mostly around a stamp, with the answers expected from a history."""
    for when in (stamp,) if history.static else {0, *_stamps_around(history.stamps, stamp)}:
        sample = history.at(when)
        told = when if when or history.static else history.stamps[-1]
        if "/" not in (sample.parent[0], child[0]):  # no look-up reaches such a frame
            yield ["lookup", sample.parent, child, when], ("pose", told, sample.values)


def _stamps_around(stamps, stamp):
    """Return both ends, the stamp between them, its neighbours, and the times halfway to these."""
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
