# SPDX-License-Identifier: Apache-2.0
"""Files that a page sends: bounded, checked, and never outside of the temporary folder."""

import json
from pathlib import Path

import pytest

import coframe
from coframe.errors import ViewerError
from coframe.viewer import _uploads, start_viewer
from coframe.viewer._uploads import MAX_UPLOAD_BYTES, UploadedFile, Uploads, safe_name

URDF = b'<robot name="cart"><link name="base"/></robot>'


@pytest.fixture
def uploads():
    made = Uploads()
    yield made
    made.close()


@pytest.mark.parametrize(
    "name",
    ["../../etc/passwd.mcap", "/etc/passwd", "..\\..\\x.mcap", "a\0b.mcap", "..", ".lock", "x" * 500, "\u202egpj.mcap"],
)
def test_names_cannot_lead_outside(name):
    cleaned = safe_name(name)
    assert cleaned == Path(cleaned).name
    assert cleaned not in {"", ".", ".."}
    assert cleaned.isascii()
    assert len(cleaned) <= 120


def test_parts_of_several_files_are_stored_in_order_and_removed(uploads):
    upload = uploads.begin([UploadedFile("a.mcap", 3), UploadedFile("empty.mcap", 0), UploadedFile("a.mcap", 4)])
    for part in (b"12", b"3a", b"bcd"):
        upload.write(part)
    upload.close()
    assert [path.read_bytes() for path in upload.paths] == [b"123", b"", b"abcd"]
    assert upload.is_complete
    with pytest.raises(ViewerError, match="more bytes than it announced"):
        upload.write(b"x")
    uploads.close()
    assert not any(path.exists() for path in upload.paths)


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ([], "0 files cannot be opened together"),
        ([UploadedFile("a.mcap", 1)] * 9, "9 files cannot be opened together"),
        ([UploadedFile("a.mcap", MAX_UPLOAD_BYTES + 1)], "the maximum of an upload is"),
        ([UploadedFile("a.urdf.xacro", 1)], "Python expressions"),
        ([UploadedFile("a.so", 1)], "cannot be opened"),
        ([UploadedFile("a.urdf", 1 << 30)], "too large"),
        ([UploadedFile("a.urdf", 1), UploadedFile("a.mcap", 1)], "only recordings can be opened together"),
    ],
)
def test_uploads_that_cannot_be_opened_are_refused_before_their_bytes(uploads, files, reason):
    with pytest.raises(ViewerError, match=reason):
        uploads.begin(files)


def test_a_full_disk_is_refused(uploads, monkeypatch):
    monkeypatch.setattr(_uploads.shutil, "disk_usage", lambda _path: type("Usage", (), {"free": 1 << 30}))
    with pytest.raises(ViewerError, match="too little free space"):
        uploads.begin([UploadedFile("a.mcap", 1)])


def test_a_program_decides_what_its_viewer_shows(view, open_tab):
    tab = open_tab(view(coframe.Buffer()))
    assert not tab.has("hello")["can_open"]
    answer = tab.ask("problem", "open_files", files=[{"name": "a.urdf", "size": len(URDF)}])
    assert "does not open files" in answer["text"]
    tab.socket.send(URDF)
    assert tab.wait("problem")["text"] == "the server accepts only text messages"


def test_a_robot_is_added_and_its_bytes_are_confirmed(open_tab):
    with start_viewer("empty", "buffer", port=0) as viewer:
        tab = open_tab(viewer)
        answer = tab.ask("upload", "open_files", files=[{"name": "../cart.urdf", "size": len(URDF)}])
        assert (answer["state"], answer["received"], answer["total"]) == ("receiving", 0, len(URDF))
        tab.socket.send(URDF[:10])
        assert tab.wait("upload")["received"] == 10
        tab.socket.send(URDF[10:])
        assert tab.wait("upload")["state"] == "done"
        robot = tab.wait("robot")
        assert (robot["name"], robot["source"]) == ("cart", "cart.urdf")
        tab.ask("upload", "open_files", files=[{"name": "x.urdf", "size": 3}])
        tab.socket.send(b"<a>")
        failed = tab.wait("upload")
        assert failed["state"] == "failed"
        assert "x.urdf" in failed["text"]
        assert json.dumps(failed).isascii()
