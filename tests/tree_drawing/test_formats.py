# SPDX-License-Identifier: Apache-2.0
"""Each format, read by an independent program."""

import io
import json
import re
from xml.etree import ElementTree

import pytest

from coframe.tree_drawing._layout import Box, draw
from coframe.tree_drawing.graphviz import as_graphviz
from coframe.tree_drawing.mermaid import as_markdown, as_mermaid
from coframe.tree_drawing.pdf import as_pdf
from coframe.tree_drawing.plain import as_data
from coframe.tree_drawing.svg import as_svg
from coframe.tree_drawing.text import rows

SVG = "{http://www.w3.org/2000/svg}"
EDGES = 24 - 2  # frames minus the roots that are not in a loop


def test_json_has_full_names(forest, hostile):
    data = json.loads(json.dumps(as_data(forest)))
    frames = {frame["name"]: frame for frame in data["frames"]}
    assert set(hostile) <= set(frames)
    assert data["trees"] == [
        {"root": "odom", "frames": 19},
        {"root": "l1", "frames": 4},
        {"root": "elsewhere", "frames": 1},
    ]
    assert data["loops"] == ["l1"]
    base = frames["base_link"]
    assert (base["parent"], base["depth"], base["static"], base["silent_ns"]) == ("odom", 1, False, None)
    assert base["edges"][0]["delay_p99"] == 2_000_000
    assert base["other_edges"][0]["parent"] == "elsewhere"
    assert frames["odom"]["parent"] is None
    assert frames["lidar"]["edges"][0]["rate"] is None


def test_svg(forest, readable):
    drawing = ElementTree.fromstring(as_svg(forest, "<run> & co"))
    texts = [text.text for text in drawing.iter(f"{SVG}text")]
    assert "<run> & co" in texts
    assert set(readable) <= set(texts)
    assert "two\\nlines" in texts
    assert "50.0 Hz, jitter 0 ns" in texts
    assert "also below elsewhere" in texts
    assert "in a loop: below l3" in texts
    assert [text for text in texts if text.startswith("Tree ")] == [
        "Tree 1 of 3: odom",
        "Tree 2 of 3: l1",
        "Tree 3 of 3: elsewhere",
    ]
    titles = [title.text for title in drawing.iter(f"{SVG}title")]
    assert "x" * 10_000 in titles, "browsers show the full name below the pointer"
    assert not re.search(r"href|url\(|<script", as_svg(forest, ""))


def test_boxes_do_not_overlap(forest):
    drawing = draw(forest, "run")
    boxes = [shape for shape in drawing.shapes if isinstance(shape, Box) and shape.title]
    assert len(boxes) == len(forest.frames)
    for i, a in enumerate(boxes):
        assert 0 <= a.x <= a.x + a.width <= drawing.width
        assert 0 <= a.y <= a.y + a.height <= drawing.height
        for b in boxes[:i]:
            apart_x = a.x + a.width <= b.x or b.x + b.width <= a.x
            apart_y = a.y + a.height <= b.y or b.y + b.height <= a.y
            assert apart_x or apart_y, (a, b)


def test_pdf(forest, readable):
    pypdf = pytest.importorskip("pypdf")
    document = pypdf.PdfReader(io.BytesIO(as_pdf(forest, "run (1)")), strict=True)
    (page,) = document.pages
    text = page.extract_text()
    assert document.metadata.title == "run (1)"
    assert "also below elsewhere" in text
    assert "\\u30d5\\u30ec" in text, "characters that the fonts lack are written as escapes"
    for name in readable:
        assert name in text
    drawing = draw(forest, "run (1)")
    assert float(page.mediabox.height) == pytest.approx(drawing.height * 0.75, abs=1)


def test_png(forest, monkeypatch):
    image = pytest.importorskip("PIL.Image")
    png = pytest.importorskip("coframe.tree_drawing.png", reason="PNG needs matplotlib")
    picture = image.open(io.BytesIO(png.as_png(forest, "run $1$"))).convert("RGB")
    drawing = draw(forest, "run $1$", png._replace_unsupported)
    scale = picture.width / drawing.width
    assert scale == pytest.approx(2.0, rel=0.01)
    assert picture.height / drawing.height == pytest.approx(2.0, rel=0.01)
    for box in (shape for shape in drawing.shapes if isinstance(shape, Box) and shape.title):
        inside = picture.crop([round(edge * scale) for edge in (box.x, box.y, box.x + box.width, box.y + box.height)])
        colors = [f"#{red:02x}{green:02x}{blue:02x}" for _, (red, green, blue) in inside.getcolors(1 << 16)]
        assert box.fill in colors, box.title
        assert len(colors) > 10, "the name is written in the box"
        # Texts end inside their boxes, so the pixels just right of the box are white, or those of a line.
        right = round((box.x + box.width + 2.0) * scale)
        margin = picture.crop((right, round((box.y + 3.0) * scale), right + 2, round((box.y + 12.0) * scale)))
        assert margin.getcolors() == [(margin.width * margin.height, (255, 255, 255))], box.title
    monkeypatch.setattr(png, "_MAX_SIDE", 500.0)
    assert max(image.open(io.BytesIO(png.as_png(forest, "run"))).size) <= 500


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of pydot about pyparsing
def test_graphviz(forest):
    pydot = pytest.importorskip("pydot")
    (graph,) = pydot.graph_from_dot_data(as_graphviz(forest, 'a "run"'))
    edges = {(edge.get_source(), edge.get_destination()): edge.get_attributes() for edge in graph.get_edges()}
    assert len(edges) == EDGES + 1
    assert "50.0 Hz" in edges['"odom"', '"base_link"']["label"]
    assert edges['"elsewhere"', '"base_link"']["color"] == "red"
    assert edges['"l3"', '"l1"']["color"] == "red"
    assert ('"base_link"', '"\\"quoted\\" \\\\ back\\\\"') in edges
    clusters = {cluster.get_label(): len(cluster.get_nodes()) for cluster in graph.get_subgraphs()}
    assert clusters == {'"tree of odom"': 19, '"tree of l1"': 4, '"tree of elsewhere"': 1}


def test_mermaid(forest):
    head, title, end, kind, *chart = as_mermaid(forest, "run").splitlines()
    assert (head, end, kind) == ("---", "---", "flowchart LR")
    assert "19" in json.loads(title.removeprefix("title: "))
    nodes = [line for line in chart if re.fullmatch(r' {4}f\d+\["[^"`<>\\{}]*(<br/>[^"`<>\\{}]*)*"\]:::\w+', line)]
    arrows = [line for line in chart if re.fullmatch(r"  f\d+ (-->|-\.->) f\d+", line)]
    assert (len(nodes), len(arrows)) == (24, EDGES + 1)
    assert sum("-.->" in arrow for arrow in arrows) == 2, (
        "the one from the second parent, and the one that closes the loop"
    )
    opened = sum(line.startswith("  subgraph ") for line in chart)
    assert opened == chart.count("  end") == 3
    assert len(nodes) + len(arrows) + 2 * opened + 4 == len(chart), "the other lines are the four styles"
    assert any("#60;b#62;bold#60;/b#62;#38;amp#59;" in node for node in nodes)


def test_markdown_has_one_code_block(forest):
    text = as_markdown(forest, "run")
    assert text.startswith("```mermaid\n")
    assert text.endswith("\n```\n")
    assert text.count("```") == 2


def test_rows_for_a_terminal(forest):
    shown = {row.frame: row for row in rows(forest) if row.kind != "other"}
    assert shown["base_link"].branches + shown["base_link"].name == "└─ base_link"
    assert shown["base_link"].cells[1:4:2] == ("50.0", "2.0")
    assert shown["lidar"].cells == ("", "static", "", "", "", "")
    assert shown["tail"].branches == "   └─ "
    assert all(row.name.isprintable() and len(row.name) < 100 for row in rows(forest))
    others = ["".join(row[:2]).strip(" │") for row in rows(forest) if row.kind == "other"]
    assert others == ["also below elsewhere", "in a loop: below l3"]
