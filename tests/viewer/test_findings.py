# SPDX-License-Identifier: Apache-2.0
"""The findings of the doctor that tabs receive."""

import shutil
import threading
import time

import pytest

pytest.importorskip("websockets", reason="the viewer needs websockets")

from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.doctor.codes import page
from coframe.errors import ViewerError
from coframe.messages import find
from coframe.viewer.sources.recorded import RecordedSource

TIMEOUT = 30.0  # Seconds.


def jumping(frame="base_link"):
    """Return a run in which a frame jumps by three meters once."""
    run = Run.healthy(skip={"odom", "scan", "static"})
    for i in range(600):
        run.drive(START + i * SECOND // 50, child=frame, offset=3.0 if i > 300 else 0.0)
    return run


def findings(tab):
    """Wait for the result of an examination."""
    return tab.wait("findings", lambda message: message["state"] not in {"none", "waiting"})


def test_the_findings_of_a_recording_name_the_affected_frames(view, open_tab, tmp_path):
    tab = open_tab(view(coframe.open_bag(jumping().write(tmp_path), prefix="r1/", keep="odom")))
    origin = int(tab.wait("hello")["origin"])
    message = findings(tab)
    (finding,) = message["findings"]
    assert (finding["code"], finding["severity"], finding["frames"]) == ("TF020", "warning", ["r1/base_link"])
    assert finding["subject"] == "odom → r1/base_link"
    assert "jumps once, at worst 2.99 m" in finding["text"]
    assert abs(finding["first"] + origin - (START + 6 * SECOND)) <= 20 * MS
    assert finding["why"] == page("TF020").why
    assert tab.ask("page", "explain", code="tf020")["text"] == page("TF020").text
    assert "there is no page for 'TF999'" in tab.ask("problem", "explain", code="TF999")["text"]


def test_a_healthy_recording_has_no_findings(view, open_tab, tmp_path):
    tab = open_tab(view(Run.healthy(seconds=2).write(tmp_path)))
    assert findings(tab)["findings"] == []


def test_a_deleted_recording_gives_a_message(view, open_tab, tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    tab = open_tab(view(coframe.open_bag(jumping().write(folder))))
    shutil.rmtree(folder)
    message = findings(tab)
    assert message["state"] == "failed"
    assert str(folder) in message["text"]
    tab.frame_update()


def test_the_samples_of_all_namespaces_count_towards_the_limit(tmp_path, monkeypatch):
    run = Run()
    for robot in ("/r1", "/r2"):
        for i in range(6):
            run.tf("odom", "base", START + i * SECOND, topic=f"{robot}/tf")
    monkeypatch.setattr("coframe.viewer.sources.recorded._MAX_EXAMINED_SAMPLES", 10)
    with (
        coframe.open_bag(run.write(tmp_path)) as recording,
        pytest.raises(ViewerError, match="has 12 samples, but the viewer examines at most 10"),
    ):
        next(RecordedSource(recording).examine())


def test_a_buffer_is_not_examined(view, open_tab):
    buffer = coframe.Buffer()
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
    tab = open_tab(view(buffer))
    assert tab.wait("findings")["state"] == "none"


@pytest.mark.slow
def test_the_graph_is_examined_while_a_page_is_open(domain_id, view, open_tab):
    pytest.importorskip("dds_library", reason="transforms come over DDS")
    with coframe.connect("looker", domain=domain_id) as ros, Publisher("one", domain_id, 0.0):
        tab = open_tab(view(ros))
        assert findings(tab)["findings"] == []
        with Publisher("other", domain_id, 5.0):
            message = tab.wait("findings", lambda message: message["findings"])
        (finding,) = message["findings"]
        assert (finding["code"], finding["severity"], finding["frames"]) == ("TF003", "error", ["base_link"])
        assert sorted(finding["publishers"]) == ["/one", "/other"]
        assert "coframe_view_doctor" in nodes(ros)
        tab.close()
        deadline = time.monotonic() + TIMEOUT
        while "coframe_view_doctor" in nodes(ros) and time.monotonic() < deadline:
            time.sleep(0.1)
        assert "coframe_view_doctor" not in nodes(ros)


def nodes(ros):
    return {name for _, name in ros.participant.nodes()}


class Publisher:
    """A node that publishes base_link repeatedly."""

    def __init__(self, name, domain, x):
        self._ros = coframe.connect(name, domain=domain)
        self._x = x
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()

    def __exit__(self, *_):
        self._ended.set()
        self._thread.join()
        self._ros.close()

    def _run(self):
        stamped, messages = find("geometry_msgs/msg/TransformStamped"), find("tf2_msgs/msg/TFMessage")
        publisher = self._ros.publisher("/tf", messages)
        begin = time.monotonic()
        while not self._ended.wait(0.02):
            one = stamped(child_frame_id="base_link")
            one.header.frame_id = "odom"
            one.header.stamp.sec, one.header.stamp.nanosec = divmod(time.time_ns(), SECOND)
            one.transform.translation.x = self._x + 0.1 * (time.monotonic() - begin)
            publisher.publish(messages(transforms=[one]))
