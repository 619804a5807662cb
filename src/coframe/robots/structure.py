# SPDX-License-Identifier: Apache-2.0
"""Validation that links and joints form one tree, and that mimic joints follow an existing joint."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from coframe.robots.document import Element
    from coframe.robots.parts import Joint

__all__ = ["check_mimics", "ordered"]


def ordered(
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


def check_mimics(joints: list[Joint], elements: Mapping[str, Element]) -> None:
    """Check that every mimic joint follows, directly or indirectly, a joint without a mimic tag.

    Raises:
        RobotDescriptionError: The other joint does not exist, one of them is fixed, planar or floating, or the joints
            mimic each other in a circle.
    """
    by_name = {joint.name: joint for joint in joints}
    checked: set[str] = set()
    for joint in joints:
        chain: dict[str, Joint] = {}
        follower = joint
        while follower.mimic is not None and follower.name not in checked:
            if follower.name in chain:
                elements[joint.name].fail(f"joints mimic each other in a circle: {', '.join(chain)}")
            chain[follower.name] = follower
            follower = _leader(follower, by_name, elements)
        checked.update(chain)


def _leader(follower: Joint, by_name: Mapping[str, Joint], elements: Mapping[str, Element]) -> Joint:
    assert follower.mimic is not None
    leader = by_name.get(follower.mimic.joint)
    fail = elements[follower.name].fail
    if leader is None:
        fail(f"joint {follower.name!r} mimics {follower.mimic.joint!r}, which is not a joint")
    for joint in (follower, leader):
        if joint.size != 1:
            fail(
                f"joint {follower.name!r} mimics {leader.name!r}, but {joint.name!r} is {joint.type}",
                hint="Only revolute, continuous and prismatic joints can mimic and be mimicked.",
            )
    return leader
