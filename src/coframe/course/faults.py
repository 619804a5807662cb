# SPDX-License-Identifier: Apache-2.0
"""Deliberately broken systems, each with one fault for students to find."""

from __future__ import annotations

import re
import zlib
from typing import NamedTuple

from coframe.course.running import NamedCommand, module_program
from coframe.course.translation.language import ENGLISH, Language

__all__ = ["FAULTS", "Fault", "draw", "named_fault"]


class Fault(NamedTuple):
    """A deliberately broken system to diagnose.

    Attributes:
        name: The name of the fault, which is the answer.
        explanation: The cause of the fault, and how to find it.
        programs: The programs of the system.
        other_names: The answer in other words; an answer that contains all words of one of them is right.
    """

    name: str
    explanation: str
    programs: tuple[NamedCommand, ...]
    other_names: tuple[str, ...] = ()


def _node(name: str, *parameters: str, title: str = "") -> NamedCommand:
    words = [word for parameter in parameters for word in ("-p", parameter)]
    title = title or name
    remap = ("-r", f"__node:={title}") if title != name else ()
    arguments = ("--ros-args", *remap, *words) if words or remap else ()
    return module_program(title, f"coframe.lab.{name}", *arguments)


def _node_with_fault(fault: str, name: str) -> NamedCommand:
    """Return a node of the lab with a fault from coframe.course._faulty_node."""
    return module_program(name, "coframe.course._faulty_node", fault, name)


_STATIC, _DYNAMIC = _node("static_tf_broadcaster"), _node("dynamic_tf_broadcaster")
_LISTENER, _SENSOR = _node("tf_listener"), _node("sensor_transform")
_LIDAR = _node("simulated_lidar", "fixed_frame:=base_link")
_DESCRIPTION = module_program("robot_description", "coframe.course._description")  # the doctor compares with it
_JOINTS = _node("dynamic_tf_broadcaster", "publish_joint_states:=true", title="joint_driver")


def _programs_with_description(fault: str) -> tuple[NamedCommand, ...]:
    """Return the system with joint states and a robot description, in which the arm has a fault."""
    arm = _node_with_fault(fault, "dynamic_tf_broadcaster")
    return _DESCRIPTION, _JOINTS, _STATIC, arm, _LISTENER, _LIDAR, _SENSOR


_STATIC_ON_LINK = _node(
    "static_tf_broadcaster", "base_frame:=link1", "imu_frame:=second_imu", "camera_frame:=second_camera", title="mounts"
)
_LONG_ARM = _node("dynamic_tf_broadcaster", "link_lengths:=[0.9, 0.4]")
_SQRT_HALF = 0.5**0.5
_IGNORED_WORDS = frozenset(
    ("a", "an", "the", "of", "in", "is", "are", "it", "to", "and", "has", "have", "its", "transforms")
)
# Words of answers, and the word for the same meaning in the names above.
_SYNONYMS = {
    "misspelt": "misspelled",
    "mistyped": "misspelled",
    "typo": "misspelled",
    "misspelling": "misspelled",
    "two": "second",
    "double": "second",
    "doubled": "second",
    "duplicate": "second",
    "several": "second",
    "another": "second",
    "broadcasters": "publisher",
    "swap": "swapped",
    "exchange": "swapped",
    "exchanged": "swapped",
    "switched": "swapped",
    "interchanged": "swapped",
    "incorrect": "wrong",
    "bad": "wrong",
    "absent": "missing",
    "delayed": "late",
    "timestamp": "stamp",
    "cyclic": "cycle",
}

FAULTS = (
    Fault(
        "late broadcaster",
        "The sensor mounts are published 20 s after everything else. Until then, every scan is dropped.",
        (_node_with_fault("late", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("late static broadcaster", "static delay", "mounts late", "started late", "late publisher"),
    ),
    Fault(
        "misspelled frame",
        "The lidar is mounted as 'lidar_lnik', but its scans are in 'lidar_link'.",
        (_node("static_tf_broadcaster", "lidar_frame:=lidar_lnik"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("misspelled name", "wrong frame name", "lidar_lnik", "wrong spelling"),
    ),
    Fault(
        "clock offset",
        "The stamps of the arm are 5 s behind the clock, as if the clock of its computer were wrong.",
        (_STATIC, _node_with_fault("offset", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("stamps behind", "clock behind", "wrong clock", "old stamps arm", "time offset"),
    ),
    Fault(
        "missing static transform",
        "No node publishes the sensor mounts, so the lidar is not connected to the robot.",
        (_DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("no static transform", "missing mount", "static broadcaster missing", "missing transform lidar_link"),
    ),
    Fault(
        "second publisher",
        "Two nodes publish the arm with different lengths: it flickers between two poses.",
        (
            _STATIC,
            _DYNAMIC,
            _node("dynamic_tf_broadcaster", "link_lengths:=[0.3, 0.6]", title="arm_driver"),
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
        ("second source", "second broadcaster", "duplicate publisher"),
    ),
    Fault(
        "dropout",
        "The arm is not published for 1 s in every 4 s.",
        (_STATIC, _node_with_fault("dropout", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("gap", "interruption", "pauses", "stops for 1 s"),
    ),
    Fault(
        "swapped quaternion order",
        "The rotation of the camera is in the order w, x, y, z instead of x, y, z, w.",
        (
            _DESCRIPTION,
            _node("static_tf_broadcaster", f"camera_rotation:=[{_SQRT_HALF}, 0.0, {_SQRT_HALF}, 0.0]"),
            _DYNAMIC,
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
        ("w first", "quaternion order", "wxyz", "w x y z"),
    ),
    Fault(
        "degrees",
        "The joint angles are in degrees, but are used as radians: the arm turns around several times.",
        _programs_with_description("degrees"),
        ("degree",),
    ),
    Fault(
        "wrong parent",
        "The second link is mounted on base_link instead of link1.",
        (_DESCRIPTION, _STATIC, _node_with_fault("wrong parent", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("other parent", "parent link2", "link2 on base_link"),
    ),
    Fault(
        "dead listener",
        "The listener runs, but its first failed lookup has ended its timer: /end_effector_pose has no messages.",
        (_STATIC, _DYNAMIC, _node_with_fault("dead", "tf_listener"), _LIDAR, _SENSOR),
        ("listener dead", "listener silent", "timer cancelled", "listener stops", "no pose published"),
    ),
    Fault(
        "zero quaternion",
        "The rotation of the camera has four zeros, so tf2 rejects the transform: camera_link does not exist.",
        (_node_with_fault("zero quaternion", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("quaternion of zeros", "quaternion 0", "rotation not set", "invalid quaternion"),
    ),
    Fault(
        "rounded quaternion",
        "The rotation of the camera has the components 0.707, so the length of its quaternion is not 1.",
        (_node_with_fault("rounded quaternion", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("quaternion not normalized", "unnormalized quaternion", "0.707", "quaternion length"),
    ),
    Fault(
        "leading slash",
        "The camera is mounted as '/camera_link' on '/end_effector': names are compared letter by letter.",
        (_node_with_fault("slash", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("slash",),
    ),
    Fault(
        "millimeters",
        "The position of the camera is in millimeters: it is 50 m in front of the gripper.",
        (
            _DESCRIPTION,
            _node_with_fault("millimeters", "static_tf_broadcaster"),
            _DYNAMIC,
            _LISTENER,
            _LIDAR,
            _SENSOR,
        ),
        ("wrong unit", "millimeter", "mm instead of m", "units"),
    ),
    Fault(
        "exchanged frames",
        "Parent and child of the mount of the camera are exchanged, so end_effector has two parents.",
        (_node_with_fault("exchanged frames", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("parent child swapped", "parent child exchanged", "inverted transform camera", "swapped frames"),
    ),
    Fault(
        "static transforms on /tf",
        "The sensor mounts are sent once on /tf: listeners that join later never receive them.",
        (_node_with_fault("static on tf", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("static on tf", "wrong broadcaster mounts", "transformbroadcaster for static"),
    ),
    Fault(
        "dynamic transforms on /tf_static",
        "The moving arm is sent on /tf_static: each message changes the past, and nothing is interpolated.",
        (_STATIC, _node_with_fault("dynamic on tf_static", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("dynamic on tf_static", "arm on tf_static", "statictransformbroadcaster for dynamic", "moving static"),
    ),
    Fault(
        "missing stamp",
        "The stamps of the arm are never set: they are 0, as in the year 1970.",
        (_STATIC, _node_with_fault("no stamp", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("stamp 0", "no stamp", "stamp not set", "zero stamp", "stamp never set"),
    ),
    Fault(
        "future stamps",
        "The stamps of the arm are 5 s ahead of the clock.",
        (_STATIC, _node_with_fault("ahead", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("stamps ahead", "clock ahead", "stamp in future"),
    ),
    Fault(
        "frozen stamps",
        "All transforms of the arm have the stamp of the first one: only that one is stored.",
        (_STATIC, _node_with_fault("frozen", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("same stamp", "stamp never changes", "constant stamp", "repeated stamp", "one stamp"),
    ),
    Fault(
        "pose jumps",
        "In every 40th message, the arm is 0.5 m beside its place.",
        (_STATIC, _node_with_fault("jumps", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("jump", "outlier", "spike"),
    ),
    Fault(
        "whole angle",
        "The quaternions of the joints use the whole angle instead of half of it: the arm turns twice as far.",
        _programs_with_description("whole angle"),
        ("half angle", "double angle", "angle doubled", "angle twice"),
    ),
    Fault(
        "wrong sign",
        "The joints turn in the wrong direction: the signs of their angles are changed.",
        _programs_with_description("sign"),
        ("sign of angle", "sign changed", "wrong direction", "inverted joints", "negated angle"),
    ),
    Fault(
        "exchanged joints",
        "Each joint has the angle of the other one, as if the order in /joint_states were always the same.",
        _programs_with_description("exchanged joints"),
        ("joints swapped", "joint order", "swapped joints"),
    ),
    Fault(
        "loop",
        "link1 is mounted on end_effector, which is mounted on it: the arm has no root.",
        (_STATIC, _node_with_fault("loop", "dynamic_tf_broadcaster"), _LISTENER, _LIDAR, _SENSOR),
        ("cycle", "circular tree", "tree loop"),
    ),
    Fault(
        "mount in degrees",
        "The camera is turned by 90 radians instead of 90 degrees.",
        (_node_with_fault("mount in degrees", "static_tf_broadcaster"), _DYNAMIC, _LISTENER, _LIDAR, _SENSOR),
        ("camera degrees", "90 radians", "static degrees"),
    ),
    Fault(
        "unknown scan frame",
        "The scans are in the frame 'laser', which no node publishes.",
        (
            _STATIC,
            _DYNAMIC,
            _LISTENER,
            _node("simulated_lidar", "fixed_frame:=base_link", "frame:=laser"),
            _SENSOR,
        ),
        ("wrong scan frame", "frame of scan", "laser frame", "scan frame_id", "wrong frame_id"),
    ),
    Fault(
        "second parent",
        "Two nodes give lidar_link different parents, base_link and link1: it jumps.",
        (_STATIC, _DYNAMIC, _STATIC_ON_LINK, _LISTENER, _LIDAR, _SENSOR),
        ("several parents", "lidar_link second parent", "frame second parent"),
    ),
    Fault(
        "wrong link length",
        "The first link is 0.9 m long in the transforms, but 0.5 m in the description.",
        (_DESCRIPTION, _JOINTS, _STATIC, _LONG_ARM, _LISTENER, _LIDAR, _SENSOR),
        ("wrong length", "link length", "length 0.9", "wrong dimension"),
    ),
    Fault(
        "silent lidar",
        "The lidar has a publisher of /scan, but publishes no scan.",
        (_STATIC, _DYNAMIC, _LISTENER, _node_with_fault("silent lidar", "simulated_lidar"), _SENSOR),
        ("no scan", "dead lidar", "lidar dead", "lidar publishes nothing", "missing scans"),
    ),
)


def draw(seed: str) -> int:
    """Return the number of the fault that belongs to a seed, from 1: the same for the same text on every machine.

    Args:
        seed: Any text, such as the number of a student.
    """
    return 1 + zlib.crc32(f"{seed}".encode()) % len(FAULTS)


def named_fault(answer: str, language: Language = ENGLISH) -> Fault | None:
    """Return the fault that an answer describes in any words, or None if it names none or several.

    Args:
        answer: The answer, in English, or a name in the given language.
        language: The language of the names.

    Example:
        >>> named_fault("Two publishers!").name, named_fault("MISSPELT frame").name
        ('second publisher', 'misspelled frame')
    """
    words = _words(answer)
    scores = {fault.name: _score(fault, words, language) for fault in FAULTS}
    best = max(scores.values())
    found = [fault for fault in FAULTS if scores[fault.name] == best]
    return found[0] if best and len(found) == 1 else None


def _score(fault: Fault, words: frozenset[str], language: Language) -> int:
    """Return the number of words of the longest name of a fault that an answer contains completely, or 0."""
    names = [_words(name) for name in (fault.name, language.text(fault.name), *fault.other_names)]
    return max((2 * len(name) + (name == words) for name in names if name <= words), default=0)


def _words(text: str) -> frozenset[str]:
    """Return the words of an answer without endings, with one word for each meaning."""
    words = re.findall(r"[\w./]+", text.casefold().replace("-", " "))
    stems = (word.strip("./") for word in words)
    return frozenset(_SYNONYMS.get(word, _stem(word)) for word in stems if word and word not in _IGNORED_WORDS)


def _stem(word: str) -> str:
    word = _SYNONYMS.get(word, word)
    stem = word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith("ss") else word
    return _SYNONYMS.get(stem, stem)
