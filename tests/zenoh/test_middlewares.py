# SPDX-License-Identifier: Apache-2.0
"""The middleware is chosen in code, and one process may use all of them."""

import os
import time
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="these tests use both middlewares")

import coframe
from coframe.messages import find
from coframe.system.middleware_checks import MIDDLEWARE_CHECKS
from coframe.system.report import collect
from coframe.wire import selection
from coframe.wire.participant import Participant

STRING = find("std_msgs/msg/String")

# The middlewares of this distribution; others are in distributions of their own.
WIRES = ("dds", "zenoh")


def test_each_middleware_has_a_test() -> None:
    assert set(selection.wires()) - {"fastdds"} == set(WIRES)


@pytest.mark.parametrize("wire", WIRES)
def test_a_connection_over(wire: str, zenoh_domain: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The call decides, regardless of the environment."""
    monkeypatch.setenv("COFRAME_WIRE", next(other for other in WIRES if other != wire))
    before = dict(os.environ)
    with coframe.connect("listener", domain=zenoh_domain, wire=wire) as ros:
        assert (ros.config.wire, ros.participant.wire) == (wire, wire)
        node = ros.participant.add_node("/", "broadcaster")
        broadcaster = ros.participant.static_broadcaster(node)
        broadcaster.send([_static("map", "base")])
        assert ros.buffer.wait("map", "base", timeout="20s").translation == pytest.approx((1.0, 2.0, 3.0))
    assert dict(os.environ) == before


def test_one_process_joins_a_domain_over_both(zenoh_domain: int) -> None:
    with (
        coframe.connect("one", domain=zenoh_domain, wire="dds") as dds,
        coframe.connect("one", domain=zenoh_domain, wire="zenoh") as zenoh,
        coframe.connect("two", domain=zenoh_domain) as default,
    ):
        assert dds.participant is not zenoh.participant
        assert default.participant is zenoh.participant, "COFRAME_WIRE selects it"
        received = {ros.config.wire: ros.subscribe("/news", STRING) for ros in (dds, zenoh)}
        for ros in (dds, zenoh):
            ros.publisher("/news", STRING).publish(STRING(data=f"over {ros.config.wire}"))
        for wire, subscription in received.items():
            message = subscription.receive("20s")
            assert message is not None
            assert message.data == f"over {wire}"
            assert subscription.receive(0) is None, "the middlewares do not mix"
    assert not Participant._instances.keys() & {(wire, zenoh_domain) for wire in WIRES}


@pytest.mark.parametrize("create", [coframe.connect, Participant.get])
def test_an_unknown_middleware_is_one_clear_error(create) -> None:
    with pytest.raises(coframe.WireError, match="'foodds' is not a middleware") as caught:
        create(wire="foodds")
    assert caught.value.hint == f"Valid names: {selection.alternatives()}."


def _static(parent: str, child: str):
    message = find("geometry_msgs/msg/TransformStamped")()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x, message.transform.translation.y, message.transform.translation.z = 1.0, 2.0, 3.0
    return message


def test_the_doctor_examines_each_middleware() -> None:
    assert [check.wire for check in MIDDLEWARE_CHECKS] == list(WIRES)


@pytest.mark.parametrize("wire", WIRES)
def test_the_doctor_examines(wire: str, zenoh_domain: int) -> None:
    report = collect(zenoh_domain, listen=0.1, environment={**os.environ, "COFRAME_WIRE": wire})
    assert report.wire == (wire, "COFRAME_WIRE is set")
    assert (report.probe is not None, report.zenoh is not None) == (wire == "dds", wire == "zenoh")
    assert report.nodes is not None


@pytest.mark.parametrize("wire", WIRES)
def test_relays_and_recorders_over(wire: str, zenoh_domain: int, tmp_path: Path) -> None:
    with coframe.relay("robot1,robot2", prefix_each=True, domain=zenoh_domain, wire=wire) as relay:
        assert relay.participant.wire == wire
    with (
        coframe.connect("talker", domain=zenoh_domain, wire=wire) as ros,
        coframe.record(tmp_path / "run", domain=zenoh_domain, wire=wire) as recorder,
    ):
        publisher = ros.publisher("/news", STRING)
        deadline = time.monotonic() + 20
        while not recorder.statistics.messages and time.monotonic() < deadline:
            publisher.publish(STRING(data="x"))
            time.sleep(0.05)
    with coframe.open_bag(tmp_path / "run") as recording:
        assert recording.topics["/news"].messages > 0
