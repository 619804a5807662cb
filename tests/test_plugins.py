# SPDX-License-Identifier: Apache-2.0
"""Entry points of other distributions: found without an import, loaded with errors of one sentence."""

import importlib.metadata
import sys

import pytest

from coframe import CoframeError
from coframe._process.plugins import PluginError, load_plugins, plugins

GROUP = "coframe.commands"


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Write a distribution into a folder of sys.path, as pip does."""
    monkeypatch.syspath_prepend(tmp_path)

    def write(package, entry_points, modules=None, folder=tmp_path):
        metadata = folder / f"{package.replace('-', '_')}-1.0.dist-info"
        metadata.mkdir(parents=True)
        (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n", encoding="utf-8")
        (metadata / "entry_points.txt").write_bytes(
            entry_points if isinstance(entry_points, bytes) else entry_points.encode()
        )
        for name, text in (modules or {}).items():
            (folder / f"{name}.py").write_text(text, encoding="utf-8")

    yield write
    for name in list(sys.modules):
        if name.startswith("plugged_"):
            del sys.modules[name]


def test_a_plugin_is_found_without_its_import_and_loaded(install):
    install(
        "robot-tools", f"[{GROUP}]\nwave = plugged_tools:Arm.wave\n", {"plugged_tools": "class Arm:\n    wave = 7\n"}
    )
    [plugin] = plugins(GROUP)
    assert (plugin.name, plugin.package, plugin.target) == ("wave", "robot-tools", "plugged_tools:Arm.wave")
    assert "plugged_tools" not in sys.modules
    assert plugin.load() == 7


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        ("import plugged_nowhere", "ModuleNotFoundError: No module named 'plugged_nowhere'"),
        ("raise RuntimeError('two\\nlines')", r"RuntimeError: two\nlines"),
        ("import sys; sys.exit(3)", "SystemExit: 3"),
        ("def", "SyntaxError"),
        ("other = 1", "AttributeError: module 'plugged_bad' has no attribute 'hello'"),
    ],
)
def test_a_plugin_that_fails_gives_one_sentence_and_the_others_work(install, source, problem):
    install("bad-tools", f"[{GROUP}]\nhello = plugged_bad:hello\n", {"plugged_bad": source})
    install("good-tools", f"[{GROUP}]\nbye = plugged_good\n", {"plugged_good": ""})
    sentences = []
    assert [plugin.name for plugin, _ in load_plugins(GROUP, sentences.append)] == ["bye"]
    [sentence] = sentences
    assert sentence.startswith("The entry point 'hello' (coframe.commands) of the package bad-tools cannot be loaded: ")
    assert problem in sentence
    assert "\n" not in sentence
    with pytest.raises(PluginError) as error:
        plugins(GROUP)[0].load()
    assert isinstance(error.value, CoframeError)
    assert error.value.hint.endswith("pip uninstall bad-tools")


def test_ctrl_c_during_an_import_is_not_the_failure_of_a_plugin(install):
    install("slow-tools", f"[{GROUP}]\nslow = plugged_slow:slow\n", {"plugged_slow": "raise KeyboardInterrupt"})
    with pytest.raises(KeyboardInterrupt):
        list(load_plugins(GROUP, pytest.fail))


def test_the_first_folder_of_the_path_wins(install, tmp_path, monkeypatch):
    first = tmp_path / "first"
    install("other-tools", f"[{GROUP}]\nhello = plugged_b:hello\n", folder=tmp_path)
    install("robot-tools", f"[{GROUP}]\nhello = plugged_a:new\n", folder=first)
    install("robot-tools", f"[{GROUP}]\nhello = plugged_a:old\nremoved = plugged_a:removed\n", folder=tmp_path)
    monkeypatch.setattr(sys, "path", [str(first), str(tmp_path)])
    assert [(each.name, each.target) for each in plugins(GROUP)] == [("hello", "plugged_a:new")]


def test_a_distribution_that_is_installed_later_is_found(install):
    assert plugins(GROUP) == []
    install("robot-tools", f"[{GROUP}]\nhello = plugged_a:hello\n")
    assert [each.name for each in plugins(GROUP)] == ["hello"]


@pytest.mark.parametrize("content", [b"\xff\xfe", b"no section = x", b"[coframe.commands\nx = y:z", b"x\x00" * 1000])
def test_files_that_are_damaged_are_skipped(install, content):
    install("damaged-tools", content)
    install("robot-tools", f"# comment\r\n[{GROUP}]\r\nx y z\r\n; a = b:c\r\nhello=plugged_a:hello [extra]\r\n")
    assert [(each.name, each.target) for each in plugins(GROUP)] == [("hello", "plugged_a:hello")]


def test_the_current_folder_is_not_searched(install, tmp_path, monkeypatch):
    install("robot-tools", f"[{GROUP}]\nhello = plugged_a:hello\n")
    monkeypatch.setattr(sys, "path", [""])
    monkeypatch.chdir(tmp_path)
    assert plugins(GROUP) == []


@pytest.mark.parametrize("group", ["console_scripts", "pytest11"])
def test_the_same_entry_points_are_found_as_by_importlib(group):
    expected = {(each.name, each.module, each.attr or "") for each in importlib.metadata.entry_points(group=group)}
    assert {(each.name, *each.target.partition(":")[::2]) for each in plugins(group)} == expected
