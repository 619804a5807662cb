# SPDX-License-Identifier: Apache-2.0
"""The answers of coframe to the operations of a scenario, in the format of debian_side.py."""

import coframe
from coframe import _core


class CoframeSide:
    """A buffer that runs operations."""

    def __init__(self, cache):
        self.buffer = coframe.Buffer(cache)

    def answer(self, operation):
        try:
            return getattr(self, operation[0])(*operation[1:])
        except coframe.TransformException as error:
            return "raises", type(error).__name__, str(error)

    def set(self, parent, child, stamp, values, static, authority):
        refusals = self.buffer._set_values(parent, child, stamp, *values, static, authority)
        log = _core.insert_texts(refusals, parent, child, stamp, *values, authority) if refusals else ()
        return "log", tuple(log)

    def clear(self):
        return "done", self.buffer.clear()

    def lookup(self, *asked):
        return _pose(self.buffer.lookup(*asked))

    def lookup_full(self, *asked):
        return _pose(self.buffer._lookup_full(*asked))

    def can_transform(self, *asked):
        return "possible", self.buffer.can_transform(*asked), self.buffer._why_not(*asked)

    def can_transform_full(self, *asked):
        return "possible", self.buffer._can_transform_full(*asked), self.buffer._why_not_full(*asked)

    def latest_common_time(self, *asked):
        return "stamp", self.buffer.latest_common_time(*asked)

    def chain(self, *asked):
        return "names", self.buffer.chain(*asked)

    def frame_exists(self, name):
        return "exists", self.buffer.frame_exists(name)

    def frame_names(self):
        return "names", self.buffer.frame_names()

    def all_frames_as_string(self):
        return "text", self.buffer.all_frames_as_string()

    def all_frames_as_yaml(self):
        return "text", self.buffer.all_frames_as_yaml()

    def all_frames_as_dot(self, now):
        return "text", self.buffer.all_frames_as_dot(now)


def _pose(transform):
    return "pose", transform.stamp, transform.values
