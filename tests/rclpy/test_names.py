# SPDX-License-Identifier: Apache-2.0
"""Validation and expansion of names."""

import re

import pytest

from rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidServiceNameException,
    InvalidTopicNameException,
)
from rclpy.expand_topic_name import expand_topic_name
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.validate_topic_name import validate_topic_name


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("/a/b", "/a/b"),
        ("a", "/ns/a"),
        ("~", "/ns/arm"),
        ("~/a", "/ns/arm/a"),
        ("~a", "/ns/arma"),
        ("{node}/a", "/ns/arm/a"),
        ("/x{namespace}/a", "/x/ns/a"),
    ],
)
def test_expansion(name, expected):
    assert expand_topic_name(name, "arm", "/ns") == expected


def test_root_namespace():
    assert expand_topic_name("a", "arm", "/") == "/a"
    assert expand_topic_name("~/a", "arm", "/") == "/arm/a"


@pytest.mark.parametrize("name", ["", "a b", "a/", "1a", "a/1b", "a~", "a{", "{1}", "{a b}", "a-b", "~ab", "~{node}"])
def test_invalid_topic_names(name):
    with pytest.raises(InvalidTopicNameException, match="Invalid topic name"):
        validate_topic_name(name)
    with pytest.raises(InvalidServiceNameException, match="Invalid service name"):
        validate_topic_name(name, is_service=True)


def test_repeated_slashes_are_only_invalid_in_full_names():
    assert validate_topic_name("a//b")
    with pytest.raises(InvalidTopicNameException, match="must not contain repeated '/'"):
        validate_full_topic_name("/a//b")


def test_unknown_substitution():
    with pytest.raises(ValueError, match=r"topic name '{robot}/a' is invalid: unknown substitution: {robot}"):
        expand_topic_name("{robot}/a", "arm", "/")


@pytest.mark.parametrize(
    ("name", "text", "index"),
    [
        ("a}", "topic name must not have unmatched (unbalanced) curly braces '{}'", 1),
        ("a/{b", "topic name must not have unmatched (unbalanced) curly braces '{}'", 2),
        ("{a/b}", "substitution name must not contain characters other than alphanumerics or '_'", 2),
        ("{a~}", "topic name must not have tilde '~' unless it is the first character", 2),
        ("{1a}", "substitution name must not start with a number", 1),
        ("~a/b", "topic name must not have a tilde '~' that is not followed by a forward slash '/'", 1),
        ("x/1", "topic name token must not start with a number", 2),
    ],
)
def test_the_fault_that_rcl_reports(name, text, index):
    with pytest.raises(InvalidTopicNameException) as caught:
        validate_topic_name(name)
    assert (caught.value.error_msg, caught.value.invalid_index) == (text, index)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (
            ("a?", "n", "/"),
            "topic name 'a?' is invalid: topic name must not contain characters other than alphanumerics",
        ),
        (("a", "n?", "/"), "node name 'n?' is invalid: node name must not contain characters other than"),
        (("a", "n", "ns"), "node namespace 'ns' is invalid: namespace must be absolute, it must lead with a '/'"),
        (("a", "n", ""), "node namespace '' is invalid: namespace must not be empty"),
    ],
)
def test_expansion_of_invalid_names(arguments, text):
    with pytest.raises(ValueError, match=re.escape(text)):
        expand_topic_name(*arguments)


@pytest.mark.parametrize("method", ["count_publishers", "count_subscribers", "count_services", "count_clients"])
def test_counting_of_invalid_names(node, method):
    with pytest.raises(ValueError, match="topic name '42' is invalid: topic name token must not start with a number"):
        getattr(node, method)("42")


def test_error_marks_the_invalid_character():
    with pytest.raises(InvalidTopicNameException) as caught:
        validate_topic_name("ab cd")
    assert str(caught.value).splitlines()[1:] == ["  'ab cd'", "     ^"]


@pytest.mark.parametrize("name", ["a", "/a/{b}", "~/a"])
def test_full_names_must_be_expanded(name):
    with pytest.raises(InvalidTopicNameException):
        validate_full_topic_name(name)


def test_valid_names():
    assert validate_full_topic_name("/tf_static")
    assert validate_topic_name("~/a_1/{node}")
    assert validate_node_name("arm_1")
    assert validate_namespace("/")
    assert validate_namespace("/a/b_2")


@pytest.mark.parametrize("name", ["", "1a", "a/b", "a b"])
def test_invalid_node_names(name):
    with pytest.raises(InvalidNodeNameException):
        validate_node_name(name)


@pytest.mark.parametrize("name", ["", "a", "/a/", "//a", "/1a", "/a b"])
def test_invalid_namespaces(name):
    with pytest.raises(InvalidNamespaceException):
        validate_namespace(name)


def test_hidden_names():
    assert topic_or_service_is_hidden("/arm/_action/status")
    assert not topic_or_service_is_hidden("/arm/action_")
