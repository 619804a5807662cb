# SPDX-License-Identifier: Apache-2.0
"""Values of parameters and parameter files, by rcl's own parser."""

import random
import re
from collections.abc import Iterator

import pytest
from rcl_parser import LIBRARY, RclParser

from rclpy import _yaml
from rclpy._parameter_words import parse_scalar

pytestmark = pytest.mark.slow
pytest.importorskip("yaml")
if not LIBRARY.exists():
    pytest.skip("rcl's parser (pip install --group oracle) is not installed", allow_module_level=True)

WORDS = 12_000
VALUES = 12_000
FILES = 12_000
DIGITS = "0123456789"
FIXED = [
    *(
        "true",
        "True",
        "tRUE",
        "yes",
        "No",
        "oN",
        "y",
        "N",
        "null",
        "~",
        "Null",
        "nan",
        "-NaN",
        "nan()",
        "nan(a_1)",
        "nan(-)",
    ),
    *(
        "inf",
        "+Inf",
        "-INFINITY",
        "infinit",
        ".inf",
        "-.Inf",
        "+.INF",
        ".iNf",
        ".NaN",
        "-.nan",
        "NAN",
        "1e400",
        "-1e-400",
    ),
    *("1e-310", "4.9e-324", "2.2250738585072014e-308", "2.2250738585072011e-308", "0e-999", "0x1p-1074", "0x1p-1075"),
    *(
        "0x1.8p-1074",
        "0x1p1023",
        "0x1p1024",
        "0x.p1",
        "0x.8",
        "0x1.",
        "0x",
        "0X1P+3",
        "0x1p",
        "0b1",
        "0o7",
        "1_0",
        "1,0",
    ),
    *(
        "9223372036854775807",
        "9223372036854775808",
        "-9223372036854775808",
        "-9223372036854775809",
        "0xffffffffffffffff",
    ),
    *(
        "0777777777777777777777",
        "01777777777777777777777",
        "00",
        "-0",
        "+0",
        "-0x0",
        "-0.0",
        "08",
        "0.",
        ".0",
        ".",
        "-",
        "+",
    ),
    *(
        "1.e5",
        ".e5",
        "1e",
        "1e+",
        "1e5.0",
        "1d5",
        "1f",
        "1:30",
        "2024-01-01",
        "12:30:45.6",
        "a b",
        "a:b",
        "http://a:1/b",
    ),
    *("0" * 40, "0x" + "0" * 40 + "1", "0" * 40 + "7", "1" + "0" * 310, "0." + "0" * 330 + "1", "\u0661\u0662"),
]


def word(rng: random.Random) -> str:
    """Return a word like a number, or one of the words above, possibly with one character changed."""
    kind = rng.randrange(6)
    sign = rng.choice(["", "", "-", "+"])
    if kind == 0:
        text = sign + "".join(rng.choices(DIGITS, k=rng.randrange(1, 22)))
    elif kind == 1:
        text = (
            sign
            + rng.choice(["0x", "0X", "0", "0o", "0b"])
            + "".join(rng.choices("0123456789abcdefAB", k=rng.randrange(18)))
        )
    elif kind == 2:
        digits = "".join(rng.choices(DIGITS, k=rng.randrange(18))), "".join(rng.choices(DIGITS, k=rng.randrange(18)))
        exponent = (
            rng.choice(["", "", "e", "E"]) and f"{rng.choice('eE')}{rng.choice(['', '-', '+'])}{rng.randrange(400)}"
        )
        text = sign + digits[0] + rng.choice([".", ".", ""]) + digits[1] + exponent
    elif kind == 3:
        mantissa = "".join(rng.choices("0123456789abcdef", k=rng.randrange(16)))
        text = f"{sign}0x{mantissa}.{mantissa[::-1]}p{rng.choice(['', '-', '+'])}{rng.randrange(1200)}"
    else:
        text = rng.choice(FIXED)
    if rng.random() < 0.2:
        at = rng.randrange(len(text) + 1)
        text = text[:at] + rng.choice([*"0x.-+e_ANfay1:", ""]) + text[at + rng.randrange(2) :]
    return text


def scalar(rng: random.Random) -> str:
    """Return a scalar of YAML, rarely not a valid one."""
    text = (
        word(rng) if rng.random() < 0.7 else rng.choice(["arm", "a-b", "/tf", "a/b", "it's", "x y", "é", "a#b", "-a"])
    )
    style = rng.random()
    if style < 0.1:
        return "'" + text.replace("'", "''") + "'"
    if style < 0.2:
        return f'"{text}{rng.choice(["", "", chr(92) + "n", chr(92) + "x41", chr(92) + "0b"])}"'
    if style < 0.23:
        return f"{rng.choice(['!!str', '!!int', '!!float', '!x', '&a', '*a', '!<tag:yaml.org,2002:str>'])} {text}"
    return text


def value(rng: random.Random) -> str:
    """Return what follows `name:=` on a command line."""
    kind = rng.random()
    if kind < 0.5:
        return scalar(rng)
    if kind < 0.9:
        same = rng.choice(
            [lambda: scalar(rng), lambda: str(rng.randrange(99)), lambda: rng.choice(["a", "b c", "'d'"])]
        )
        items = [same() for _ in range(rng.randrange(4))]
        separator = rng.choice([",", ", ", " , "])
        return f"[{separator.join(items)}{rng.choice(['', '', '', ',', ' '])}]"
    return rng.choice(
        [
            "",
            " ",
            "- {}",
            "[{}]",
            "{}: 1",
            "{{a: {}}}",
            "{} # c",
            "#{}",
            "|-\n {}",
            ">\n {}",
            "---\n{}",
            "? {}",
            "{}\n...",
            "@{}",
            "%{}",
            "\t{}",
            "{}]",
            "[{}",
            "{},",
        ]
    ).format(scalar(rng))


def documents(rng: random.Random) -> str:
    """Return a parameter file of several blocks; nodes and names occur several times."""

    def tree(depth: int) -> Iterator[str]:
        for name in rng.sample(["a", "b", "gain", "use_sim_time", "1", "x y"], rng.randrange(1, 4)):
            if depth and rng.random() < 0.3:
                yield f"{name}{depth}:"
                yield from (f"  {line}" for line in tree(depth - 1))
            else:
                yield f"{name}: {leaf[name]()}"

    number = lambda: str(rng.randrange(1000))  # noqa: E731 - a value of one type for each name: see the docstring below
    leaf = {
        "a": number,
        "b": lambda: rng.choice(["1.5", "inf", "1e3", ".5"]),
        "gain": lambda: f"[{', '.join(number() for _ in range(rng.randrange(1, 4)))}]",
        "use_sim_time": lambda: rng.choice(["true", "no", "On"]),
        "1": lambda: rng.choice(["x", "'5'", "tRUE", '"a\\tb"', "|-\n          text"]),
        "x y": number,
    }
    nodes = [
        "arm",
        "/arm",
        "/**",
        "/*",
        "x/arm",
        "/x/**",
        "x:\n  arm",
        "'**'",
        "/:\n  arm",
        "x/:\n  arm",
        "_a1",
        "/x/*/arm",
    ]
    faults = ["1a", "a-b", "a//b", "/", "x/arm/", "''", "/***", "a*", "x:\n  /arm", "[a]", "my arm", "é"]
    lines: list[str] = []
    for _ in range(rng.randrange(1, 5)):
        node = rng.choice(faults if rng.random() < 0.04 else nodes)
        indent = "    " if "\n" in node else "  "
        lines += [f"{node}:", f"{indent}{'ros__parameters' if rng.random() > 0.02 else 'ros_parameters'}:"]
        lines += [f"{indent}  {line}" for line in tree(2)]
    text = "\n".join(lines) + "\n"
    if rng.random() < 0.3:
        at = rng.randrange(len(text))
        text = (
            text[:at]
            + rng.choice([":", " ", "\n", "&a ", "*a", "[", "{", "'", "- ", "#", "", "---\n", "{}"])
            + text[at + rng.randrange(3) :]
        )
    return text


@pytest.fixture(scope="module")
def rcl() -> RclParser:
    return RclParser()


def ours(text: str) -> tuple[bool, object]:
    try:
        parsed = _yaml.parse_value(text)
    except ValueError:
        return False, None
    return True, None if parsed == [] else parsed


def kind(item: object) -> tuple[type, ...]:
    return (list, type(item[0])) if isinstance(item, list) and item else (type(item),)


def is_deliberate(text: str, refused: str) -> bool:
    """Return whether a file may be accepted by one parser only; `refused` is empty, or why coframe refuses it."""
    if refused.startswith("Mappings cannot be in lists"):  # rcl reads {a: [{b: 1}]} as a.b: [1]
        return True
    # In a second block, rcl gives what has no name to the last name of the first one.
    if refused.startswith(("Cannot have a value before", "Expected the name of a parameter")):
        return True
    if re.search(r"ros__parameters:\s*(- |\[)", text):  # rcl reads {ros__parameters: [{a: 1}]} like a mapping
        return bool(refused)
    # The wheel contains an old libyaml: with \\' in double quotes, without colons in the words of lists.
    return "unknown escape character" in refused or (not refused and re.search(r"\[[^\]]*:", text) is not None)


def test_types_of_words(rcl):
    rng = random.Random(2)
    words = {*FIXED, *(word(rng) for _ in range(2 * WORDS))} - {""}
    compared = 0
    for text in words:
        quoted = f"|-\n {text}" if not text[0].isspace() else f"|1-\n {text}"  # any word, without other rules of YAML
        accepted, expected = rcl.value(quoted)
        if accepted and "\n" not in text:
            assert repr(parse_scalar(text)) == repr(expected), text
            compared += 1
    assert compared > WORDS


def test_values_on_the_command_line(rcl):
    rng = random.Random(2)
    counts = {True: 0, False: 0}
    for text in dict.fromkeys(value(rng) for _ in range(3 * VALUES)):
        if "\0" in text or not text:
            continue
        accepted, expected = rcl.value(text)
        if not accepted and ours(text)[0] and ":" in text and "[" in text:
            continue  # The wheel contains an old libyaml without colons in the words of lists.
        counts[accepted] += 1
        assert (accepted, repr(expected)) == (ours(text)[0], repr(ours(text)[1])), text
    assert sum(counts.values()) > VALUES
    assert min(counts.values()) > VALUES / 20


def test_parameter_files(rcl, tmp_path):
    """A name has one type in a file: rcl keeps the first type of a name that is given twice, coframe the last value."""
    rng = random.Random(2)
    counts = {True: 0, False: 0}
    path = tmp_path / "parameters.yaml"
    retyped = 0
    for text in dict.fromkeys(documents(rng) for _ in range(int(1.2 * FILES))):
        path.write_text(text)
        accepted, expected = rcl.file(path)
        try:
            found = _yaml.load_parameters(str(path))
            refused = ""
        except ValueError as error:
            found, refused = {}, str(error)
        if accepted == bool(refused) and is_deliberate(text, refused):
            continue
        counts[accepted] += 1
        assert accepted == (not refused), f"{text}\n{refused}"
        assert list(expected) == list(found), text
        for node, values in expected.items():
            assert {name for name, item in values.items() if item is not None} <= found[node].keys(), text
            for name, item in found[node].items():
                expected_item = values.get(name)
                is_given_twice = text.count(name.rpartition(".")[2]) > 1 and kind(item) != kind(expected_item)
                assert is_given_twice or repr(expected_item) == repr(None if item == [] else item), f"{name} in {text}"
                retyped += is_given_twice
    assert sum(counts.values()) > FILES
    assert min(counts.values()) > FILES / 50
    assert retyped < FILES / 50
