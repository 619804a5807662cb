# SPDX-License-Identifier: Apache-2.0
"""The parser of robot descriptions: valid documents, and the errors for invalid ones."""

import random
import time

import pytest

from coframe.robots import Box, Cylinder, Mesh, RobotDescriptionError, Sphere, parse_urdf

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="blue"><color rgba="0 0 0.8 1"/></material>
  <link name="base">
    <visual name="plate">
      <origin xyz="0 0 0.1" rpy="0 0 1.5"/>
      <geometry><box size="1 2 3"/></geometry>
      <material name="blue"/>
    </visual>
    <collision><geometry><cylinder radius="0.2" length="0.5"/></geometry></collision>
    <inertial>
      <origin xyz="0.1 0 0"/> <mass value="2.5"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/>
    </inertial>
  </link>
  <link name="upper">
    <visual><geometry><mesh filename="package://arm/upper.dae" scale="1 1 0.001"/></geometry></visual>
  </link>
  <link name="lower"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/> <child link="upper"/>
    <origin xyz="0 0 0.4" rpy="0 0.5 0"/> <axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="30" velocity="1.5"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/> <child link="lower"/>
    <limit lower="0.2" upper="0.6" effort="1" velocity="1"/>
    <mimic joint="shoulder" multiplier="-0.5" offset="0.1"/>
  </joint>
  <gazebo reference="base"><anything><at all="1"/></anything></gazebo>
</robot>
"""


def robot_of(*parts, links="abc"):
    """Return the text of a robot with one line for each link, then one for each part."""
    lines = ["<robot name='r'>", *(f"<link name='{name}'/>" for name in links), *parts, "</robot>"]
    return "\n".join(lines)


def joint(name, parent, child, inside="", kind="fixed"):
    return f"<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{inside}</joint>"


LIMIT = "<limit lower='-1' upper='1' effort='1' velocity='1'/>"
TREE = [joint("ab", "a", "b", LIMIT, "revolute"), joint("bc", "b", "c", LIMIT, "revolute")]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1"])
def test_the_stored_text_can_be_parsed_again_for_every_encoding(encoding):
    text = f"<?xml version='1.0' encoding='{encoding}'?><robot name='Käfer'><link name='/Fühler'/></robot>"
    robot = parse_urdf(text.encode(encoding))
    again = parse_urdf(robot.text.encode())
    assert (robot.name, list(robot.links)) == (again.name, list(again.links)) == ("Käfer", ["/Fühler"])
    assert robot.warnings == ("line 1: link '/Fühler' begins with a slash, which tf2 removes",)


def test_all_parts_of_a_description_are_parsed():
    robot = parse_urdf(ARM)
    assert (robot.name, robot.root, list(robot.links)) == ("arm", "base", ["base", "upper", "lower"])
    assert (robot.text, robot.warnings) == (ARM, ())
    (plate,) = robot.links["base"].visuals
    assert (plate.name, plate.geometry, plate.material.color) == ("plate", Box((1, 2, 3)), (0, 0, 0.8, 1))
    assert plate.origin.rpy.tolist() == pytest.approx([0, 0, 1.5])
    assert robot.links["base"].collisions[0].geometry == Cylinder(0.2, 0.5)
    assert robot.links["base"].inertial.mass == 2.5
    assert robot.links["base"].inertial.inertia == (1, 0, 0, 2, 0, 3)
    assert robot.links["base"].inertial.origin.translation.tolist() == [0.1, 0, 0]
    assert robot.links["upper"].visuals[0].geometry == Mesh("package://arm/upper.dae", (1, 1, 0.001))
    assert robot.links["lower"].visuals[0].geometry == Sphere(0.1)
    shoulder, elbow = robot.joints.values()
    assert (shoulder.type, shoulder.parent, shoulder.child, shoulder.axis) == ("revolute", "base", "upper", (0, 0, 1))
    assert (shoulder.limits.lower, shoulder.limits.upper) == (-1, 2)
    assert (shoulder.limits.effort, shoulder.limits.velocity) == (30, 1.5)
    assert (elbow.mimic.joint, elbow.mimic.multiplier, elbow.mimic.offset) == ("shoulder", -0.5, 0.1)
    assert elbow.axis == (1, 0, 0)
    assert robot.limits["elbow"].lower == 0.2


def test_materials_can_be_defined_at_the_top_level_or_in_links():
    visual = "<visual><geometry><sphere radius='1'/></geometry><material name='{}'>{}</material></visual>"
    robot = parse_urdf(
        "<robot name='r'><link name='a'>"
        + visual.format("red", "")
        + visual.format("lost", "")
        + visual.format("red", "<color rgba='1 0 0 1'/>")
        + "</link></robot>"
    )
    first, lost, last = robot.links["a"].visuals
    assert first.material == last.material == robot.materials["red"]
    assert lost.material is None
    assert robot.warnings == ("line 1: material 'lost' is not defined",)


def test_a_mimic_tag_of_a_fixed_joint_is_a_warning():
    robot = parse_urdf(robot_of(joint("ab", "a", "b", "<mimic joint='bc'/>"), TREE[1]))
    assert robot.joints["ab"].mimic is None
    assert robot.warnings == ("line 5: joint 'ab' is fixed, so its <mimic> has no effect",)


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("", 1, "no element found"),
        ("<robot name='r'><link name='a'>", 1, "no element found"),
        ("<robot name='r'>\n<link name='a'></robot>", 2, "mismatched tag"),
        ("<sdf/>", 1, "outermost element is <sdf>"),
        ("<robot name=''/>", 1, "has no links"),
        ("<robot name='r'><xacro:include filename='x'/></robot>", 1, "is xacro"),
        ("<!DOCTYPE robot [<!ENTITY a 'aaaa'>]>\n<robot name='&a;'/>", 1, "defines entities"),
        ("<!DOCTYPE robot [<!ATTLIST link b CDATA 'bomb'>]>\n<robot name='r'><link name='a'/></robot>", 1, "defines"),
        ("<a>" * 5000, 1, "nested more than"),
        (robot_of("<link name='a'/>"), 5, "second link 'a'; the first one is on line 2"),
        (robot_of("<link/>"), 5, "<link> needs the attribute name"),
        (robot_of(*TREE, joint("ab", "a", "b")), 7, "second joint 'ab'"),
        (robot_of(*TREE, joint("ac", "a", "c")), 7, "link 'c' has two parents: 'b' by joint 'bc', and 'a'"),
        (robot_of(TREE[0]), 1, "2 links have no parent: 'a', 'c'"),
        (robot_of(joint("ab", "a", "b"), joint("bb", "b", "b")), 6, "connects the link 'b' to itself"),
        (robot_of(joint("bc", "b", "c"), joint("cb", "c", "b")), 5, "form a loop"),
        (robot_of(joint("ab", "a", "b"), joint("bc", "b", "c"), joint("ca", "c", "a")), 5, "form a loop"),
        (robot_of(TREE[0], joint("bd", "b", "d")), 6, "has the child 'd', which is not a link"),
        (robot_of(TREE[0], joint("db", "d", "c")), 6, "has the parent 'd', which is not a link"),
        (robot_of(TREE[0], "<joint name='bc' type='fixed'><parent link='b'/></joint>"), 6, "<joint> has no <child>"),
        (robot_of(TREE[0], joint("bc", "b", "c", "", "screw")), 6, "has the unknown type 'screw'"),
        (robot_of(TREE[0], joint("bc", "b", "c", "", "revolute")), 6, "is revolute and has no <limit>"),
        (robot_of(TREE[0], joint("bc", "b", "c", "", "prismatic")), 6, "is prismatic and has no <limit>"),
        (
            robot_of(TREE[0], joint("bc", "b", "c", "<limit lower='2' upper='1'/>", "revolute")),
            6,
            "lower limit 2 above",
        ),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin xyz='0 nan 0'/>")), 6, "'nan' is not a finite number"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin xyz='0 1e999 0'/>")), 6, "not a finite number"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin xyz='0 1_0 0'/>")), 6, "not a finite number"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin xyz='0 0'/>")), 6, "expected 3 numbers"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin xyz='0 0 0,1'/>")), 6, "'0,1' is not a finite number"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<origin/><origin/>")), 6, "a second <origin> in one <joint>"),
        (
            robot_of(TREE[0], joint("bc", "b", "c", "<axis xyz='0 0 0'/>", "continuous")),
            6,
            "axis of joint 'bc' is zero",
        ),
        (robot_of(TREE[0], joint("bc", "b", "c", "<mimic joint='no'/>", "continuous")), 6, "mimics 'no', which is not"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<mimic joint='bc'/>", "continuous")), 6, "in a circle: bc"),
        (robot_of(TREE[0], joint("bc", "b", "c", "<mimic joint='ab'/>", "floating")), 6, "but 'bc' is floating"),
        (
            robot_of(joint("ab", "a", "b", "", "floating"), joint("bc", "b", "c", "<mimic joint='ab'/>", "continuous")),
            6,
            "joint 'bc' mimics 'ab', but 'ab' is floating",
        ),
        (robot_of("<link name='d'><visual/></link>", *TREE), 5, "<visual> has no <geometry>"),
        (robot_of("<link name='d'><visual><geometry><cone/></geometry></visual></link>"), 5, "<cone> is not a shape"),
        (robot_of("<link name='d'><inertial><mass value='1'/></inertial></link>"), 5, "<inertial> has no <inertia>"),
        (b"<?xml version='1.0' encoding='klingon'?><robot name='r'/>", 1, "unknown encoding 'klingon'"),
        (b"<?xml version='1.0' encoding='punycode'?><robot name='r'/>", 1, "unknown encoding 'punycode'"),
        (b"<robot name='\xff'><link name='a'/></robot>", None, "cannot be decoded: 'utf-8' codec"),
        ("<robot name='\ud800'/>", None, "cannot be decoded"),
    ],
)
def test_invalid_documents_raise_an_error_with_the_line(text, line, reason):
    with pytest.raises(RobotDescriptionError) as caught:
        parse_urdf(text)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)
    assert caught.value.line == line
    assert line is None or str(caught.value).startswith(f"line {line}: ")


def test_mimics_in_a_circle_of_three():
    followers = [
        joint(name, parent, child, f"<mimic joint='{other}'/>", "continuous")
        for name, parent, child, other in (("x", "a", "b", "y"), ("y", "b", "c", "z"), ("z", "c", "d", "x"))
    ]
    with pytest.raises(RobotDescriptionError, match="in a circle: x, y, z"):
        parse_urdf(robot_of(*followers, links="abcd"))


def test_a_chain_of_three_thousand_links_is_parsed_quickly():
    count = 3000
    links = [f"<link name='l{i}'/>" for i in range(count)]
    joints = [
        joint(f"j{i}", f"l{i}", f"l{i + 1}", f"<mimic joint='j{i - 1}'/>" if i else "", "continuous")
        for i in range(count - 1)
    ]
    started = time.monotonic()
    robot = parse_urdf(f"<robot name='r'>{''.join(links)}{''.join(reversed(joints))}</robot>")
    assert len(robot.frames({"j0": 1e-3})) == count
    assert time.monotonic() - started < 10


def test_mutated_descriptions_are_parsed_or_raise_an_error():
    rng = random.Random(3)
    refused = 0
    for _ in range(1500):
        data = bytearray(ARM.encode())
        for _ in range(rng.choice([1, 1, 2, 5])):
            where = rng.randrange(len(data))
            data[where : where + rng.choice([0, 1, 4])] = rng.choice(
                [b"", b"<", b">", b'"', b"nan", b"-1e308", b"\xff", b"&x;", b"base", rng.randbytes(2)]
            )
        try:
            parse_urdf(bytes(data)).frames()
        except RobotDescriptionError:
            refused += 1
    assert 300 < refused < 1500
