"""Random trees and times, answered by coframe and by Debian's real tf2 (ROS 1), where ROS 1 and ROS 2 agree.

They differ, and the scenarios avoid it, in: equal stamps (ROS 1 refuses the second), quaternions that are not of unit
length (ROS 1 refuses them), the sign of quaternions (compared up to sign), the wording of some texts (the class of
the exception is compared), and stamps, which its Python binding passes on as float seconds: ours are multiples of
1/512 s, which a float holds exactly.
"""

import json
import random
import subprocess
from pathlib import Path

import numpy as np
import pytest

import coframe

DEBIAN_PYTHON = "/usr/bin/python3"
DRIVER = Path(__file__).with_name("debian_tf2_driver.py")
SECOND = 1_000_000_000
CACHE = 10 * SECOND
TICK = SECOND // 512
SCENARIOS = 250
QUESTIONS = 80


@pytest.fixture(scope="module")
def debian():
    probe = subprocess.run([DEBIAN_PYTHON, "-c", "import tf2_py, genpy"], capture_output=True, check=False)
    if probe.returncode != 0:
        pytest.skip("Debian's tf2 is not installed (apt-get install python3-tf2-ros)")
    with subprocess.Popen(
        [DEBIAN_PYTHON, DRIVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:

        def ask(scenario):
            process.stdin.write(json.dumps(scenario) + "\n")
            process.stdin.flush()
            return json.loads(process.stdout.readline())

        yield ask
        process.stdin.close()


def random_values(rng):
    quaternion = np.array([rng.gauss(0, 1) for _ in range(4)])
    quaternion /= np.linalg.norm(quaternion)
    return [rng.uniform(-50, 50) for _ in range(3)] + quaternion.tolist()


def random_scenario(rng):
    """A forest with static and dynamic links, samples partly out of order, some frames that changed their parent."""
    names = [f"frame{i}" for i in range(rng.randint(2, 12))]
    start = rng.randint(1, 2_000_000_000) * SECOND
    insertions = []
    for i, child in enumerate(names[1:], start=1):
        if rng.random() < 0.1:
            continue  # this frame is the root of a tree of its own
        parent = names[rng.randrange(i)]
        if rng.random() < 0.3:
            insertions.append([parent, child, 0, random_values(rng), True])
            continue
        offsets = rng.sample(range(0, 8 * SECOND, TICK), rng.choice([1, 2, 3, 10, 40]))
        if rng.random() < 0.7:
            offsets.sort()
        moves_at = rng.choice(offsets) if rng.random() < 0.2 else None
        other = names[rng.randrange(i)]
        insertions += [
            [other if moves_at is not None and offset > moves_at else parent, child, start + offset, values, False]
            for offset, values in ((offset, random_values(rng)) for offset in offsets)
        ]
    stamps = [stamp for *_, stamp, _, static in insertions if not static] or [start]
    askable = [*names, "nobody", "", "/frame0"]
    weights = [*([10] * len(names)), 1, 0.5, 0.5]

    def when():
        return rng.choice([0, rng.choice(stamps), start + rng.randrange(-SECOND, 9 * SECOND, TICK)])

    questions = [[*rng.choices(askable, weights, k=2), when()] for _ in range(QUESTIONS)]
    return {"cache": CACHE, "set": insertions, "ask": questions}


def our_answers(scenario):
    buffer = coframe.Buffer(scenario["cache"])
    for parent, child, stamp, values, static in scenario["set"]:
        buffer.set_values(parent, child, stamp, *values, static, "test")
    answers = []
    for target, source, stamp in scenario["ask"]:
        try:
            transform = buffer.lookup(target, source, stamp)
            answers.append([transform.stamp, transform.values])
        except coframe.TransformException as error:
            answers.append([type(error).__name__, str(error)])
    return answers


def assert_same(ours, theirs):
    assert ours[0] == theirs[0]  # the stamp, or which exception
    if isinstance(ours[0], str):
        return
    ours, theirs = np.array(ours[1]), np.array(theirs[1])
    sign = 1.0 if ours[3:] @ theirs[3:] >= 0 else -1.0
    np.testing.assert_allclose(ours[:3], theirs[:3], rtol=0, atol=1e-11)
    np.testing.assert_allclose(ours[3:], sign * theirs[3:], rtol=0, atol=1e-12)


def test_random_trees_are_answered_as_by_the_real_tf2(debian):
    rng = random.Random(20)
    kinds = set()
    for number in range(SCENARIOS):
        scenario = random_scenario(rng)
        theirs = debian(scenario)
        for question, ours, expected in zip(scenario["ask"], our_answers(scenario), theirs, strict=True):
            try:
                assert_same(ours, expected)
            except AssertionError as error:
                pytest.fail(f"scenario {number}, {question}: ours {ours}, tf2's {expected}: {error}")
            kinds.add(ours[0] if isinstance(ours[0], str) else "answer")
    assert kinds == {
        "answer",
        "LookupException",
        "ConnectivityException",
        "ExtrapolationException",
        "InvalidArgumentException",
    }
