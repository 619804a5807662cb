# SPDX-License-Identifier: Apache-2.0
"""The committed page equals a build of its source, so that installing coframe does not need Node.js."""

import base64
import hashlib
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from coframe.viewer.replay._template import replay_template

ROOT = Path(__file__).parents[2]
STATIC = Path("src/coframe/viewer/static")


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_a_rebuild_gives_the_committed_bytes(tmp_path):
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("needs npm")
    shutil.copytree(ROOT / "viewer", tmp_path / "viewer", ignore=shutil.ignore_patterns("node_modules"))
    for command in (["ci", "--silent"], ["run", "--silent", "build"]):
        done = subprocess.run([npm, *command], cwd=tmp_path / "viewer", capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
    assert _files(tmp_path / STATIC) == _files(ROOT / STATIC), "run `make page` and commit the result"


def test_the_page_loads_its_own_files_and_nothing_else():
    page = (ROOT / STATIC / "index.html").read_text()
    loaded = re.findall(r'<(?:script|link rel="(?:stylesheet|modulepreload)")[^>]*(?:src|href)="([^"]*)"', page)
    assert loaded == ["./assets/viewer.js", "./assets/viewer.css", "./assets/page.js"]
    assert "<script>" not in page, "the Content-Security-Policy allows no inline script"


def test_the_replay_is_one_file_without_network_access():
    before, after = replay_template(ROOT / STATIC)
    page = before + after
    assert re.findall(r"<(?:script|link)[^>]*(?:src|href)=\"(?!data:)[^\"]*\"", page[: page.index("<body>")]) == []
    assert "default-src 'none'" in page
    assert before.endswith('<script type="application/json" id="replay">')
    script = after.partition('<script type="module">')[2].rpartition("</script>")[0]
    assert script == (ROOT / STATIC / "assets/page.js").read_text()
    assert "</script" not in script, "it would end the element"
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"script-src 'sha256-{digest}'" in before, "browsers would not run the script"


def test_the_lock_file_contains_no_registry():
    assert '"resolved"' not in (ROOT / "viewer/package-lock.json").read_text()


def _files(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
