"""A replay is one HTML file with the buffer's own poses in it, and reaches nothing outside."""

import base64
import html.parser
import json
import urllib.error
import urllib.parse
import urllib.request

import numpy as np
import pytest

import coframe
from coframe.viewer.http import STATIC

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
HOSTILE = "</script><script>alert(1)</script><!--"

pytestmark = pytest.mark.skipif(not (STATIC / "replay.html").exists(), reason="the page is not built")


class Scripts(html.parser.HTMLParser):
    """The script elements of a page, and the addresses that it names."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.addresses = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        told = dict(attributes)
        self.addresses += [told[name] for name in ("src", "href") if told.get(name)]
        if tag == "script":
            self.scripts.append([told, ""])

    def handle_data(self, data):
        if self.scripts:
            self.scripts[-1][1] += data


@pytest.fixture
def buffer():
    buffer = coframe.Buffer(None)
    for second in range(11):
        far = coframe.Transform.from_rpy([600_000.0 + second, 5_000_000.0, 0.0], [0.0, 0.0, second / 10])
        buffer.set("utm", "base", far, BEGIN + second * SECOND)
    buffer.set("base", HOSTILE, coframe.Transform([0.0, 0.5, 0.0]), static=True)
    return buffer


def fetch(viewer, **query):
    with urllib.request.urlopen(f"{viewer.url}replay?{urllib.parse.urlencode(query)}") as answer:
        return answer.headers, answer.read().decode()


def test_a_replay_holds_what_the_buffer_says(buffer, view, open_tab):
    viewer = view(buffer, fixed="utm")
    hello = open_tab(viewer).wait("hello")
    first, _ = hello["span"]
    headers, page = fetch(viewer, **{"from": first + SECOND, "to": first + 3 * SECOND, "rate": 10, "fixed": "utm"})
    assert headers["Content-Disposition"].startswith("attachment")
    read = Scripts(page)
    (block,) = [text for told, text in read.scripts if told.get("id") == "replay"]
    assert len(read.scripts) == 2, "the block and the program: no name has become an element"
    assert [address for address in read.addresses if not address.startswith("data:")] == []
    replay = json.loads(block)
    assert (replay["format"], replay["version"], replay["fixed"]) == ("coframe-replay", 1, "utm")
    assert replay["origin"] == hello["origin"]
    assert (replay["from"], replay["to"]) == (first + SECOND, first + 3 * SECOND)
    names = [frame["name"] for frame in replay["frames"]]
    assert sorted(names) == sorted(["utm", "base", HOSTILE])
    times = np.frombuffer(base64.b64decode(replay["times"]), "<f8")
    poses = np.frombuffer(base64.b64decode(replay["poses"]), "<f4").reshape(len(times), len(names), 7)
    states = np.frombuffer(base64.b64decode(replay["states"]), np.uint8).reshape(len(times), len(names))
    assert len(times) == 21
    assert (states == 0).all()
    for row in (0, 7, 20):
        for column, name in enumerate(names):
            expected = buffer.lookup("utm", name, int(times[row]) + int(replay["origin"]))
            world = poses[row, column, :3].astype(np.float64) + replay["origin_xyz"]
            np.testing.assert_allclose(world, expected.translation, atol=1e-5)
            assert abs(abs(poses[row, column, 3:] @ expected.quaternion) - 1.0) < 1e-5


def test_a_robot_goes_with_its_meshes(buffer, view, tmp_path):
    (tmp_path / "a.stl").write_bytes(b"solid")
    link = '<link name="base"><visual><geometry><mesh filename="a.stl"/></geometry></visual></link>'
    (tmp_path / "r.urdf").write_text(f'<robot name="r">{link}</robot>')
    _, page = fetch(view(buffer, robot=tmp_path / "r.urdf"))
    (block,) = [text for told, text in Scripts(page).scripts if told.get("id") == "replay"]
    (robot,) = json.loads(block)["robots"]
    assert robot["meshes"] == {"a.stl": "data:model/stl;base64," + base64.b64encode(b"solid").decode()}


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ({"rate": "fast"}, "are numbers"),
        ({"rate": 0}, "up to 100 pictures a second"),
        ({"rate": "nan"}, "up to 100 pictures a second"),
        ({"from": 5, "to": 1}, "must end after it begins"),
        ({"from": "inf"}, "are numbers"),
    ],
)
def test_what_cannot_be_replayed_is_a_sentence(buffer, view, query, says):
    with pytest.raises(urllib.error.HTTPError, match="400") as refused:
        fetch(view(buffer), **query)
    with refused.value:
        assert says in refused.value.read().decode()


def test_too_much_for_one_file_is_a_sentence(view):
    buffer = coframe.Buffer(None)
    for frame in range(1000):
        buffer.set("map", f"f{frame}", coframe.Transform(), BEGIN)
        buffer.set("map", f"f{frame}", coframe.Transform(), BEGIN + 1000 * SECOND)
    with pytest.raises(urllib.error.HTTPError, match="400") as refused:
        fetch(view(buffer), rate=30)
    with refused.value:
        assert "Choose a shorter span or a lower rate." in refused.value.read().decode()
