# SPDX-License-Identifier: Apache-2.0
"""The tree that links and joints form, and the joints that mimic others."""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from coframe.robots._document import Element
    from coframe.robots.parts import Joint

__all__ = ["order_joints", "remove_faulty_mimics"]


def order_joints(
    links: Iterable[str], joints: list[Joint], elements: Mapping[str, Element], root: Element
) -> dict[str, Joint]:
    """Return the joints by name, level by level from the root link.

    Raises:
        RobotDescriptionError: A joint refers to a link that does not exist, a link has two parents, there is a loop, or
            there are several roots.
    """
    parent_joint = _parent_joints(set(links), joints, elements)
    roots = [link for link in links if link not in parent_joint]
    if len(roots) > 1:
        names = ", ".join(repr(link) for link in roots[:10]) + (", ..." if len(roots) > 10 else "")
        root.fail(f"{len(roots)} links have no parent: {names}", hint="Make all but one of them the child of a joint.")
    children: defaultdict[str, list[Joint]] = defaultdict(list)
    for joint in joints:
        children[joint.parent].append(joint)
    order: dict[str, Joint] = {}
    level = roots
    while level:
        below = [joint for link in level for joint in children[link]]
        order.update((joint.name, joint) for joint in below)
        level = [joint.child for joint in below]
    for joint in joints:
        if joint.name not in order:
            _fail_on_loop(joint, parent_joint, elements)
    return order


def _parent_joints(links: set[str], joints: list[Joint], elements: Mapping[str, Element]) -> dict[str, Joint]:
    """Return the joint above each link, by link."""
    found: dict[str, Joint] = {}
    for joint in joints:
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                elements[joint.name].fail(f"joint {joint.name!r} has the {role} {link!r}, which is not a link")
        if joint.parent == joint.child:
            elements[joint.name].fail(f"joint {joint.name!r} connects the link {joint.child!r} to itself")
        other = found.setdefault(joint.child, joint)
        if other is not joint:
            elements[joint.name].fail(
                f"link {joint.child!r} has two parents: {other.parent!r} by joint {other.name!r}, and {joint.parent!r} "
                f"by joint {joint.name!r}"
            )
    return found


def _fail_on_loop(joint: Joint, parent_joint: Mapping[str, Joint], elements: Mapping[str, Element]) -> None:
    seen: dict[str, Joint] = {}
    while joint.child not in seen:
        seen[joint.child] = joint
        joint = parent_joint[joint.parent]
    loop = list(seen)[list(seen).index(joint.child) :]
    names = " <- ".join([*loop[:10], *(["..."] if len(loop) > 10 else []), loop[0]])
    elements[joint.name].fail(f"the links form a loop: {names}", hint="URDF describes trees. Remove one of the joints.")


def remove_faulty_mimics(joints: list[Joint], elements: Mapping[str, Element]) -> list[Joint]:
    """Return the joints, without the mimic tags that cannot be followed, which cause warnings.

    A joint cannot mimic a joint that does not exist or is fixed, planar or floating, and joints cannot mimic each other
    in a circle. ROS accepts such tags, and they have no effect there.
    """
    by_name = {joint.name: joint for joint in joints}
    faults = {joint.name: fault for joint in joints if (fault := _fault(joint, by_name))}
    leaders = {j.name: j.mimic.joint for j in joints if j.mimic is not None and j.name not in faults}
    for circle in _mimic_cycles(leaders):
        faults |= dict.fromkeys(circle, f"joints mimic each other in a loop: {', '.join(circle[:10])}")
    for name, fault in faults.items():
        elements[name].warn(f"{fault}; the <mimic> of joint {name!r} is ignored")
    return [dataclasses.replace(joint, mimic=None) if joint.name in faults else joint for joint in joints]


def _fault(follower: Joint, by_name: Mapping[str, Joint]) -> str:
    """Return why a joint cannot mimic another one, or "" if there is no problem."""
    if follower.mimic is None:
        return ""
    leader = by_name.get(follower.mimic.joint)
    if leader is None:
        return f"joint {follower.name!r} mimics {follower.mimic.joint!r}, which is not a joint"
    for joint in (follower, leader):
        if joint.size != 1:
            return f"joint {follower.name!r} mimics {leader.name!r}, but {joint.name!r} is {joint.type}"
    return ""


def _mimic_cycles(leaders: Mapping[str, str]) -> Iterator[list[str]]:
    """Return the joints of each circle of joints that mimic each other."""
    checked: set[str] = set()
    for start in leaders:
        path: dict[str, int] = {}
        name = start
        while name in leaders and name not in checked and name not in path:
            path[name] = len(path)
            name = leaders[name]
        if name in path:
            yield list(path)[path[name] :]
        checked.update(path)
