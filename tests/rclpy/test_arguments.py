# SPDX-License-Identifier: Apache-2.0
"""Parsing of `--ros-args`."""

import math
import re

import pytest

from rclpy import _arguments, _rclpy_pybind11, _yaml, exceptions, handle
from rclpy._remapping import NameResolver, remap_node
from rclpy.context import Context
from rclpy.exceptions import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.impl import implementation_singleton
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.utilities import remove_ros_args


def resolver(*rules: str, node: str = "arm", namespace: str = "/") -> NameResolver:
    words = [word for rule in rules for word in ("-r", rule)]
    return NameResolver(node, namespace, _arguments.parse(["--ros-args", *words]).remaps)


def test_only_remapping_rules_are_used_outside_of_ros_args():
    args = ["prog", "x:=y", "--ros-args", "-r", "a:=b", "--", "-r", "c:=d", "--ros-args", "-p", "n:=1"]
    parsed = _arguments.parse([*args, "--", "--size:=5", "12:=x", "http://a:=1"])
    assert [rule.match for rule in parsed.remaps] == ["a", "x", "c"]
    assert parsed.deprecated_remaps == ["x:=y", "c:=d"]
    assert [(item.name, item.value) for item in parsed.parameters] == [("n", 1)]
    assert remove_ros_args(args) == ["prog", "x:=y", "-r", "c:=d"]


@pytest.mark.parametrize(
    ("args", "error", "text"),
    [
        (["--bogus", "c"], UnknownROSArgsError, "['--bogus', 'c']"),
        (["-r"], RCLInvalidROSArgsError, "Couldn't parse trailing -r flag. No remap rule found."),
        (["-r", "chatter"], RCLInvalidROSArgsError, "'-r chatter'. Error: it does not have the form from:=to"),
        (["-r", "chatter:="], RCLInvalidROSArgsError, "no value after :="),
        (["-r", "__ns:=robot"], RCLInvalidROSArgsError, "it must lead with a '/'"),
        (["-r", "__node:=1arm"], RCLInvalidROSArgsError, "must not start with a number"),
        (["-p", "rate"], RCLInvalidROSArgsError, "does not have the form"),
        (["-p", "rate:="], RCLInvalidROSArgsError, "no value after :="),
        (["-p", "1x:=2"], RCLInvalidROSArgsError, "starts with a letter"),
        (["-p", "a..b:=2"], RCLInvalidROSArgsError, "its parts are separated by dots"),
        (["-p", "a-b:=2"], RCLInvalidROSArgsError, "consists of letters, digits and '_'"),
        (["-p", "__x:=2"], RCLInvalidROSArgsError, "starts with a letter or one '_'"),
        (["-p", "*:x:=2"], RCLInvalidROSArgsError, "The name of a node and a colon can precede it"),
        (["-p", "x:={a: 1}"], RCLInvalidROSArgsError, "'{a: 1}' is a mapping or an alias of YAML"),
        (["-p", "x:=[1, a]"], RCLInvalidROSArgsError, "Sequence should be of same type. Value type 'string'"),
        (["--log-level", "loud"], RCLInvalidROSArgsError, "Argument does not use a valid severity level"),
        (["--params-file", "/nowhere.yaml"], RCLInvalidROSArgsError, "Error: Error opening YAML file"),
    ],
)
def test_invalid_arguments_are_reported(args, error, text):
    with pytest.raises(error, match=re.escape(text)):
        _arguments.parse(["--ros-args", *args])


def test_errors_of_the_process_have_the_class_of_ros_and_a_hint(domain_id):
    with pytest.raises(_rclpy_pybind11.RCLError, match=r"^failed to initialize rcl: Couldn't parse log") as caught:
        Context().init(["--ros-args", "--log-level", "loud"], domain_id=domain_id)
    assert caught.value.hint == "Known levels: debug, info, warn, error, fatal."
    with pytest.raises(RCLError, match="external configuration"):
        Context().init(["--ros-args", "--log-config-file", "x"], domain_id=domain_id)
    assert exceptions.InvalidHandle is _rclpy_pybind11.InvalidHandle is handle.InvalidHandle
    assert implementation_singleton.rclpy_implementation.RCLError is RCLError


def test_logging_options():
    words = "--log-level warn --log-level arm.child:=DEBUG --disable-stdout-logs --disable-rosout-logs"
    words += " --enable-external-lib-logs --log-config-file x"
    logging = _arguments.parse(["--ros-args", *words.split()]).logging
    assert logging.default_level is LoggingSeverity.WARN
    assert logging.levels == {"arm.child": LoggingSeverity.DEBUG}
    assert (logging.stdout, logging.rosout) == (False, False)


def test_node_name_and_namespace_remapping():
    rules = _arguments.parse(["--ros-args", "-r", "__node:=left", "-r", "__ns:=/robots"]).remaps
    assert remap_node("arm", "/", rules) == ("left", "/robots")
    rules = _arguments.parse(["--ros-args", "-r", "arm:__name:=left", "-r", "leg:__ns:=/robots"]).remaps
    assert remap_node("arm", "/", rules) == ("left", "/")


@pytest.mark.parametrize(
    ("rule", "name", "expected"),
    [
        ("/tf:=tf", "/tf", "/robot1/tf"),
        ("chatter:=talk", "chatter", "/robot1/talk"),
        ("/robot1/chatter:=/talk", "chatter", "/talk"),
        ("chatter:=talk", "/chatter", "/chatter"),
        ("~/state:=/state", "~/state", "/state"),
        ("arm:chatter:=talk", "chatter", "/robot1/talk"),
        ("leg:chatter:=talk", "chatter", "/robot1/chatter"),
        ("rostopic://chatter:=talk", "chatter", "/robot1/talk"),
        ("rosservice://chatter:=talk", "chatter", "/robot1/chatter"),
    ],
)
def test_topic_remapping(rule, name, expected):
    assert resolver(rule, namespace="/robot1").resolve(name) == expected


def test_first_rule_applies_and_services_have_separate_rules():
    assert resolver("a:=first", "a:=second").resolve("a") == "/first"
    assert resolver("rosservice://a:=b").resolve("a", is_service=True) == "/b"
    assert resolver("a:=b").resolve("a", only_expand=True) == "/a"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True),
        ("no", False),
        ("5", 5),
        ("-0x10", -16),
        ("5.0", 5.0),
        ("1e-3", 0.001),
        ("abc", "abc"),
        ("'5'", "5"),
        ('"a b"', "a b"),
        ("''", ""),
        ("[1, 2]", [1, 2]),
        ("[a, 'b, c', \"d\"]", ["a", "b, c", "d"]),
        ("[]", []),
        ("[1.0, .5]", [1.0, 0.5]),
        ("/a/b", "/a/b"),
        # As C's strtol and strtod read them in rcl.
        ("010", 8),
        ("-017", -15),
        ("08", 8.0),
        ("0", 0),
        ("9223372036854775807", 2**63 - 1),
        ("9223372036854775808", 2.0**63),
        ("inf", math.inf),
        ("-Infinity", -math.inf),
        (".inf", math.inf),
        (" .5 ", 0.5),
        ("+.INF", math.inf),
        ("+.iNf", "+.iNf"),
        ("-.nan", "-.nan"),
        ("nan(0x1)", math.nan),
        ("0x1.8p3", 12.0),
        ("-0X.8", -0.5),
        ("0x1p2000", "0x1p2000"),
        ("0x", "0x"),
        ("0xffffffffffffffffff", 4722366482869645213695.0),
        ("0b101", "0b101"),
        ("0o17", "0o17"),
        ("1_000", "1_000"),
        ("1:30", "1:30"),
        ("1e400", "1e400"),
        ("1e-400", "1e-400"),
        ("1e-310", "1e-310"),
        ("0e-400", 0.0),
        ("2.22507385850720114e-308", "2.22507385850720114e-308"),  # rounded, but below the normal numbers
        ("2.2250738585072013831e-308", 2.2250738585072014e-308),
        ("0x1p-1074", 5e-324),
        ("0x1p-1075", "0x1p-1075"),
        ("\u0661", "\u0661"),
        ("tRUE", "tRUE"),
        ("On", True),
        ("N", False),
        ("~", "~"),
        ("null", "null"),
        ("2024-01-01", "2024-01-01"),
        ("a: b", ValueError),
        ("{}", ValueError),
        ("*a", ValueError),
        ("'a", ValueError),
        ("[1, 2", ValueError),
        ("[,]", ValueError),
        ("[1, 08]", ValueError),
        ("http://a:80/b?c", "http://a:80/b?c"),
        ("-a", "-a"),
        ("- a", ["a"]),
        ("[[1, 2], [3]]", [3]),
        ("[ a b, -c ,'d''e',]", ["a b", "-c", "d'e"]),
        ("!!str 5", "5"),
        ("5 # five", 5),
        ('"\\x41\\n"', "A\n"),
        ('"a\\0b"', "a"),
        ("|-\n 0x10", 16),
        ("|\n true\n", "true\n"),
        ("9" * 5000, "9" * 5000),
        ("infinite", "infinite"),
    ],
)
def test_types_of_parameter_values(text, value):
    if value is ValueError:
        with pytest.raises(ValueError, match=r"YAML|while|line_num"):
            _yaml.parse_value(text)
        return
    parsed = _yaml.parse_value(text)
    assert repr(parsed) == repr(value)  # nan is equal to itself, and 1 is not 1.0


@pytest.mark.parametrize("text", ["nan", "NaN", ".nan"])
def test_parameters_that_are_not_a_number(text):
    assert math.isnan(_yaml.parse_value(text))


def test_parameter_rules_match_node_names():
    [everywhere, named] = _arguments.parse(["--ros-args", "-p", "a:=1", "-p", "arm:b:=2"]).parameters
    assert everywhere.matches("/x/leg")
    assert named.matches("/arm")
    assert not named.matches("/robot1/arm")
    assert not named.matches("/robot1/leg")


def of_node(node: str, *words: str) -> dict:
    """Return the parameters that these words give a node: the last value applies."""
    parameters = _arguments.parse(["--ros-args", *words]).parameters
    return {item.name: item.value for item in parameters if item.matches(node)}


def test_patterns_of_node_names(tmp_path):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    patterns = ["/**", "/*", "*", "/*/*", "/a/*", "/**/arm", "a/**/arm", "arm", "/a/arm"]
    path.write_text("".join(f'"{name}":\n  ros__parameters: {{p{i}: 1}}\n' for i, name in enumerate(patterns)))

    def numbers(node: str) -> str:
        return "".join(sorted(name[1:] for name in of_node(node, "--params-file", str(path))))

    assert numbers("/arm") == "01257"
    assert numbers("/a/arm") == "034568"
    assert numbers("/b/c/arm") == "05"
    assert numbers("/a/b/c/arm") == "056"


def test_all_values_of_a_node_have_the_place_of_the_first_one(tmp_path):
    pytest.importorskip("yaml")
    first, second = tmp_path / "first.yaml", tmp_path / "second.yaml"
    blocks = [("/**", "a: 1, b: 1"), ("arm", "a: 2"), ("/**", "a: 3, c: 3")]
    first.write_text("".join(f"{node}:\n  ros__parameters: {{{values}}}\n" for node, values in blocks))
    second.write_text("/**:\n  ros__parameters: {b: 4, c: 4}\n")
    words = ["--params-file", str(first), "--params-file", str(second)]
    assert of_node("/arm", *words) == {"a": 2, "b": 4, "c": 4}
    assert of_node("/leg", *words) == {"a": 3, "b": 4, "c": 4}
    assert of_node("/arm", *words, "-p", "a:=5") == {"a": 2, "b": 4, "c": 4}
    assert of_node("/arm", *words, "-p", "arm:a:=5") == {"a": 5, "b": 4, "c": 4}
    assert of_node("/arm", "-p", "a:=5", "-p", "a:=x") == {"a": "x"}


def test_parameter_files(tmp_path):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    path.write_text(
        "/**:\n  ros__parameters:\n    use: true\narm:\n  ros__parameters:\n    gain: {p: 1e3, i: '5'}\n"
        "robot1:\n  leg:\n    ros__parameters: {names: [a, b]}\n/*/hand:\n  ros__parameters: {size: 3}\n"
    )
    parameters = _arguments.parse(["--ros-args", "--params-file", str(path)]).parameters

    def of(node: str) -> dict:
        return {item.name: item.value for item in parameters if item.matches(node)}

    assert of("/arm") == {"use": True, "gain.p": 1000.0, "gain.i": "5"}
    assert of("/robot1/leg") == {"use": True, "names": ["a", "b"]}
    assert of("/x/hand") == {"use": True, "size": 3}
    assert of("/hand") == {"use": True}


def test_all_blocks_of_a_node_in_a_parameter_file_count(tmp_path):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    blocks = [("/**", "a: 1"), ("/**", "b: 2"), ("arm", "b: 3"), ("arm", "gain: {p: 1, p: 2}"), ("arm", "gain: {i: 3}")]
    path.write_text("".join(f"{name}:\n  ros__parameters:\n    {values}\n" for name, values in blocks))
    parameters = _arguments.parse(["--ros-args", "--params-file", str(path)]).parameters
    of_arm = {item.name: item.value for item in parameters if item.matches("/arm")}  # the last value applies
    assert of_arm == {"a": 1, "b": 3, "gain.p": 2, "gain.i": 3}


def test_a_parameter_file_that_was_not_downloaded_is_not_an_empty_one(tmp_path):
    """A Git LFS pointer is valid YAML without parameters: the node would start with its defaults."""
    path = tmp_path / "gains.yaml"
    path.write_text("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12\n")
    with pytest.raises(RCLInvalidROSArgsError, match="Git LFS pointer"):
        _arguments.parse(["--ros-args", "--params-file", str(path)])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("arm: 5\n", "Cannot have a value before ros__parameters at line 1"),
        ("arm:\n  ros__parameters: ;f :yes\n", "Cannot have a value before ros__parameters at line 2"),
        ("arm:\n  ros__parameters:\n", "Cannot have a value before ros__parameters at line 2"),
        ("arm:\n  ros__parameters: {[a]: 1}\n", "Sequences cannot be key at line 2"),
        ("arm:\n  ros__parameters:\n    gain:\n    rate: 5\n", "No value at line"),
        ("arm:\n  ros__parameters: {a: &x 5, b: *x}\n", "Will not support aliasing at line 2"),
        ("leg:\n  ros__parameters: {a: ['1', 2]}\n", "Value type 'integer' do not belong at line_num 2"),
        ("arm:\n  ros__parameters: {a: [[1], [2]]}\n", "Sequences cannot be key at line 2"),
        ("arm:\n  ros__parameters: {a: [{b: 1}]}\n", "Mappings cannot be in lists at line 2"),
        ("arm:\n  ros__parameters: {'': 1}\n", "No key at line 2"),
        ("{}:\n  arm:\n    ros__parameters: {a: 1}\n", "Expected the name of a parameter at line 3"),
        ("ros__parameters: {a: 1}\n", "There are no node names before ros__parameters at line 1"),
        ("my-arm:\n  ros__parameters: {a: 1}\n", "'my-arm' above line 2 is not the name of a node"),
        ("a//b:\n  ros__parameters: {a: 1}\n", "'a//b' above line 2 is not the name of a node"),
        ("1a:\n  ros__parameters: {a: 1}\n", "without a digit in front"),
        ("- arm\n", "Sequences cannot be key at line 1"),
    ],
)
def test_error_of_an_invalid_parameter_file_contains_its_name(tmp_path, text, message):
    pytest.importorskip("yaml")
    path = tmp_path / "params.yaml"
    path.write_text(text)
    with pytest.raises(RCLInvalidROSArgsError, match=message):
        _arguments.parse(["--ros-args", "--params-file", str(path)])


@pytest.mark.parametrize(
    "rule",
    [
        *("chatter:=my-topic", "chatter:=/a/", "x:=/a//b", "x:=1a", "x:={node}/y", "a:=b:=c", "x:y:a:=b"),
        *("m:chatter:=my-topic", "~:=b", "a:=~", "*:=b", "a/*:=b", "a:=\\1", "a__b:=c", "a:=__b", "/:=b", "a:=/"),
        *("~a:=b", "a:= b", "rostopic://a:=rostopic://b", "1a:=b", "a{b}:=c", "\u00e4:=b", "a:=\u0663"),
    ],
)
def test_rules_that_ros_rejects(rule):
    with pytest.raises(RCLInvalidROSArgsError, match=f"Couldn't parse remap rule: '-r {re.escape(rule)}'"):
        _arguments.parse(["--ros-args", "-r", rule])


@pytest.mark.parametrize("rule", ["~/a:=b", "/a/b:=~/c", "a_:=c", "_a:=b", "_1:=_", "m:rosservice://a/b:=/c", "a:=b_"])
def test_rules_that_ros_accepts(rule):
    (remap,) = _arguments.parse(["--ros-args", "-r", rule]).remaps
    assert rule.endswith(f"{remap.match}:={remap.replacement}")


def test_arguments_that_are_not_text_are_an_error():
    with pytest.raises(UnicodeEncodeError, match="surrogates not allowed"):
        Context().init(args=["\udcff"])


@pytest.mark.parametrize(
    ("name", "is_accepted"),
    [
        *((name, True) for name in ("qos_overrides./scan.publisher.depth", "/a", "a/", "a//b", "a./", "//", "a__b")),
        *((name, False) for name in ("a..b", ".a", "a.", "a.1", "a/1", "__a", "~/x", "x-y", "a b")),
    ],
)
def test_names_of_parameters_that_ros_accepts(name, is_accepted):
    arguments = ["--ros-args", "-p", f"{name}:=1", "-p", f"camera:{name}:=2"]
    if is_accepted:
        given = [(each.node_pattern, each.name, each.value) for each in _arguments.parse(arguments).parameters]
        assert given == [("/**", name, 1), ("camera", name, 2)]
        return
    with pytest.raises(RCLInvalidROSArgsError, match="the name of a parameter consists of"):
        _arguments.parse(arguments)
