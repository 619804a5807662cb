# SPDX-License-Identifier: Apache-2.0
"""Mesh files that are made to block the page or to fill its memory are refused; the page keeps drawing."""

import json
import struct

import pytest

import coframe

MAX_PAUSE = 5000  # ms between two animation frames; the machine may be busy
MAX_HEAP_BYTES = 500 << 20  # bytes
# Measures the longest pause between two frames of the browser.
WATCH = """() => {
    window.longest = 0;
    let before = performance.now();
    const next = () => {
        const now = performance.now();
        window.longest = Math.max(window.longest, now - before);
        before = now;
        requestAnimationFrame(next);
    };
    next();
}"""
COLLADA = """<?xml version="1.0"?>{doctype}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>{texture}<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="{stride}"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist material="m" count="1">{input}<vcount>{vcount}</vcount><p>0 1 2</p></polylist>
</mesh></geometry></library_geometries>
<library_nodes>{nodes}</library_nodes>
<library_visual_scenes><visual_scene id="scene">
<node id="n"><instance_geometry url="#g">{material}</instance_geometry>{instance}</node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""
GOOD = {"doctype": "", "texture": "", "material": "", "stride": 3, "vcount": 3, "nodes": "", "instance": "",
        "input": '<input semantic="VERTEX" source="#v" offset="0"/>'}  # fmt: skip
# A TGA image of 20 000 x 20 000 pixels without data: run-length encoded, 32 bits per pixel.
TGA = struct.pack("<BBB5xHHHHBB", 0, 0, 10, 0, 0, 20_000, 20_000, 32, 0)
TEXTURE = """<library_images><image id="i"><init_from>huge.tga</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="surface"><surface type="2D"><init_from>i</init_from>
</surface></newparam><newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
<technique sid="common"><phong><diffuse><texture texture="sampler" texcoord="UV"/></diffuse></phong></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>"""
MATERIAL = (
    '<bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material>'
)
INSTANCE = '<instance_node url="#d{}"/>'
DOUBLING = "".join(f'<node id="d{i}">{2 * INSTANCE.format(i + 1)}</node>' for i in range(40))
COLLADAS = {
    "good": {},
    "good_but_for_its_texture": {"texture": TEXTURE, "material": MATERIAL},
    "polygon": {"vcount": 1_000_000_000},
    "stride": {"stride": 1_000_000_000},
    "inputs": {"input": ""},
    "offset": {"input": '<input semantic="VERTEX" source="#v" offset="-1"/>'},
    "doubling": {"nodes": DOUBLING, "instance": '<instance_node url="#d0"/>'},
    "itself": {"nodes": '<node id="i"><instance_node url="#i"/></node>', "instance": '<instance_node url="#i"/>'},
    "doctype": {"doctype": '<!DOCTYPE COLLADA [<!ENTITY a "aaaaaaaa">]>'},
}
GLTF = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]}
GLTFS = {
    "accessor": {"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                 "accessors": [{"componentType": 5126, "count": 900_000_000, "type": "VEC3"}]},
    "parents": {"nodes": [{"children": [1]}, {"children": [0]}]},
    "nodes": {"nodes": [{"children": list(range(1, 200_000))}, *[{}] * 200_000]},
}  # fmt: skip
TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"


def files():
    """Return the contents of the files by name; those that begin with "good" can be drawn."""
    yield "good.obj", TRIANGLE + b"f 1 2 3\n"
    yield "good.stl", b"solid x\nfacet normal 0 0 1\nouter loop\n" + b"vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" * 2
    yield "facets.stl", b"solid x\n" + b"facet " * 2_000_000
    yield "count.stl", bytes(80) + struct.pack("<I", 0xFFFFFFFF) + bytes(50)
    yield "corners.obj", TRIANGLE + b"f" + b" 1" * 7_000_000
    yield "groups.obj", TRIANGLE + b"o a\nf 1 2 3\n" * 200_000
    for name, change in COLLADAS.items():
        yield f"{name}.dae", COLLADA.format(**{**GOOD, **change}).encode()
    for name, content in GLTFS.items():
        yield f"{name}.gltf", json.dumps({**GLTF, **content}).encode()


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_hostile_meshes_are_refused_and_the_page_keeps_drawing(tmp_path, view, open_page):
    links, hostile = "", 0
    (tmp_path / "huge.tga").write_bytes(TGA)
    for number, (name, content) in enumerate(files()):
        (tmp_path / name).write_bytes(content)
        hostile += not name.startswith("good")
        visual = f'<visual><geometry><mesh filename="{name}"/></geometry></visual>'
        links += f'<link name="l{number}">{visual}</link>'
        links += f'<joint name="j{number}" type="fixed"><parent link="base"/><child link="l{number}"/></joint>'
    (tmp_path / "robot.urdf").write_text(f'<robot name="evil"><link name="base"/>{links}</robot>')
    buffer = coframe.Buffer()
    buffer.set("map", "base", coframe.Transform(), static=True)
    url = view(buffer, robot=tmp_path / "robot.urdf").url
    page = open_page(url, expected_errors=["a TGA image has 400000000 pixels"]).drawn()
    page.evaluate(WATCH)
    page.tab("displays")
    page.wait(
        lambda: any(f"(and {hostile - 1} more)" in text for text in page.texts("#body-displays .status")),
        f"{hostile} refused meshes, not {page.texts('#body-displays .status')}",
    )
    assert page.evaluate("window.longest") < MAX_PAUSE
    assert page.evaluate("performance.memory?.usedJSHeapSize ?? 0") < MAX_HEAP_BYTES
    page.shows("base")
