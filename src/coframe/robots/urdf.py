"""URDF, read strictly: what contradicts itself is refused with its line, not guessed at."""

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
    """A robot from the text of its URDF.

    Args:
        text: The whole document; xacro must have been expanded before (:func:`coframe.robots.load` does so).

    Returns:
        The robot. What means nothing but does no harm to the frames, such as a material that nobody defines, is in
        its ``warnings``.

    Raises:
        RobotDescriptionError: It is no URDF or contradicts itself: loops, links with two parents, names that occur
            twice, values that are no numbers, limits that are missing, no links at all. The text names the line.

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
        f"line {element.line}: link {name!r} begins with a slash, which tf2 leaves off"
        for name, element in parts.items()
        if name.startswith("/")
    ]
    if not links:
        root.refuse("the robot has no links", hint="A description needs one <link> at least.")
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
        root.refuse(
            f"the outermost element is <{root.tag}>, not <robot>", hint=f"It is {other}, not URDF." if other else ""
        )
    for element in root.children:
        if element.tag.startswith("xacro:"):
            element.refuse(f"<{element.tag}> is xacro, not URDF", hint="Load it from a file that ends with .xacro.")


def _named(root: Element, tag: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in root.all(tag):
        name = element.text("name")
        if name in found:
            element.refuse(f"there is a second {tag} {name!r}; the first one is on line {found[name].line}")
        found[name] = element
    return found


def _joint(element: Element, warnings: list[str]) -> Joint:
    name, parent, child = element.text("name"), _link_name(element, "parent"), _link_name(element, "child")
    kind = next((known for known in _JOINT_TYPES if known == element.attributes.get("type")), None)
    if kind is None:
        written = element.attributes.get("type", "")
        element.refuse(f"joint {name!r} has the type {written!r}", hint=f"URDF knows {', '.join(_JOINT_TYPES)}.")
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
        # A planar joint without one moves in the plane of x and y, as MoveIt and Pinocchio have it.
        return (0.0, 0.0, 1.0) if kind == "planar" else (1.0, 0.0, 0.0)
    x, y, z = element.numbers("xyz", 3, (1.0, 0.0, 0.0))
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        element.refuse(f"the axis of joint {name!r} is zero", hint="Turns about what, or slides along what?")
    x, y, z = x / largest, y / largest, z / largest
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length


def _limits(joint: Element, name: str, kind: JointType) -> Limits | None:
    element, safety = joint.one("limit"), joint.one("safety_controller")
    if element is None and kind in _NEEDS_LIMITS:
        joint.refuse(
            f"joint {name!r} is {kind} and has no <limit>",
            hint='Give it <limit lower="..." upper="..." effort="..." velocity="..."/>'
            + (", or make it continuous." if kind == "revolute" else "."),
        )
    if element is None and safety is None:
        return None
    lower, upper, effort, velocity = (_given(element, part) for part in _LIMITS)
    if element is not None and kind in _NEEDS_LIMITS:
        lower, upper = lower or 0.0, upper or 0.0
        if lower > upper:
            element.refuse(f"joint {name!r} has the lower limit {lower:g} above the upper one {upper:g}")
    soft_lower, soft_upper = (_given(safety, part) for part in ("soft_lower_limit", "soft_upper_limit"))
    return Limits(lower, upper, effort, velocity, soft_lower, soft_upper)


def _given(element: Element | None, attribute: str) -> float | None:
    return element.number(attribute) if element is not None and attribute in element.attributes else None


def _mimic(joint: Element, name: str, kind: JointType, warnings: list[str]) -> Mimic | None:
    element = joint.one("mimic")
    if element is None:
        return None
    if kind == "fixed":  # what is left when somebody locks a gripper
        warnings.append(f"line {element.line}: joint {name!r} is fixed and mimics nothing")
        return None
    return Mimic(element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0))
