# SPDX-License-Identifier: Apache-2.0
"""A URDF parser that loads what ROS loads, and reports contradictions and faults with their line."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, get_args

from coframe.errors import RobotDescriptionError
from coframe.robots import _document
from coframe.robots._robot import Robot
from coframe.robots._shapes import Materials, origin, parse_link
from coframe.robots._structure import order_joints, remove_faulty_mimics
from coframe.robots.parts import Joint, JointLimits, JointType, Mimic

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.robots._document import Element
    from coframe.robots.parts import Vector

__all__ = ["parse_urdf"]

_JOINT_TYPES: tuple[JointType, ...] = get_args(JointType)
_NEEDS_LIMITS = ("revolute", "prismatic")
_VERSION = re.compile(r"\s*(\d{1,9})\.(\d{1,9})\s*", re.ASCII)
_NEWEST_VERSION = (1, 2)
# The attributes that versions after 1.0 have added, by element.
_ADDED_ATTRIBUTES = {
    "origin": {"quat_xyzw": (1, 1)},
    "limit": dict.fromkeys(("acceleration", "deceleration", "jerk"), (1, 2)),
}


def parse_urdf(text: str | bytes) -> Robot:
    """Parse a URDF document and return the robot.

    Args:
        text: The document. Xacro must be expanded first, as :func:`coframe.robots.load` does.

    Returns:
        The robot. Its `warnings` contain the faults that do not affect the frames, such as a visual without a shape,
        and faults that ROS accepts, such as a second <origin>, which are interpreted as in ROS.

    Raises:
        RobotDescriptionError: The document is not valid URDF, for example because of loops, links with two parents,
            duplicate names, origins that are not numbers, missing or swapped limits, or because it has no links. The
            message contains the line number.

    Example:
        >>> from coframe.robots import parse_urdf
        >>> robot = parse_urdf('''<robot name="arm">
        ...   <link name="base"/> <link name="tip"/>
        ...   <joint name="turn" type="continuous">
        ...     <parent link="base"/> <child link="tip"/>
        ...     <origin xyz="1 0 0"/> <axis xyz="0 0 1"/>
        ...   </joint>
        ... </robot>''')
        >>> robot.frames({"turn": 1.5})["tip"].rpy.round(3).tolist()
        [0.0, 0.0, 1.5]
    """
    read = _document.read(text)
    _check_kind(read.root)
    xacro = next((element for element in read.root.children if element.tag.startswith("xacro:")), None)
    try:
        robot = _robot(read)
    except RobotDescriptionError:
        if xacro is not None:
            xacro.fail(f"<{xacro.tag}> is xacro, not URDF", hint=_XACRO_HINT)
        raise
    return robot


_XACRO_HINT = "Save it as a file with the suffix .xacro and load that file."


def _check_kind(root: Element) -> None:
    if root.tag != "robot":
        other = {"sdf": "SDF", "mujoco": "MJCF"}.get(root.tag)
        root.fail(
            f"the outermost element is <{root.tag}>, not <robot>",
            hint=f"The document is {other}, not URDF." if other else "",
        )


def _robot(read: _document.Document) -> Robot:
    root = read.root
    for element in root.children:
        if element.tag.startswith("xacro:"):
            element.warn(f"<{element.tag}> is xacro, not URDF, and has no effect. {_XACRO_HINT}")
    _ignore_newer(root, _version(root))
    materials = Materials(root)
    parts = _named_elements(root, "link")
    if not parts:
        root.fail("the robot has no links", hint="Add at least one <link>.")
    links = {name: parse_link(name, element, materials) for name, element in parts.items()}
    for name, element in parts.items():
        if name.startswith("/"):
            element.warn(f"link {name!r} begins with a slash, which tf2 removes")
    elements = _named_elements(root, "joint")
    spellings = {name.strip(): name for name in parts} | {name: name for name in parts}
    joints = [_joint(name, element, spellings) for name, element in elements.items()]
    return Robot(
        name=root.attributes.get("name", "").strip(),
        links=links,
        joints=order_joints(links, remove_faulty_mimics(joints, elements), elements, root),
        materials=materials.defined,
        text=read.text,
        warnings=tuple(dict.fromkeys(read.warnings)),
    )


def _version(root: Element) -> tuple[int, int]:
    written = root.attributes.get("version")
    if written is None:
        return 1, 0
    found = _VERSION.fullmatch(written)
    version = (1, 0) if found is None else (int(found[1]), int(found[2]))
    if found is None or not (1, 0) <= version <= _NEWEST_VERSION:
        root.warn(f"the version {written!r} is unknown. ROS reads the versions 1.0, 1.1 and 1.2")
    return version


def _ignore_newer(root: Element, version: tuple[int, int]) -> None:
    """Remove the attributes that newer versions have added from all elements, as ROS ignores them."""
    pending = [root]
    while pending:
        element = pending.pop()
        pending += element.children
        for attribute, first in _ADDED_ATTRIBUTES.get(element.tag, {}).items():
            if version < first and element.attributes.pop(attribute, None) is not None:
                element.warn(f'{attribute} is ignored, because it needs <robot version="{first[0]}.{first[1]}">')


def _named_elements(root: Element, tag: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in root.all(tag):
        name = element.attributes.get("name")
        if name is None:
            element.fail(f"<{tag}> needs the attribute name")
        if name in found:
            element.fail(f"the document has a second {tag} {name!r}; the first one is on line {found[name].line}")
        if not name.strip() or name != name.strip():
            element.warn(f"the name {name!r} of a {tag} is empty, or begins or ends with a space")
        found[name] = element
    return found


def _joint(name: str, element: Element, links: Mapping[str, str]) -> Joint:
    parent, child = _link_name(element, "parent", links), _link_name(element, "child", links)
    kind = next((known for known in _JOINT_TYPES if known == element.attributes.get("type")), None)
    if kind is None:
        written = element.attributes.get("type", "")
        element.fail(
            f"joint {name!r} has the unknown type {written!r}", hint=f"The types are {', '.join(_JOINT_TYPES)}."
        )
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        origin=origin(element, parent, child),
        axis=_axis(element, name, kind),
        limits=_limits(element, name, kind),
        mimic=_mimic(element, name, kind),
    )


def _link_name(joint: Element, role: str, links: Mapping[str, str]) -> str:
    """Return the link that a joint names. `links` contains each name with and without surrounding spaces."""
    element = joint.required_child(role)
    written = element.attributes.get("link") or element.text("link")
    return links.get(written) or links.get(written.strip(), written)


def _axis(joint: Element, name: str, kind: JointType) -> Vector:
    element = joint.one("axis")
    if element is None or kind in {"fixed", "floating"}:
        # The default plane of a planar joint is that of x and y, as in MoveIt and Pinocchio.
        return (0.0, 0.0, 1.0) if kind == "planar" else (1.0, 0.0, 0.0)
    x, y, z = element.numbers("xyz", 3, (1.0, 0.0, 0.0))
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        if kind == "planar":
            element.warn(f"the axis of joint {name!r} is zero; z is used")
            return 0.0, 0.0, 1.0
        element.warn(f"the axis of joint {name!r} is zero, so the joint does not move")
        return 0.0, 0.0, 0.0
    x, y, z = x / largest, y / largest, z / largest
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length


def _limits(joint: Element, name: str, kind: JointType) -> JointLimits | None:
    element, safety = joint.one("limit"), joint.one("safety_controller")
    if element is None and kind in _NEEDS_LIMITS:
        joint.fail(
            f"joint {name!r} is {kind} and has no <limit>",
            hint='Add <limit lower="..." upper="..." effort="..." velocity="..."/>'
            + (", or make it continuous." if kind == "revolute" else "."),
        )
    if element is None and safety is None:
        return None
    needed = kind in _NEEDS_LIMITS
    lower, upper = (_limit_value(element, part, required=needed) for part in ("lower", "upper"))
    effort, velocity = (_limit_value(element, part) for part in ("effort", "velocity"))
    if element is not None and needed:
        lower, upper = lower or 0.0, upper or 0.0
        if lower > upper:
            element.fail(f"joint {name!r} has the lower limit {lower:g} above the upper limit {upper:g}")
    soft_lower, soft_upper = (_limit_value(safety, part) for part in ("soft_lower_limit", "soft_upper_limit"))
    rates = (_limit_value(element, part) for part in ("acceleration", "deceleration", "jerk"))
    return JointLimits(lower, upper, effort, velocity, soft_lower, soft_upper, *rates)


def _limit_value(element: Element | None, attribute: str, *, required: bool = False) -> float | None:
    """Return a limit, or None if it is not given, or is not valid and not required."""
    if element is None or attribute not in element.attributes:
        return None
    if required:
        return element.number(attribute)
    return element.parse_or_warn(lambda limit: limit.number(attribute), f"the limit {attribute}")


def _mimic(joint: Element, name: str, kind: JointType) -> Mimic | None:
    element = joint.one("mimic")
    if element is None:
        return None
    if kind == "fixed":  # usually a gripper joint that was fixed later
        element.warn(f"joint {name!r} is fixed, so its <mimic> has no effect")
        return None
    return Mimic(element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0))
