# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes."""

import copy
import enum

import numpy as np
import pytest

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterValue,
    SetParametersResult,
)
from rclpy.exceptions import (
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.parameter import Parameter, ParameterMsg, get_parameter_value, parameter_value_to_python
from rclpy.serialization import deserialize_message, serialize_message

VALUES = [
    (True, Parameter.Type.BOOL),
    (5, Parameter.Type.INTEGER),
    (5.0, Parameter.Type.DOUBLE),
    ("x", Parameter.Type.STRING),
    ([b"a"], Parameter.Type.BYTE_ARRAY),
    ([True], Parameter.Type.BOOL_ARRAY),
    ([1, 2], Parameter.Type.INTEGER_ARRAY),
    ([1.0], Parameter.Type.DOUBLE_ARRAY),
    (["x"], Parameter.Type.STRING_ARRAY),
    (None, Parameter.Type.NOT_SET),
]


@pytest.mark.parametrize(("value", "kind"), VALUES)
def test_types_of_values_and_conversion_to_messages(value, kind):
    parameter = Parameter("p", value=value)
    assert parameter.type_ is kind
    assert Parameter.from_parameter_msg(parameter.to_parameter_msg()) == parameter


class Mode(enum.IntEnum):
    SLOW = 1
    FAST = 2


class Frame(str, enum.Enum):
    BASE = "base_link"


@pytest.mark.parametrize(
    ("value", "kind", "plain"),
    [
        (Mode.FAST, Parameter.Type.INTEGER, 2),
        ([Mode.FAST, 3], Parameter.Type.INTEGER_ARRAY, [2, 3]),
        (Frame.BASE, Parameter.Type.STRING, "base_link"),
        ((Frame.BASE,), Parameter.Type.STRING_ARRAY, ["base_link"]),
        (np.bool_(True), Parameter.Type.BOOL, True),
        (np.int8(-3), Parameter.Type.INTEGER, -3),
        (np.uint64(2**63 - 1), Parameter.Type.INTEGER, 2**63 - 1),
        (np.float32(0.5), Parameter.Type.DOUBLE, 0.5),
        (np.float64(0.1), Parameter.Type.DOUBLE, 0.1),
        ([np.int32(2), 3], Parameter.Type.INTEGER_ARRAY, [2, 3]),
        ((np.float32(0.5), np.float64(0.1)), Parameter.Type.DOUBLE_ARRAY, [0.5, 0.1]),
        ([np.bool_(True), False], Parameter.Type.BOOL_ARRAY, [True, False]),
        ([np.str_("a")], Parameter.Type.STRING_ARRAY, ["a"]),
    ],
)
def test_enumerations_and_numpy_scalars_as_values(node, value, kind, plain):
    assert Parameter.Type.from_parameter_value(value) is kind
    declared = node.declare_parameter("p", value)
    assert declared.type_ is kind
    assert Parameter("p", kind, value) == declared
    received = deserialize_message(serialize_message(declared.to_parameter_msg()), ParameterMsg)
    assert parameter_value_to_python(received.value) == plain
    assert node.set_parameters([Parameter("p", value=plain)])[0].successful


@pytest.mark.parametrize(
    "value", [np.uint64(2**63), [np.uint64(2**63)], 2**63, np.datetime64("2026-01-01"), np.timedelta64(1, "s"), 1j]
)
def test_numbers_that_do_not_fit_are_refused(value):
    with pytest.raises(TypeError, match=r"not .*one of the allowed types"):
        Parameter("p", value=value)
    with pytest.raises(ValueError, match="do not agree"):
        Parameter("p", Parameter.Type.INTEGER, value)


def test_numpy_array_as_a_value_is_refused_with_the_conversion():
    with pytest.raises(TypeError) as raised:
        Parameter("p", value=np.zeros(3))
    assert "tolist()" in raised.value.hint


def test_parameters_in_sets_and_dictionaries():
    first, same, other = Parameter("p", value=1), Parameter("p", value=1), Parameter("p", value=2)
    assert {first, same, other} == {first, other}
    assert {first: "a"}[same] == "a"


def test_values_of_unsupported_types():
    with pytest.raises(TypeError, match="not one of the allowed types"):
        Parameter("p", value={"a": 1})
    with pytest.raises(TypeError):
        Parameter("p", value=[1, "x"])
    with pytest.raises(ValueError, match="do not agree"):
        Parameter("p", Parameter.Type.INTEGER, 1.0)
    with pytest.raises(TypeError, match="type must be an instance"):
        Parameter("p", "integer", 1)


def test_value_from_a_string():
    assert get_parameter_value("5").integer_value == 5
    assert parameter_value_to_python(get_parameter_value("[1, 2]")) == [1, 2]
    assert parameter_value_to_python(get_parameter_value("[1, x]")) == "[1, x]"


def test_declare_and_get(node):
    assert node.declare_parameter("rate", 10.0).value == 10.0
    assert node.get_parameter("rate").get_parameter_value().double_value == 10.0
    assert node.has_parameter("rate")
    assert node.get_parameter_type("rate") == Parameter.Type.DOUBLE.value
    with pytest.raises(ParameterAlreadyDeclaredException, match="already declared"):
        node.declare_parameter("rate", 10.0)
    with pytest.raises(ParameterNotDeclaredException, match=r"undeclared parameter.*speed"):
        node.get_parameter("speed")
    with pytest.raises(InvalidParameterException):
        node.declare_parameter("", 1)


def test_declare_by_type(node):
    node.declare_parameter("name", Parameter.Type.STRING)
    with pytest.raises(ParameterUninitializedException):
        node.get_parameter("name")
    assert node.get_parameter_or("name", Parameter("name", value="x")).value == "x"
    assert node.get_parameter_or("nothing").value is None
    assert node.set_parameters([Parameter("name", value="y")])[0].successful
    assert node.get_parameter("name").value == "y"


def test_declare_parameters_with_a_namespace(node):
    parameters = [("p", 1.0), ("i", 2.0, ParameterDescriptor(description="integral")), ("d",)]
    with pytest.warns(UserWarning, match="only providing its name is deprecated"):
        node.declare_parameters("gain", parameters)
    assert {name: parameter.value for name, parameter in node.get_parameters_by_prefix("gain").items()} == {
        "p": 1.0,
        "i": 2.0,
        "d": None,
    }
    assert node.describe_parameter("gain.i").description == "integral"
    assert [parameter.value for parameter in node.get_parameters(["gain.p", "gain.i"])] == [1.0, 2.0]
    with pytest.raises(TypeError, match="Invalid parameter tuple"):
        node.declare_parameters("", [(5,)])


def test_overrides_take_precedence_over_defaults(make_node):
    node = make_node(cli_args=["--ros-args", "-p", "a:=5", "-p", "b:=5"], parameter_overrides=[Parameter("b", value=7)])
    assert node.declare_parameter("a", 1).value == 5
    assert node.declare_parameter("b", 1).value == 7
    node.undeclare_parameter("a")
    assert node.declare_parameter("a", 1, ignore_override=True).value == 1


def test_override_of_the_wrong_type(make_node):
    node = make_node(cli_args=["--ros-args", "-p", "rate:=fast"])
    with pytest.raises(
        InvalidParameterTypeException, match="Trying to set parameter 'rate' to 'fast' of type 'STRING'"
    ):
        node.declare_parameter("rate", 10)
    assert not node.has_parameter("rate")


def test_automatic_declaration(make_node):
    node = make_node(
        cli_args=["--ros-args", "-p", "zeros.joint1:=1.5"], automatically_declare_parameters_from_overrides=True
    )
    assert node.get_parameters_by_prefix("zeros")["joint1"].value == 1.5


def test_allowed_undeclared_parameters(make_node):
    node = make_node(allow_undeclared_parameters=True)
    assert node.get_parameter("x").type_ is Parameter.Type.NOT_SET
    assert node.set_parameters([Parameter("x", value=1)])[0].successful
    assert node.get_parameter("x").value == 1


def test_set_checks_type_range_and_read_only(node):
    node.declare_parameter(
        "count", 5, ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10, step=5)])
    )
    node.declare_parameter(
        "gain", 0.5, ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=1.0)])
    )
    node.declare_parameter("fixed", 1, ParameterDescriptor(read_only=True))
    results = node.set_parameters(
        [
            Parameter("count", value=10),
            Parameter("count", value=7),
            Parameter("count", value=11),
            Parameter("count", value="x"),
            Parameter("gain", value=1.5),
            Parameter("fixed", value=2),
        ]
    )
    assert [result.successful for result in results] == [True, False, False, False, False, False]
    assert results[1].reason.endswith("is not a valid step. Min: 0, max: 10, value: 7, step: 5")
    assert "out of range. Min: 0, Max: 10, value: 11" in results[2].reason
    assert results[3].reason == "Wrong parameter type, expected 'Type.INTEGER' got 'Type.STRING'"
    assert "read-only" in results[5].reason
    with pytest.raises(ParameterImmutableException):
        node.undeclare_parameter("fixed")
    with pytest.raises(InvalidParameterValueException, match="out of range"):
        node.declare_parameter("bad", 7, ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=1)]))
    with pytest.raises(ParameterNotDeclaredException):
        node.set_parameters([Parameter("unknown", value=1)])


def test_atomic_setting(node):
    node.declare_parameters("", [("a", 1), ("b", 2)])
    assert not node.set_parameters_atomically([Parameter("a", value=5), Parameter("b", value="x")]).successful
    assert node.get_parameter("a").value == 1
    assert node.set_parameters_atomically([Parameter("a", value=5), Parameter("b", value=6)]).successful
    assert node.get_parameter("b").value == 6


def test_callbacks_accept_or_reject_values(node):
    node.declare_parameter("a", 1)

    def refuse_big(parameters):
        big = [parameter.name for parameter in parameters if parameter.value > 10]
        return SetParametersResult(successful=not big, reason="too big" if big else "")

    node.add_on_set_parameters_callback(refuse_big)
    [result] = node.set_parameters([Parameter("a", value=11)])
    assert (result.successful, result.reason) == (False, "too big")
    node.remove_on_set_parameters_callback(refuse_big)
    assert node.set_parameters([Parameter("a", value=11)])[0].successful


def test_set_descriptor(node):
    node.declare_parameter("a", 20)
    limits = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10)])
    with pytest.raises(InvalidParameterValueException):
        node.set_descriptor("a", limits)
    assert node.set_descriptor("a", limits, Parameter("a", value=3).get_parameter_value()).integer_value == 3
    assert node.get_parameter("a").value == 3


STRINGS = ParameterDescriptor(type=Parameter.Type.STRING_ARRAY.value)


@pytest.mark.parametrize(
    ("value", "descriptor", "override", "expected", "kind"),
    [
        ([], None, None, [], Parameter.Type.BYTE_ARRAY),
        ([], None, ["a"], ["a"], Parameter.Type.STRING_ARRAY),
        ([], None, [1.5], [1.5], Parameter.Type.DOUBLE_ARRAY),
        ([], STRINGS, None, [], Parameter.Type.STRING_ARRAY),
        ([], STRINGS, ["a"], ["a"], Parameter.Type.STRING_ARRAY),
        (["a"], None, [], [], Parameter.Type.STRING_ARRAY),
        (Parameter.Type.STRING_ARRAY, None, [], [], Parameter.Type.STRING_ARRAY),
        (Parameter.Type.INTEGER_ARRAY, None, [], [], Parameter.Type.INTEGER_ARRAY),
    ],
)
def test_an_empty_list_has_the_element_type_of_the_others(make_node, value, descriptor, override, expected, kind):
    words = [] if override is None else ["--ros-args", "-p", f"names:={override}".replace("'", '"')]
    node = make_node("lists", cli_args=words, use_global_arguments=False)
    node.declare_parameter("names", value, *([] if descriptor is None else [copy.deepcopy(descriptor)]))
    parameter = node.get_parameter("names")
    assert (list(parameter.value), parameter.type_) == (expected, kind)
    assert node.describe_parameter("names").type == kind.value


def test_the_first_list_that_is_set_gives_an_empty_list_its_element_type(node):
    node.declare_parameter("names", [])
    assert [result.successful for result in node.set_parameters([Parameter("names", value=["a", "b"])])] == [True]
    assert node.get_parameter("names").value == ["a", "b"]
    assert node.describe_parameter("names").type == Parameter.Type.STRING_ARRAY.value
    (result,) = node.set_parameters([Parameter("names", value=[1])])
    assert (result.successful, "expected 'Type.STRING_ARRAY'" in result.reason) == (False, True)
    assert [result.successful for result in node.set_parameters([Parameter("names", value=[])])] == [True]
    assert node.get_parameter("names") == Parameter("names", Parameter.Type.STRING_ARRAY, [])


def test_an_empty_list_does_not_override_a_single_value(make_node):
    node = make_node("lists", cli_args=["--ros-args", "-p", "gain:=[]"], use_global_arguments=False)
    node.declare_parameter("gain", 1.5)
    with pytest.raises(ParameterUninitializedException):
        node.get_parameter("gain")


def test_parameters_before_an_undeclared_one_are_set(node):
    node.declare_parameter("a", 1)
    node.declare_parameter("b", 1)
    values = [Parameter("a", value=2), Parameter("missing", value=3), Parameter("b", value=4)]
    with pytest.raises(ParameterNotDeclaredException):
        node.set_parameters(values)
    assert (node.get_parameter("a").value, node.get_parameter("b").value) == (2, 1)
    with pytest.raises(ParameterNotDeclaredException):
        node.set_parameters_atomically([Parameter("a", value=5), Parameter("missing", value=3)])
    assert node.get_parameter("a").value == 2


def test_parameters_by_name_as_programs_for_humble_read_them(node):
    node.declare_parameter("a", 1)
    assert node._parameters["a"].value == 1
    assert set(node._parameters) >= {"a", "use_sim_time"}


def test_a_default_may_be_a_message(node):
    assert node.declare_parameter("n", ParameterValue(type=2, integer_value=4)).value == 4
    dynamic = ParameterDescriptor(dynamic_typing=True)
    assert node.declare_parameter("nothing", ParameterValue(), dynamic).type_ is Parameter.Type.NOT_SET


def test_a_static_parameter_cannot_lose_its_value(node):
    node.declare_parameter("n", 4)
    (result,) = node.set_parameters([Parameter("n", Parameter.Type.NOT_SET)])
    assert (result.successful, result.reason) == (False, "Static parameter cannot be undeclared")
    assert node.get_parameter("n").value == 4
