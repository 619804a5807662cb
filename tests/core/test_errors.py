# SPDX-License-Identifier: Apache-2.0
"""Tracebacks show the hint of an exception, in the interpreter and in notebooks, without cost for lookups that fail."""

import copy
import pickle
import subprocess
import sys
import traceback
from types import SimpleNamespace

import pytest

import coframe
from coframe import errors

needs_notes = pytest.mark.skipif(sys.version_info < (3, 11), reason="tracebacks show notes in Python from 3.11 on")


@pytest.fixture
def failed():
    """Return the exception of a lookup that failed in the native core."""
    with pytest.raises(coframe.LookupException) as caught:
        coframe.Buffer().lookup("map", "base_link")
    return caught.value


@needs_notes
@pytest.mark.parametrize(
    "error",
    [
        coframe.RecordingError("cannot be read", hint="Check the path."),
        coframe.TransformException.with_details("cannot be read", hint="Check the path."),
    ],
)
def test_tracebacks_show_the_hint(error):
    assert traceback.format_exception(error)[-1] == "Hint: Check the path.\n"
    assert str(error) == "cannot be read"
    assert error.args == ("cannot be read",)


def test_the_hint_of_a_failed_lookup_is_a_note(failed):
    text = str(failed)
    assert failed.__notes__ == [f"Hint: {failed.hint}"]
    assert "Is a broadcaster running" in failed.hint
    assert str(failed) == text


@needs_notes
def test_the_interpreter_prints_the_hint():
    code = "import coframe; coframe.Buffer().lookup('map', 'base_link')"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert ended.stderr.splitlines()[-1].startswith("Hint: The buffer has not received any transforms.")


def test_an_exception_without_a_hint_has_no_note():
    assert coframe.WireError("text").__notes__ == []
    assert "Hint" not in "".join(coframe.WireError("text")._render_traceback_())


@needs_notes
def test_notes_can_be_added_and_survive_copies(failed):
    failed.add_note("while docking")
    for error in (failed, pickle.loads(pickle.dumps(failed)), copy.copy(failed)):
        assert error.__notes__ == [f"Hint: {failed.hint}", "while docking"]
    recording = coframe.RecordingError("text", hint="Do.")
    recording.add_note("while docking")
    assert pickle.loads(pickle.dumps(recording)).__notes__ == ["Hint: Do.", "while docking"]


def test_a_failed_lookup_does_not_compute_its_hint(monkeypatch):
    computed = []
    original = errors._hint
    monkeypatch.setattr(errors, "_hint", lambda failure: computed.append(failure) or original(failure))
    with pytest.raises(coframe.LookupException) as caught:
        coframe.Buffer().lookup("map", "base_link")
    assert (computed, caught.value.__dict__) == ([], {})
    assert caught.value.hint
    assert len(computed) == 1


@pytest.mark.parametrize("shows_notes", [True, False])
def test_a_notebook_shows_the_hint_once(monkeypatch, failed, shows_notes):
    def structured_traceback(kind, error, _traceback):
        return ["Traceback", f"{kind.__name__}: {error}", *(error.__notes__ if shows_notes else [])]

    shell = SimpleNamespace(InteractiveTB=SimpleNamespace(structured_traceback=structured_traceback))
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    lines = failed._render_traceback_()
    assert lines == ["Traceback", f"LookupException: {failed}", f"Hint: {failed.hint}"]
