# SPDX-License-Identifier: Apache-2.0
"""Random scenarios: a cache length, and insertions and questions for one buffer, mixed in one sequence.

A scenario is JSON through and through:

    {"cache": ns, "operations": [["set", parent, child, stamp, [x, y, z, qx, qy, qz, qw], static, authority],
                                 ["lookup", target, source, stamp], ...]}

Stamps are multiples of 1/64 s: ROS 1's Python binding passes them on as float seconds, and they are printed with six
decimals; both hold these exactly.
"""

import functools
import math
import random

SECOND = 1_000_000_000
TICK = SECOND // 64
UNLIMITED = 1_000_000_000 * SECOND
LAST_STAMP = 2_000_000_000 * SECOND  # ROS 1's Python binding ends the process at stamps beyond 2038

OPERATIONS_PER_SCENARIO = 400
CACHES = (0, TICK, SECOND // 2, 2 * SECOND, 2 * SECOND, 10 * SECOND, 10 * SECOND, UNLIMITED)
STARTS = (0, SECOND, 1_000 * SECOND, 1_000_000 * SECOND, 1_700_000_000 * SECOND)
AUTHORITIES = ("driver", "odometry", "calibration")
SPECIAL_ROTATIONS = ([0, 0, 0, 1], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.5, 0.5, 0.5, 0.5])
NAN = math.nan


def scenario(seed, number):
    """Return the scenario with this number; it depends only on the seed."""
    world = _World(random.Random(f"{seed}/{number}"))
    return {"cache": world.cache, "operations": world.operations(OPERATIONS_PER_SCENARIO)}


class _World:
    def __init__(self, rng):
        self.rng = rng
        self.cache = rng.choice(CACHES)
        self.reach = min(self.cache, 20 * SECOND) // TICK + 2  # in ticks: how far back questions and data lie
        self.frames = [f"f{i}" for i in range(rng.choice((2, 3, 5, 8, 12, 40)))]
        if rng.random() < 0.1:
            self.frames[-1] = rng.choice(("rück sitz", "a: b", "f0/x"))
        depth = rng.choice((1, 3, 100))  # a parent is at most so many frames before its child
        self.parents = {
            child: self.frames[rng.randrange(max(0, i - depth), i)]
            for i, child in enumerate(self.frames[1:], start=1)
            if i == 1 or rng.random() < 0.95
        }
        self.children = list(self.parents)
        self.static = {child for child in self.children if rng.random() < 0.25}
        self.newest = dict.fromkeys(self.children, rng.choice(STARTS))
        self.sent = {}  # of every child, the insertions of late
        self.rotations = {}
        self.questions = rng.choice((0.2, 0.5, 0.8))

    def operations(self, count):
        found = []
        while len(found) < count:
            kind = _pick(self.rng, QUESTIONS if self.rng.random() < self.questions else INSERTIONS)
            made = kind(self)
            found += made if isinstance(made[0], list) else [made]
        return found[:count]

    # What is sent.

    def set(self, child, stamp, *, parent=None, values=None, static=False, authority=None):
        operation = [
            "set",
            self.parents[child] if parent is None else parent,
            child,
            min(max(stamp, 0), LAST_STAMP),
            values or [*self.translation(), *self.rotation(child)],
            static,
            authority or self.rng.choice(AUTHORITIES),
        ]
        self.sent.setdefault(child, []).append(operation)
        if len(self.sent[child]) > 50:
            del self.sent[child][:25]
        if not static:
            self.newest[child] = max(self.newest[child], operation[3])
        return operation

    def translation(self):
        return [self.rng.uniform(-50, 50) for _ in range(3)]

    def rotation(self, child):
        rng = self.rng
        dice = rng.random()
        if dice < 0.05:
            return rng.choice(SPECIAL_ROTATIONS)
        before, spread = (self.rotations[child], 0.01) if dice < 0.5 and child in self.rotations else ([0] * 4, 1)
        self.rotations[child] = _unit([rng.gauss(mean, spread) for mean in before])
        return self.rotations[child]

    def child(self):
        return self.rng.choice(self.children)

    def later(self, child):
        return self.newest[child] + self.rng.choice((1, 1, 1, 2, 5, 40)) * TICK

    def in_order(self):
        child = self.child()
        if child in self.static:
            return self.set(child, self.rng.choice((0, self.later(child))), static=True)
        return self.set(child, self.later(child))

    def stream(self):
        child = self.child()
        return [self.set(child, self.later(child)) for _ in range(self.rng.randint(2, 40))]

    def out_of_order(self):
        child = self.child()
        return self.set(child, self.newest[child] - self.rng.randrange(2 * self.reach) * TICK)

    def at_the_edge_of_the_cache(self):
        child = self.child()
        return self.set(child, self.newest[child] - self.cache + self.rng.randint(-1, 1) * TICK)

    def far_ahead(self):
        child = self.child()
        return self.set(child, self.newest[child] + self.rng.randint(1, 3) * self.reach * TICK)

    def again(self):
        """An exact repetition, or one that says the same with the other sign, or by another authority."""
        _, parent, child, stamp, values, static, authority = self.sent_before() or self.in_order()
        if 0 not in values and self.rng.random() < 0.2:  # with zeros, both ways round may be equally long
            values = [*values[:3], *(-x for x in values[3:])]
        if self.rng.random() < 0.2:
            authority = None
        return self.set(child, stamp, parent=parent, values=values, static=static, authority=authority)

    def at_an_equal_stamp(self):
        _, parent, child, stamp, *_ = self.sent_before() or self.in_order()
        return [
            self.set(child, stamp, parent=self.rng.choice((parent, parent, self.other_than(child))))
            for _ in range(self.rng.randint(1, 3))
        ]

    def sent_before(self):
        return self.rng.choice(self.sent.get(self.child(), [None]))

    def flip(self):
        child = self.child()
        return [
            self.set(child, self.later(child), static=self.rng.random() < 0.5) for _ in range(self.rng.randint(1, 4))
        ]

    def reparent(self):
        child = self.child()
        self.parents[child] = self.frames[self.rng.randrange(self.frames.index(child))]
        return self.in_order()

    def into_a_loop(self):
        child = self.child()
        return self.set(child, self.later(child), parent=self.other_than(child), static=child in self.static)

    def other_than(self, child):
        return self.rng.choice([frame for frame in self.frames if frame != child])

    def unnormalized(self):
        child = self.child()
        factor = self.rng.choice((1e-3, 0.1, 0.996, 1.003, 1.1, 7, 1e6))
        values = [*self.translation(), *(factor * x for x in self.rotation(child))]
        return self.set(child, self.later(child), values=values, static=child in self.static)

    def refused(self):
        child = self.child()
        good = [*self.translation(), *self.rotation(child)]
        at = self.rng.randrange(7)
        values = self.rng.choice(([*good[:at], NAN, *good[at + 1 :]], [*good[:3], 0, 0, 0, 0], good))
        names = [child, "", self.parents[child], "/", f"/{child}", *([None] * 3)]
        parent, sent_child = self.rng.choice(names), self.rng.choice((child, child, child, "", "/"))
        static = self.rng.random() < 0.5
        operation = self.set(child, self.later(child), parent=parent, values=values, static=static)
        return [*operation[:2], sent_child, *operation[3:]]

    def slashed(self):
        child = self.child()
        parent = self.rng.choice(("", "/", "//")) + self.parents[child]
        operation = self.set(child, self.later(child), parent=parent, static=child in self.static)
        return [*operation[:2], self.rng.choice(("/", "/", "//")) + child, *operation[3:]]

    def clear(self):
        return [["clear"], [self.rng.choice(("all_frames_as_yaml", "all_frames_as_string", "frame_names"))]]

    # What is asked.

    def frame(self):
        if self.rng.random() < 0.97:
            return self.rng.choice(self.frames)
        return self.rng.choice(("nobody", "no one", "", "/f0", "//f1", "NO_PARENT", "F0"))

    def when(self, frame):
        """Mostly a time that matters: latest, a stamp that was sent, one between, one before and one after all."""
        dice = self.rng.random()
        if dice < 0.2:
            return 0
        child = frame if frame in self.sent else self.child()
        if dice < 0.5 and child in self.sent:
            return self.rng.choice(self.sent[child])[3]
        ticks = self.rng.randint(-2, 2) if dice < 0.65 else -self.rng.randrange(2 * self.reach)
        return max(0, self.newest[child] + ticks * TICK)

    def question(self, kind):
        target, source = self.frame(), self.frame()
        return [kind, target, source, self.when(source)]

    def full_question(self, kind):
        target, source = self.frame(), self.frame()
        return [kind, target, self.when(target), source, self.when(source), self.frame()]

    def latest_common_time(self):
        return ["latest_common_time", self.frame(), self.frame()]

    def frame_exists(self):
        return ["frame_exists", self.frame()]

    def dump(self, kind):
        return [kind]

    def all_frames_as_dot(self):
        return ["all_frames_as_dot", self.rng.choice((0, self.newest[self.child()] + self.rng.randrange(500) * TICK))]


def _unit(quaternion):
    length = math.sqrt(sum(x * x for x in quaternion))
    return [x / length for x in quaternion]


def _pick(rng, table):
    kinds, cumulative = table
    return rng.choices(kinds, cum_weights=cumulative)[0]


def _weighted(weights):
    total, cumulative = 0.0, []
    for weight in weights.values():
        total += weight
        cumulative.append(total)
    return list(weights), cumulative


def _ask(make, kind):
    return functools.partial(make, kind=kind)


INSERTIONS = _weighted(
    {
        _World.in_order: 50,
        _World.stream: 3,
        _World.out_of_order: 12,
        _World.at_the_edge_of_the_cache: 5,
        _World.far_ahead: 1,
        _World.again: 5,
        _World.at_an_equal_stamp: 4,
        _World.flip: 1.5,
        _World.reparent: 4,
        _World.into_a_loop: 0.5,
        _World.unnormalized: 3,
        _World.refused: 4,
        _World.slashed: 1,
        _World.clear: 0.5,
    }
)
QUESTIONS = _weighted(
    {
        _ask(_World.question, "lookup"): 40,
        _ask(_World.question, "can_transform"): 12,
        _ask(_World.full_question, "lookup_full"): 14,
        _ask(_World.full_question, "can_transform_full"): 6,
        _World.latest_common_time: 10,
        _ask(_World.full_question, "chain"): 6,
        _World.frame_exists: 1,
        _ask(_World.dump, "frame_names"): 1,
        _ask(_World.dump, "all_frames_as_string"): 2,
        _ask(_World.dump, "all_frames_as_yaml"): 3,
        _World.all_frames_as_dot: 2,
    }
)
