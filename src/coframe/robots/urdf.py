# SPDX-License-Identifier: Apache-2.0
"""A strict URDF parser, which reports contradictions with their line instead of guessing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, get_args

from coframe.robots import document
from coframe.robots.parts import Joint, JointType, Limits, Mimic
from coframe.robots.robot import Robot
from coframe.robots.shapes import Materials, origin, parse_link
from coframe.robots.structure import check_mimics, ordered

if TYPE_CHECKING:
    from coframe.robots.document import Element
    from coframe.robots.parts import Vector

__all__ = ["parse_urdf"]

_JOINT_TYPES: tuple[JointType, ...] = get_args(JointType)
_LIMITS = ("lower", "upper", "effort", "velocity")
_NEEDS_LIMITS = ("revolute", "prismatic")


def parse_urdf(text: str | bytes) -> Robot:
    """Parse a URDF document and return the robot.

    Args:
        text: The document. Xacro must be expanded first, as :func:`coframe.robots.load` does.

    Returns:
        The robot. Problems that do not affect the frames, such as an undefined material, are in its `warnings`.

    Raises:
        RobotDescriptionError: The document is not valid URDF, for example because of loops, links with two parents,
            duplicate names, values that are not numbers, missing limits, or because it has no links. The text contains
            the line.

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
    text = document.decoded(text)
    root = document.parse(text)
    _check_kind(root)
    warnings: list[str] = []
    materials = Materials(root, warnings)
    parts = _named(root, "link")
    links = {name: parse_link(element, materials) for name, element in parts.items()}
    warnings += [
        f"line {element.line}: link {name!r} begins with a slash, which tf2 removes"
        for name, element in parts.items()
        if name.startswith("/")
    ]
    if not links:
        root.fail("the robot has no links", hint="Add at least one <link>.")
    elements = _named(root, "joint")
    joints = [_joint(element, warnings) for element in elements.values()]
    check_mimics(joints, elements)
    return Robot(
        name=root.attributes.get("name", "").strip(),
        links=links,
        joints=ordered(links, joints, elements, root),
        materials=materials.defined,
        text=text,
        warnings=tuple(warnings),
    )


def _check_kind(root: Element) -> None:
    if root.tag != "robot":
        other = {"sdf": "SDF", "mujoco": "MJCF"}.get(root.tag)
        root.fail(
            f"the outermost element is <{root.tag}>, not <robot>",
            hint=f"The document is {other}, not URDF." if other else "",
        )
    for element in root.children:
        if element.tag.startswith("xacro:"):
            element.fail(
                f"<{element.tag}> is xacro, not URDF",
                hint="Save it as a file with the suffix .xacro and load that file.",
            )


def _named(root: Element, tag: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in root.all(tag):
        name = element.text("name")
        if name in found:
            element.fail(f"there is a second {tag} {name!r}; the first one is on line {found[name].line}")
        found[name] = element
    return found


def _joint(element: Element, warnings: list[str]) -> Joint:
    name, parent, child = element.text("name"), _link_name(element, "parent"), _link_name(element, "child")
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
        mimic=_mimic(element, name, kind, warnings),
    )


def _link_name(joint: Element, role: str) -> str:
    return joint.need(role).text("link")


def _axis(joint: Element, name: str, kind: JointType) -> Vector:
    element = joint.one("axis")
    if element is None or kind in {"fixed", "floating"}:
        # The default plane of a planar joint is that of x and y, as in MoveIt and Pinocchio.
        return (0.0, 0.0, 1.0) if kind == "planar" else (1.0, 0.0, 0.0)
    x, y, z = element.numbers("xyz", 3, (1.0, 0.0, 0.0))
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        element.fail(f"the axis of joint {name!r} is zero", hint='Give it a direction, such as xyz="0 0 1".')
    x, y, z = x / largest, y / largest, z / largest
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length


def _limits(joint: Element, name: str, kind: JointType) -> Limits | None:
    element, safety = joint.one("limit"), joint.one("safety_controller")
    if element is None and kind in _NEEDS_LIMITS:
        joint.fail(
            f"joint {name!r} is {kind} and has no <limit>",
            hint='Add <limit lower="..." upper="..." effort="..." velocity="..."/>'
            + (", or make it continuous." if kind == "revolute" else "."),
        )
    if element is None and safety is None:
        return None
    lower, upper, effort, velocity = (_given(element, part) for part in _LIMITS)
    if element is not None and kind in _NEEDS_LIMITS:
        lower, upper = lower or 0.0, upper or 0.0
        if lower > upper:
            element.fail(f"joint {name!r} has the lower limit {lower:g} above the upper limit {upper:g}")
    soft_lower, soft_upper = (_given(safety, part) for part in ("soft_lower_limit", "soft_upper_limit"))
    return Limits(lower, upper, effort, velocity, soft_lower, soft_upper)


def _given(element: Element | None, attribute: str) -> float | None:
    return element.number(attribute) if element is not None and attribute in element.attributes else None


def _mimic(joint: Element, name: str, kind: JointType, warnings: list[str]) -> Mimic | None:
    element = joint.one("mimic")
    if element is None:
        return None
    if kind == "fixed":  # usually a gripper joint that was fixed later
        warnings.append(f"line {element.line}: joint {name!r} is fixed, so its <mimic> has no effect")
        return None
    return Mimic(element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0))
