# SPDX-License-Identifier: Apache-2.0
"""The YAML of contracts: what is written is read again, and each mistake is an error that names its place."""

import random

import pytest

from coframe.contract import (
    AvailabilityRequirement,
    Contract,
    IgnoredCode,
    TopicRequirement,
    TransformRequirement,
    contract_yaml,
    parse_contract,
    parse_tolerance,
    read_contract,
)
from coframe.doctor import Severity
from coframe.errors import ContractError

NAMES = [
    "base_link",
    "robot1/lidar",
    "cap screw(0)",
    "a: b",
    "#",
    "'",
    '"',
    "yes",
    "1e-05",
    "Grüße",
    "\\",
    "{x}",
    "- a",
]


def a_contract(rng):
    """Return a contract with names that YAML would read as something else without quotes."""
    name = lambda: rng.choice(NAMES)  # noqa: E731
    number = lambda: round(rng.uniform(0.001, 2000), 6)  # noqa: E731
    duration = lambda: rng.randint(1, 10**10)  # noqa: E731
    static = lambda: TransformRequirement(  # noqa: E731
        name(), name(), rng.choice(["", "/robot1"]), True, (number(), -number(), 1e-9), (0.0, 0.0, -1.5), (0.002, 0.01)
    )
    moving = lambda: TransformRequirement(  # noqa: E731
        name(), name(), min_rate=number(), max_gap=duration(), tolerance=(0.002, 0.01)
    )
    return Contract(
        transforms=tuple(rng.choice([static, moving])() for _ in range(rng.randint(0, 5))),
        topics=tuple(
            TopicRequirement(f"/{i}", name(), name(), number(), duration(), rng.random() < 0.5, rng.random() < 0.5)
            for i in range(rng.randint(0, 3))
        ),
        availability=tuple(
            AvailabilityRequirement(name(), name(), "/scan", "", duration(), rng.randint(0, 100) / 100)
            for _ in range(rng.randint(0, 3))
        ),
        clock=rng.choice(["wall", "simulated", "any"]),
        other_frames=rng.random() < 0.5,
        fail_on=rng.choice([Severity.ERROR, Severity.WARNING, Severity.NOTE, None]),
        ignore=tuple(IgnoredCode(code, name()) for code in rng.sample(["TF001", "TF018"], rng.randint(0, 2))),
    )


@pytest.mark.parametrize("seed", range(50))
def test_what_is_written_is_read_again(seed):
    contract = a_contract(random.Random(seed))
    again = parse_contract(contract_yaml(contract, source="good\nbad.mcap"))
    # The tolerance of moving transforms is not written, because nothing is compared with it.
    assert contract_yaml(again) == contract_yaml(contract)
    for before, after in zip(contract.transforms, again.transforms, strict=True):
        assert (before.parent, before.child, before.xyz, before.min_rate, before.max_gap) == (
            after.parent,
            after.child,
            after.xyz,
            after.min_rate,
            after.max_gap,
        )
        assert not before.static or before.tolerance == pytest.approx(after.tolerance, rel=1e-5)
    for part in ("topics", "availability", "clock", "other_frames", "fail_on", "ignore"):
        assert getattr(again, part) == getattr(contract, part)


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("- a", "the document must be a mapping of keys to values"),
        ("version: 2", "version is 2; this version of coframe reads version 1"),
        ("transform: []", "the document has an unknown key 'transform'"),
        ("transforms: {}", "transforms must be a list, not {}"),
        ("transforms: [1]", r"transforms\[0\] must be a mapping of keys to values"),
        ("transforms: [{parent: a}]", r"transforms\[0\] \(a -> None\).child is missing"),
        ("transforms: [{parent: a, child: 5}]", "child must be a text, not 5"),
        ("transforms: [{parent: a, child: b, xyz: [1, 2]}]", "xyz must be three numbers"),
        ("transforms: [{parent: a, child: b, xyz: [1, 2, .nan]}]", "xyz must be three numbers"),
        ("transforms: [{parent: a, child: b, min_rate: 0}]", "min_rate must be greater than 0, not 0"),
        ("transforms: [{parent: a, child: b, min_rate: .inf}]", "min_rate must be greater than 0, not inf"),
        ("transforms: [{parent: a, child: b, min_rate: true}]", "min_rate must be a number, not True"),
        ("transforms: [{parent: a, child: b, min_rate: fast}]", "min_rate must be a number, not 'fast'"),
        ("transforms: [{parent: a, child: b, max_gap: 0.5}]", "max_gap must be a text with a unit, not 0.5"),
        ("transforms: [{parent: a, child: b, max_gap: 5 parsecs}]", "max_gap cannot be used"),
        ("transforms: [{parent: a, child: b, max_gap: -5s}]", "max_gap cannot be used: '-5s' is not a duration"),
        ("transforms: [{parent: a, child: b, static: true, min_rate: 5}]", "static transforms have no min_rate"),
        ("transforms: [{parent: a, child: b, tolerance: 5mm}]", "is not a distance and an angle with their units"),
        ("tolerance: 5mm, 3mm", "is not a distance and an angle with their units"),
        ("topics: [{name: /scan, rate: 5}]", r"topics\[0\] \(/scan\) has an unknown key 'rate'"),
        ("availability: [{target: a, source: b, at: /c, share: 101%}]", "is not a percentage"),
        ("availability: [{target: a, source: b, at: /c, share: 0.99}]", "share must be a text with a unit, not 0.99"),
        ("clock: moon", "clock must be wall, simulated or any, not 'moon'"),
        ("findings: {fail_on: fatal}", "findings.fail_on must be error, warning, note or never, not 'fatal'"),
        ("findings: {ignore: [{code: TF001}]}", r"findings.ignore\[0\] \(TF001\).reason is missing"),
        ("findings: {ignore: [{code: TF999, reason: a}]}", "code is 'TF999', which the doctor does not have"),
        ("a: [", "the contract, line 2: "),
        ("a: &a [*a]", "an alias"),
    ],
)
def test_each_mistake_is_named_with_its_place(text, error):
    with pytest.raises(ContractError, match=error):
        parse_contract(text)


def test_a_misspelt_key_is_suggested():
    with pytest.raises(ContractError) as caught:
        parse_contract("topics: [{name: /scan, min_rat: 5}]")
    assert caught.value.hint == "Did you mean 'min_rate'?"


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(ContractError, match="No such file"):
        read_contract(tmp_path / "none.yaml")
    with pytest.raises(ContractError, match="is a folder, not a file"):
        read_contract(tmp_path)


@pytest.mark.parametrize(
    ("text", "meters", "degrees"),
    [("5mm, 0.2deg", 0.005, 0.2), ("1cm,0rad", 0.01, 0.0), ("0.5m, 10 mrad", 0.5, 0.572957795)],
)
def test_tolerances(text, meters, degrees):
    found = parse_tolerance(text)
    assert found == (pytest.approx(meters), pytest.approx(degrees * 3.141592653589793 / 180))
