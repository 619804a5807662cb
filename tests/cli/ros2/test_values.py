# SPDX-License-Identifier: Apache-2.0
"""Values of messages on the command line: typing errors are reported with their place, the reason and an example."""

import click
import pytest

from coframe.cli.ros2.values import read_values
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from std_msgs.msg import String

HELLO = "  Example for std_msgs/msg/String: '{data: hello}'"


def error_for(message, text, capsys):
    with pytest.raises(click.exceptions.Exit) as ended:
        read_values(message, text)
    assert ended.value.exit_code == 2
    return capsys.readouterr().err.splitlines()


@pytest.mark.parametrize(
    ("text", "position", "reason"),
    [
        ("{data:}", 6, "a space is missing after the colon"),
        ("{data: hello", 13, "a comma or } is missing"),
        ("{data: [1, 2", 13, "a comma or ] is missing"),
        ("{data: 'it's'}", 12, "a comma or } is missing"),
        ('{data: "a}', 11, "a quote is missing"),
        ("data: a: b", 8, "the line contains a second colon"),
        ("{data: %x}", 8, "a string that begins with this character needs quotes"),
        ("{data: *x}", 8, "a string that begins with * needs quotes"),
        ("{data: a}}", 10, "text follows the end of the values"),
        ("{", 2, "a value or a closing bracket is missing"),
    ],
)
def test_invalid_yaml_is_shown_with_its_place_and_an_example(text, position, reason, capsys):
    first, shown, pointer, example = error_for(String(), text, capsys)
    assert first.startswith(f"coframe: VALUES is not valid YAML at character {position}: {reason}")
    assert shown == f"    {text}"
    assert pointer == " " * (4 + position - 1) + "^"
    assert example == HELLO


def test_the_line_of_a_long_text(capsys):
    first, shown, pointer, _ = error_for(Twist(), "linear:\n  x: 1.0\n  y: " + "1" * 80 + ": 3", capsys)
    assert "at line 3, character 86: the line contains a second colon" in first
    assert shown[pointer.index("^")] == ":"
    assert len(shown) < 70


def test_values_that_are_no_fields(capsys):
    assert error_for(String(), "hello", capsys) == [
        "coframe: The passed value needs to be a dictionary in YAML format, not 'hello'",
        HELLO,
    ]
    assert error_for(String(), "{data:5}", capsys) == [
        "coframe: VALUES: 'data:5' is not a field: a space is missing after the colon",
        HELLO,
    ]


@pytest.mark.parametrize("kind", [String, Twist, PoseWithCovarianceStamped])
def test_the_example_is_valid(kind, capsys):
    example = error_for(kind(), "{", capsys)[-1].partition("'")[2].rstrip("'")
    read_values(kind(), example)
    assert len(example) < 250
