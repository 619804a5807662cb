"""Whether links and joints form one tree, and whether joints that follow others get anywhere."""

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
    """The joints by name, parents before children, level by level from the root link.

    Raises:
        RobotDescriptionError: A joint names a link that is not there, a link has two parents, there is a loop, or
            there are several roots.
    """
    parent_joint = _parent_joints(set(links), joints, elements)
    roots = [link for link in links if link not in parent_joint]
    if len(roots) > 1:
        names = ", ".join(repr(link) for link in roots[:10]) + (", ..." if len(roots) > 10 else "")
        root.refuse(f"{len(roots)} links have no parent: {names}", hint="All but one must be the child of a joint.")
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
            _refuse_loop(joint, parent_joint, elements)
    return order


def _parent_joints(links: set[str], joints: list[Joint], elements: Mapping[str, Element]) -> dict[str, Joint]:
    """By link: the joint that it hangs from."""
    found: dict[str, Joint] = {}
    for joint in joints:
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                elements[joint.name].refuse(f"joint {joint.name!r} has the {role} {link!r}, which is not a link")
        if joint.parent == joint.child:
            elements[joint.name].refuse(f"joint {joint.name!r} ties the link {joint.child!r} to itself")
        other = found.setdefault(joint.child, joint)
        if other is not joint:
            elements[joint.name].refuse(
                f"link {joint.child!r} has two parents: {other.parent!r} by joint {other.name!r}, and {joint.parent!r} "
                f"by joint {joint.name!r}"
            )
    return found


def _refuse_loop(joint: Joint, parent_joint: Mapping[str, Joint], elements: Mapping[str, Element]) -> None:
    seen: dict[str, Joint] = {}
    while joint.child not in seen:
        seen[joint.child] = joint
        joint = parent_joint[joint.parent]
    loop = list(seen)[list(seen).index(joint.child) :]
    names = " <- ".join([*loop[:10], *(["..."] if len(loop) > 10 else []), loop[0]])
    elements[joint.name].refuse(f"the links form a loop: {names}", hint="URDF describes trees; leave one joint out.")


def check_mimics(joints: list[Joint], elements: Mapping[str, Element]) -> None:
    """Checks that every joint that follows another ends at one that moves by itself.

    Raises:
        RobotDescriptionError: The other joint is not there, is not a single number, or they follow each other.
    """
    by_name = {joint.name: joint for joint in joints}
    settled: set[str] = set()
    for joint in joints:
        chain: dict[str, Joint] = {}
        follower = joint
        while follower.mimic is not None and follower.name not in settled:
            if follower.name in chain:
                elements[joint.name].refuse(f"joints mimic each other in a circle: {', '.join(chain)}")
            chain[follower.name] = follower
            follower = _leader(follower, by_name, elements)
        settled.update(chain)


def _leader(follower: Joint, by_name: Mapping[str, Joint], elements: Mapping[str, Element]) -> Joint:
    assert follower.mimic is not None
    leader = by_name.get(follower.mimic.joint)
    refuse = elements[follower.name].refuse
    if leader is None:
        refuse(f"joint {follower.name!r} mimics {follower.mimic.joint!r}, which is not a joint")
    for joint in (follower, leader):
        if joint.size != 1:
            refuse(
                f"joint {follower.name!r} mimics {leader.name!r}, but {joint.name!r} is {joint.type}",
                hint="Only revolute, continuous and prismatic joints have the one position that a mimic needs.",
            )
    return leader
