# SPDX-License-Identifier: Apache-2.0
"""Which way a connection receives transforms: each row of the table."""

import sys

import pytest

import coframe
from coframe.connection import _receivers as receivers
from coframe.connection import shared_transforms

# For each way: the argument of `coframe.connect`, and the class.
CASES = {"shared": (True, receivers.SharedReceiver), "own": (False, receivers.OwnReceiver)}


def test_each_way_has_a_case():
    assert [row.name for row in receivers.RECEIVERS] == list(CASES)


@pytest.mark.parametrize("name", CASES)
def test_receiver(name, domain_id):
    shared, kind = CASES[name]
    if shared and not sys.platform.startswith("linux"):
        pytest.skip("transforms are shared on Linux only")
    with coframe.connect("one", domain=domain_id, shared=shared) as ros:
        assert type(ros._receiver) is kind
        assert ros.shared is shared


def test_where_sharing_is_not_possible_the_next_way_is_used(domain_id, monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    monkeypatch.setattr(shared_transforms, "_FOLDER", str(tmp_path / "file"))
    with coframe.connect("one", domain=domain_id, shared=True) as ros:
        assert type(ros._receiver) is receivers.OwnReceiver
