# SPDX-License-Identifier: Apache-2.0
"""Run scenarios on coframe and on Debian's real tf2, compare every answer, and minimize differences."""

import collections
import contextlib
import gc
import json
import pickle
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

from real_tf2.coframe_side import CoframeSide
from real_tf2.rules import explain, is_close
from real_tf2.scenarios import OPERATIONS_PER_SCENARIO, scenario
from real_tf2.script import script

DEBIAN_PYTHON = ("/usr/bin/python3", "-E")  # whatever PYTHONPATH names is for another Python
SCENARIOS_PER_BATCH = 20


class Difference(NamedTuple):
    """A difference between two answers that no rule explains."""

    number: int  # of the scenario's operation
    asked: list
    who: str
    found: Any
    expected: Any


class Debian:
    """Debian's tf2 in a separate process: takes batches of (cache length, operations), returns answers."""

    def __init__(self):
        self._process = subprocess.Popen(
            [*DEBIAN_PYTHON, Path(__file__).with_name("debian_side.py")], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        self._thread = ThreadPoolExecutor(1)

    @staticmethod
    def is_there():
        probe = subprocess.run([*DEBIAN_PYTHON, "-c", "import tf2_py"], capture_output=True, check=False)
        return probe.returncode == 0

    def ask(self, batch):
        """The answers, as a future: a batch can be worked on here while Debian works on the next."""
        return self._thread.submit(self._ask, batch)

    def _ask(self, batch):
        pickle.dump(batch, self._process.stdin, protocol=4)
        self._process.stdin.flush()
        try:
            return pickle.load(self._process.stdout)
        except EOFError:
            raise RuntimeError(f"Debian's tf2 has ended, with exit status {self._process.wait()}") from None

    def close(self):
        self._thread.shutdown()
        self._process.communicate()


def run(debian, seed, operations, make_side=CoframeSide):
    """Run the operations; return how often each rule explained a difference, and the first unexplained one or None."""
    explained = collections.Counter()
    with _few_collections():
        for batch, their_answers in _batches(debian, seed, -(-operations // OPERATIONS_PER_SCENARIO)):
            for (number, made, steps), theirs in zip(batch, their_answers.result(), strict=True):
                if _compare(made["cache"], steps, theirs, explained, make_side):
                    return explained, f"seed {seed}, scenario {number}: {difference_report(debian, made, make_side)}"
    return explained, None


def first_difference(debian, made, make_side=CoframeSide):
    """Return the unexplained difference of one scenario, or None."""
    steps = script(made)
    (their_answers,) = debian.ask([_for_ros1(made, steps)]).result()
    return _compare(made["cache"], steps, their_answers, collections.Counter(), make_side)


def difference_report(debian, made, make_side=CoframeSide):
    """Return a difference as text, with the operations that reproduce it."""
    made = _shrunk(debian, made, make_side)
    difference = first_difference(debian, made, make_side)
    operations = ",\n  ".join(json.dumps(operation, ensure_ascii=False) for operation in made["operations"])
    return (
        f"{difference.who}, operation {difference.number} {difference.asked}:\n"
        f"found    {difference.found}\nexpected {difference.expected}\n"
        "To see it again, save this and give it to PYTHONPATH=tests/core python -m real_tf2:\n"
        f'{{"cache": {made["cache"]}, "operations": [\n  {operations}\n]}}'
    )


def _batches(debian, seed, scenarios):
    """Yield batches of (number, scenario, steps) with the future of Debian's answers, one batch ahead."""
    ahead = None
    for start in range(0, scenarios, SCENARIOS_PER_BATCH):
        numbers = range(start, min(start + SCENARIOS_PER_BATCH, scenarios))
        made = [(number, scenario(seed, number)) for number in numbers]
        batch = [(number, each, script(each)) for number, each in made]
        asked = batch, debian.ask([_for_ros1(each, steps) for _, each, steps in batch])
        if ahead:
            yield ahead
        ahead = asked
    yield ahead


@contextlib.contextmanager
def _few_collections():
    """Disable the garbage collector: there are millions of objects and no cycles, and it takes a third of the time."""
    before = gc.get_threshold()
    gc.set_threshold(200_000)
    try:
        yield
    finally:
        gc.set_threshold(*before)


def _for_ros1(made, steps):
    return made["cache"], [step.theirs for step in steps if step.theirs]


def _compare(cache, steps, their_answers, explained, make_side):
    side = make_side(cache)
    their_answers = iter(their_answers)
    for step in steps:
        ours = side.answer(step.ours) if step.ours else None
        theirs = next(their_answers) if step.theirs else None
        if step.rule:
            explained[step.rule] += 1
        if step.our_answer and not _is(step.our_answer, ours):
            return Difference(step.number, step.ours, "coframe, by the rules of ROS 2", ours, step.our_answer)
        expected = step.their_answer or ours
        if theirs is None or expected is None:
            continue
        reasons = explain(step.theirs, expected, _part(expected, theirs))
        if reasons is None and step.their_answer:
            return Difference(step.number, step.theirs, "ROS 1, by its own rules", theirs, step.their_answer)
        if reasons is None:
            return Difference(step.number, step.ours, "coframe next to ROS 1", ours, theirs)
        explained.update(reasons)
    return None


def _is(expected, found):
    if expected[0] == "pose" == found[0]:
        return is_close(expected, found)
    return expected == _part(expected, found)


def _part(expected, answer):
    """Return the expected block of a YAML answer; other answers unchanged."""
    if expected[0] != "block":
        return answer
    child = expected[1]
    text = "\n" + answer[1]
    for head in (f"\n{child}: \n", f'\n"{child}": \n'):
        if head in text:
            start = text.index(head) + len(head)
            return ("block", child, "".join(text[start:].splitlines(keepends=True)[:6]))
    return answer


def _shrunk(debian, made, make_side):
    """Return the scenario without the operations that the difference does not need."""
    operations, size = made["operations"], len(made["operations"])
    while size:
        start = 0
        while start < len(operations):
            fewer = [*operations[:start], *operations[start + size :]]
            if first_difference(debian, {**made, "operations": fewer}, make_side):
                operations = fewer
            else:
                start += size
        size //= 2
    return {**made, "operations": operations}
