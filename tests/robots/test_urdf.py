# SPDX-License-Identifier: Apache-2.0
"""The parser of robot descriptions: valid documents, and the errors for invalid ones."""

import math
import random
import time

import pytest

import coframe
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


def with_version(version, *parts):
    return robot_of(*parts).replace("<robot ", f"<robot version='{version}' ")


VISUAL = "<link name='d'><visual>{}</visual></link>"
SHAPE = "<geometry><box size='1 1 1'/></geometry>"
D = joint("cd", "c", "d")


@pytest.mark.parametrize(
    ("part", "warning"),
    [
        (VISUAL.format(""), "<visual> has no <geometry>; the <visual> is ignored"),
        (VISUAL.format("<geometry/>"), "<geometry> contains no shape; the <visual> is ignored"),
        (VISUAL.format("<geometry><cone/></geometry>"), "<cone> is not a shape; the <visual> is ignored"),
        (VISUAL.format("<geometry><mesh/></geometry>"), "<mesh> needs the attribute filename; the <visual>"),
        (VISUAL.format("<geometry><mesh filename='a' scale='2'/></geometry>"), 'scale="2">: expected 3 numbers'),
        (VISUAL.format("<geometry><sphere radius='big'/></geometry>"), "'big' is not a finite number; the <visual>"),
        (VISUAL.format("<origin xyz='0 0'/>" + SHAPE), "expected 3 numbers separated by spaces; the <visual>"),
        (
            "<link name='d'><collision><geometry><box/></geometry></collision></link>",
            "size; the <collision> is ignored",
        ),
        ("<link name='d'><inertial><mass value='1'/></inertial></link>", "has no <inertia>; the <inertial> is ignored"),
        (
            "<link name='d'><inertial><inertia ixx='1'/></inertial></link>",
            "the attribute ixy; the <inertial> is ignored",
        ),
    ],
)
def test_faults_of_shapes_and_inertia_are_warnings(part, warning):
    robot = parse_urdf(robot_of(part, *TREE, D))
    (found,) = robot.warnings
    assert found.startswith("line 5: ")
    assert warning in found
    link = robot.links["d"]
    assert (link.visuals, link.collisions, link.inertial) == ((), (), None)
    assert robot.frames().keys() == set("abcd")


@pytest.mark.parametrize(
    "inside", ["<color rgba='1 0 0'/>", "<color rgba='red'/>", "<color/>", "<color rgba='0 0 0 nan'/>"]
)
def test_a_shape_is_kept_if_only_its_color_is_not_valid(inside):
    text = VISUAL.format(f"{SHAPE}<material name='m'>{inside}</material>")
    robot = parse_urdf(robot_of(text, *TREE, D))
    (visual,) = robot.links["d"].visuals
    assert (visual.geometry, visual.material.color) == (Box((1, 1, 1)), None)
    assert [warning.endswith("; the color is ignored") for warning in robot.warnings] == [True]


@pytest.mark.parametrize(
    ("parts", "warning"),
    [
        (["<material><color rgba='1 0 0 1'/></material>"], "line 5: a <material> has no name, so it is ignored"),
        (
            [f"<material name='m'><color rgba='{i} 0 0 1'/></material>" for i in (0, 1)],
            "line 6: material 'm' is defined twice with different values; the first one is used",
        ),
    ],
)
def test_faults_of_materials_are_warnings(parts, warning):
    robot = parse_urdf(robot_of(*parts, *TREE))
    assert robot.warnings == (warning,)
    assert {name: material.color for name, material in robot.materials.items()} in ({}, {"m": (0, 0, 0, 1)})


def test_the_first_of_several_elements_counts():
    parts = "<origin xyz='1 0 0'/><origin xyz='2 0 0'/><axis xyz='0 0 1'/><axis/>" + LIMIT + "<limit/><child link='a'/>"
    shapes = "<geometry><box size='1 1 1'/><sphere/></geometry><geometry><sphere/></geometry><origin/><origin xyz='x'/>"
    robot = parse_urdf(robot_of(VISUAL.format(shapes), joint("ab", "a", "b", parts, "revolute"), TREE[1], D))
    moved = robot.joints["ab"]
    assert (moved.origin.translation.tolist(), moved.axis, moved.limits.upper) == ([1, 0, 0], (0, 0, 1), 1)
    assert robot.links["d"].visuals[0].geometry == Box((1, 1, 1))
    assert [warning.partition(";")[0] for warning in robot.warnings] == [
        "line 5: <visual> contains a second <origin>",
        "line 5: <visual> contains a second <geometry>",
        "line 5: <geometry> contains 2 shapes",
        "line 6: <joint> contains a second <child>",
        "line 6: <joint> contains a second <origin>",
        "line 6: <joint> contains a second <axis>",
        "line 6: <joint> contains a second <limit>",
    ]


def test_limits_that_do_not_matter_are_warnings():
    limit = "<limit lower='x' upper='1' effort='inf' velocity='1'/><safety_controller soft_lower_limit=''/>"
    robot = parse_urdf(robot_of(joint("ab", "a", "b", limit, "continuous"), TREE[1]))
    limits = robot.limits["ab"]
    assert (limits.lower, limits.upper, limits.effort, limits.velocity, limits.soft_lower) == (None, 1, None, 1, None)
    assert [warning.rpartition("; ")[2] for warning in robot.warnings] == [
        "the limit lower is ignored",
        "the limit effort is ignored",
        "the limit soft_lower_limit is ignored",
    ]


@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
def test_a_joint_without_a_direction_does_not_move(kind):
    robot = parse_urdf(
        robot_of(joint("ab", "a", "b", f"<origin xyz='0 1 0'/><axis xyz='0 0 0'/>{LIMIT}", kind), TREE[1])
    )
    assert robot.warnings == ("line 5: the axis of joint 'ab' is zero, so the joint does not move",)
    assert robot.frames({"ab": 0.5})["b"].values == (0, 1, 0, 0, 0, 0, 1)
    assert robot.jacobian("b").tolist() == [[0, 0]] * 6


@pytest.mark.parametrize(
    ("version", "rpy", "warning"),
    [
        ("1.0", [0, 0, 0], 'line 5: quat_xyzw is ignored, because it needs <robot version="1.1">'),
        ("1.1", [0, 0, 3], None),
        ("1.2", [0, 0, 3], None),
        ("1.7", [0, 0, 3], "line 1: the version '1.7' is unknown. ROS reads the versions 1.0, 1.1 and 1.2"),
    ],
)
def test_quaternions_are_read_from_version_1_1_on(version, rpy, warning):
    origin = f"<origin quat_xyzw='0 0 {math.sin(1.5)} {math.cos(1.5)}'/>"
    robot = parse_urdf(with_version(version, joint("ab", "a", "b", origin), TREE[1]))
    assert robot.joints["ab"].origin.rpy.tolist() == pytest.approx(rpy)
    assert robot.warnings == (() if warning is None else (warning,))


@pytest.mark.parametrize(("version", "expected"), [("1.1", (None, None, None)), ("1.2", (2.0, 3.0, 4.0))])
def test_limits_of_acceleration_and_jerk_are_read_from_version_1_2_on(version, expected):
    limit = "<limit lower='0' upper='1' effort='1' velocity='1' acceleration='2' deceleration='3' jerk='4'/>"
    robot = parse_urdf(with_version(version, joint("ab", "a", "b", limit), TREE[1]))
    limits = robot.joints["ab"].limits
    assert (limits.acceleration, limits.deceleration, limits.jerk) == expected
    warning = 'line 5: {} is ignored, because it needs <robot version="1.2">'
    ignored = ("acceleration", "deceleration", "jerk") if version == "1.1" else ()
    assert robot.warnings == tuple(warning.format(name) for name in ignored)


def test_a_zero_quaternion_is_no_rotation():
    robot = parse_urdf(with_version("1.1", joint("ab", "a", "b", "<origin quat_xyzw='0 0 0 0'/>"), TREE[1]))
    assert robot.joints["ab"].origin.rpy.tolist() == [0, 0, 0]
    assert robot.warnings == ("line 5: the quaternion is zero, so there is no rotation",)


def test_spaces_around_names_belong_to_them():
    robot = parse_urdf(robot_of("<link name=' d'/>", *TREE, joint("", "c ", "d")))
    assert list(robot.frames()) == ["a", "b", "c", " d"]
    assert robot.warnings == (
        "line 5: the name ' d' of a link is empty, or begins or ends with a space",
        "line 8: the name '' of a joint is empty, or begins or ends with a space",
    )


def test_xacro_elements_without_effect_are_warnings():
    robot = parse_urdf(robot_of("<xacro:property name='x' value='1'/>", *TREE))
    assert robot.warnings[0].startswith("line 5: <xacro:property> is xacro, not URDF, and has no effect. Save it as")


@pytest.mark.parametrize(
    ("text", "links"),
    [
        ("<!-- a -- b --><link name='a'/>", ["a"]),
        ("<!-- a ---><link name='a'/>", ["a"]),
        ("<link name='a&b'/>", ["a&b"]),
        ("<link name='a&nbsp;b&lt;&#67;'/>", ["a&nbsp;b<C"]),
        ("<link name='a<b'/>", ["a<b"]),
        ("<link name='a'\ntype='x'name2='y'/>", ["a"]),
        ("<link name='&#1;'/>", ["&#1;"]),
        ("\x02< link name = 'a'\n></link >]]>", ["a"]),
        ("<![CDATA[<link name='no'/>]]><link name='&'/>", ["&"]),
        ("<link name='a'/></robot><robot name='s'><link name='no'/></robot><!--", None),
        ("<link name='a'/></robot><robot name='s'><link name='no'/>", ["a"]),
    ],
)
def test_faults_of_xml_that_ros_accepts_are_repaired(text, links):
    document = f"<?xml version='1.0'?>\n<robot name='r'>\n{text}</robot>"
    if links is None:
        with pytest.raises(RobotDescriptionError, match="not well-formed"):
            parse_urdf(document)
        return
    robot = parse_urdf(document)
    assert list(robot.links) == links
    (warning,) = robot.warnings
    assert "not well-formed XML" in warning
    assert warning.endswith(". The document was repaired")
    assert list(parse_urdf(robot.text).links) == links
    assert parse_urdf(robot.text).warnings == ()
    assert len(robot.text.splitlines()) == len(document.splitlines())


@pytest.mark.parametrize(
    "prolog", ["\n<?xml version='1.0'?>", "<?xml version='1.0'?>" * 2, "<?xml encoding='utf-8'?>", "<a/>"]
)
def test_faults_before_the_robot_are_repaired(prolog):
    robot = parse_urdf(f"{prolog}\n<robot name='r'>\n<link name='a'/><link name=' b'/>{joint('j', 'a', 'b')}</robot>\0")
    lines = {warning.partition(":")[0] for warning in robot.warnings if "name" in warning}
    assert lines == {f"line {2 + prolog.count(chr(10)) + 1}"}


@pytest.mark.parametrize(
    ("data", "name", "warning"),
    [
        (b"<robot name='\xe9'><link name='a'/></robot>", "\xe9", "cannot be decoded: 'utf-8' codec"),
        (
            b"<?xml version='1.0' encoding='klingon'?><robot name='\xc3\xa9'><link name='a'/></robot>",
            "\xe9",
            "'klingon'",
        ),
        (b"<?xml version='1.0' encoding='punycode'?><robot name='a-'><link name='a'/></robot>", "a-", "'punycode'"),
        (b"<?xml version='1.0' encoding='us-ascii'?><robot name='\xc3\xa9'><link name='a'/></robot>", "\xe9", None),
        (
            "<?xml version='1.0' encoding='GB2312'?><robot name='\u81c2'><link name='a'/></robot>".encode("gb2312"),
            "\u81c2",
            None,
        ),
    ],
)
def test_texts_in_other_encodings_are_read(data, name, warning):
    robot = parse_urdf(data)
    assert robot.name == parse_urdf(robot.text.encode()).name == name
    assert [warning in found for found in robot.warnings] == ([] if warning is None else [True])


def test_the_time_for_a_repair_is_linear():
    started = time.monotonic()
    for part in (
        "<" + "a" * 500_000,
        "<a " + "b" * 500_000,
        "<a " + " b='1'" * 100_000 + "!",
        "<!--" * 100_000,
        "<" * 500_000,
    ):
        with pytest.raises(RobotDescriptionError):
            parse_urdf(f"<robot name='&'>{part}</robot>")
    assert time.monotonic() - started < 10


@pytest.mark.parametrize(
    ("joints", "mimic", "warnings"),
    [
        (
            [joint("ab", "a", "b", "<mimic joint='bc'/>"), TREE[1]],
            None,
            ["joint 'ab' is fixed, so its <mimic> has no effect"],
        ),
        (
            [joint("ab", "a", "b", "<mimic joint='x'/>", "continuous"), TREE[1]],
            None,
            ["joint 'ab' mimics 'x', which is not a joint"],
        ),
        (
            [joint("ab", "a", "b", "<mimic joint='bc'/>", "continuous"), joint("bc", "b", "c")],
            None,
            ["but 'bc' is fixed"],
        ),
        (
            [joint("ab", "a", "b", "<mimic joint='bc'/>", "continuous"), joint("bc", "b", "c", "", "floating")],
            None,
            ["but 'bc' is floating"],
        ),
        ([joint("ab", "a", "b", "<mimic joint='bc'/>", "planar"), TREE[1]], None, ["but 'ab' is planar"]),
        (
            [joint("ab", "a", "b", "<mimic joint='ab'/>", "continuous"), TREE[1]],
            None,
            ["joints mimic each other in a loop: ab;"],
        ),
    ],
)
def test_mimic_tags_that_cannot_be_followed_are_warnings(joints, mimic, warnings):
    robot = parse_urdf(robot_of(*joints))
    assert robot.joints["ab"].mimic is mimic
    assert [wanted in found for wanted, found in zip(warnings, robot.warnings, strict=True)] == [True]
    assert robot.warnings[0].startswith("line 5: ")
    assert set(robot.frames()) == set("abc")


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
        (robot_of(TREE[0], joint("bc", "b", "c", "<limit lower='-inf' upper='1'/>", "revolute")), 6, "not a finite"),
        (robot_of("<xacro:arm/>", TREE[0], joint("bc", "b", "tool")), 5, "<xacro:arm> is xacro"),
        ("<robot name='r' version='1.1'><link name='a'/></robot><", 1, "not well-formed XML: unclosed token"),
        ("hello <robot name='r'><link name='a'/></robot>", 1, "not well-formed XML: syntax error"),
        ("<robot name='r'><!-- a -- b --><link name='a'></robot>", 1, "not well-formed (invalid token)"),
        ("<robot name='r'><link name='&'/><link name=a/></robot>", 1, "not well-formed (invalid token)"),
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


def test_only_the_joints_of_a_circle_of_mimics_are_free():
    followers = [
        joint(name, parent, child, f"<mimic joint='{other}'/>", "continuous")
        for name, parent, child, other in (
            ("w", "d", "e", "x"),
            ("x", "a", "b", "y"),
            ("y", "b", "c", "z"),
            ("z", "c", "d", "x"),
        )
    ]
    robot = parse_urdf(robot_of(*followers, links="abcde"))
    assert {name: joint.mimic and joint.mimic.joint for name, joint in robot.joints.items()} == {
        "w": "x",
        "x": None,
        "y": None,
        "z": None,
    }
    assert len(robot.warnings) == 3
    assert all("in a loop: x, y, z; the <mimic> of joint" in warning for warning in robot.warnings)


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


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12\n", "Git LFS pointer"),
        (b"\x1f\x8b\x08\x00", "compressed with gzip"),
        (b"PK\x03\x04", "a zip archive"),
    ],
)
def test_other_files_are_named_for_what_they_are(tmp_path, content, what):
    (tmp_path / "robot.urdf").write_bytes(content)
    with pytest.raises(RobotDescriptionError, match=what):
        coframe.robots.load(tmp_path / "robot.urdf")


@pytest.mark.parametrize(("rpy", "is_said"), [("0 0 90", True), ("-45 0 0", True), ("0 0 6.28319", False)])
def test_angles_of_more_than_one_turn_are_reported_because_degrees_are_usual_elsewhere(rpy, is_said):
    joint = f'<joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin rpy="{rpy}"/></joint>'
    robot = parse_urdf(f'<robot name="r"><link name="a"/><link name="b"/>{joint}</robot>')
    assert any("angles are in radians" in warning for warning in robot.warnings) == is_said
