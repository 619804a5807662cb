# SPDX-License-Identifier: Apache-2.0
"""The course in German: complete catalogues; reports, stubs and chapters in the chosen language."""

import ast
import re
import runpy
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from coframe.cli.app import app
from coframe.course import class_folder, formats
from coframe.course._sheet import Sheet
from coframe.course.assignment import recorded_language
from coframe.course.faults import FAULTS, named_fault
from coframe.course.feedback import feedback
from coframe.course.folders import create_folder, file_names
from coframe.course.handbook import chapters, write_pages
from coframe.course.rubric import RUBRIC
from coframe.course.translation import catalogue
from coframe.course.translation.catalogue import DOMAINS, Catalogue, languages, messages
from coframe.course.translation.language import ENGLISH, Language, choose_language
from coframe.errors import CourseError

SCRIPT = Path(__file__).parents[2] / "scripts" / "course_messages.py"
GERMAN = Language("de")
PLACEHOLDER = re.compile(r"\{\d*\}|@\w+@")
CODE = re.compile(r"^```.*?^```$|`[^`]+`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)]+)\)")
# Code with words that are translated: an answer, a pattern, and comments.
TRANSLATED_CODE = {"`X -> child`", "`executable = package.module:function`"}


@pytest.fixture(scope="module")
def sources():
    return runpy.run_path(str(SCRIPT))["all_messages"]()


@pytest.mark.parametrize("domain", DOMAINS)
@pytest.mark.parametrize("code", [code for code in languages() if code != "en"])
def test_a_catalogue_has_each_message_of_the_sources_and_no_other(code, domain, sources):
    known = messages(code, domain)
    assert [message for message in sources[domain] if message not in known] == [], "run scripts/course_messages.py"
    assert [message for message in known if message not in sources[domain]] == [], "run scripts/course_messages.py"
    for message, text in known.items():
        assert sorted(PLACEHOLDER.findall(text)) == sorted(PLACEHOLDER.findall(message)), text
        if domain != "grader" and not message.startswith("```"):
            code_spans = set(CODE.findall(message)) - TRANSLATED_CODE
            assert not {span for span in code_spans if span not in text and "--answer" not in span}, text
            assert sorted(LINK.findall(text)) == sorted(LINK.findall(message)), text
            assert text.count("|") == message.count("|") or not message.startswith("|"), text
            assert re.match(r"\s*[-#|\d.]*", text)[0] == re.match(r"\s*[-#|\d.]*", message)[0], text


def report():
    sheet = Sheet.of(RUBRIC["static"])
    sheet.check(
        1,
        "camera_link has the parent end_effector",
        False,
        expected="a transform from end_effector to camera_link",
        observed="no transform to camera_link; received: end_effector -> camera",
        cause="'camera' looks like a misspelling of 'camera_link'",
        read="handbook chapter 3, static and dynamic transforms",
    )
    sheet.check(19, "<b>student</b>", True, expected="", observed="")
    return {"criteria": [sheet.as_dict()], "notices": [], "earned": 19.0, "points": 100, "bonus": 0.0}


def test_a_report_in_german():
    printed = "\n".join(formats.text(report(), GERMAN))
    for line in (
        "Statische Transformationen (static_tf_broadcaster.py): 19 / 20",
        "camera_link hat den Elternframe end_effector",
        "erwartet: eine Transformation von end_effector zu camera_link",
        "beobachtet: keine Transformation zu camera_link; ",
        "wahrscheinliche Ursache: 'camera' sieht wie ein Schreibfehler von 'camera_link' aus",
        "lesen: Handbuch, Kapitel 3, statische und dynamische Transformationen",
        "Punkte in diesem Teil der Prüfung: 19 von 20. Die Note verlangt alle Teile.",
    ):
        assert line in printed, printed
    page = feedback("Jürgen", report(), "html", GERMAN)
    assert '<html lang="de">' in page
    assert "wahrscheinliche Ursache" in page
    assert "dynamisch" in page  # the figure of chapter 3
    assert "<b>student" not in page
    (test, _) = formats.gradescope(report(), GERMAN)["tests"]
    assert test["name"].startswith("Statische Transformationen: camera_link hat")
    assert formats.classroom(report(), GERMAN)["tests"][0]["message"].startswith("erwartet: ")


def test_sentences_keep_their_values_first_letters_and_full_stops():
    assert GERMAN.text("Joint_7 is right") == "Joint_7 ist richtig"
    assert GERMAN.text("There is no folder a. b; c.") == "Es gibt keinen Ordner a. b; c."
    assert GERMAN.text("another motion of joint 1 and joint 2") == "eine andere Bewegung von Gelenk 1 und Gelenk 2"
    assert GERMAN.text("words of a student {0}") == "words of a student {0}"
    crashed = GERMAN.text("The program exited with an error in line 3 of a.py: E: x.")
    assert crashed == "Das Programm ist mit einem Fehler in Zeile 3 von a.py beendet worden: E: x."
    assert ENGLISH.text("the node ended") == "the node ended"
    for sentence in (formats.UNFINISHED_NOTICE, class_folder._LINK.format("bob")):
        assert GERMAN.has(sentence), sentence


@pytest.mark.parametrize("name", [name for name in file_names() if name.endswith(".py")])
def test_a_german_stub_is_the_same_program(name, tmp_path):
    folders = [tmp_path / code for code in languages()]
    programs = []
    for folder in folders:
        create_folder(folder, 7, Language(folder.name))
        tree = ast.parse((folder / name).read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node):
                node.body[0].value.value = ""
        programs.append(ast.dump(tree))
    assert len(set(programs)) == 1
    text = (tmp_path / "de" / name).read_text(encoding="utf-8")
    assert "Ihre Aufgabe" in text
    assert "Your" not in text
    assert max(map(len, text.splitlines())) <= 120


def test_the_commands_of_a_german_folder_are_explained_and_answer_in_german(tmp_path):
    create_folder(tmp_path / "lab", None, GERMAN)
    text = (tmp_path / "lab" / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```console\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert "Ihre Note" in block
    assert " your " not in block
    for line in block.splitlines():
        if re.match("coframe lab (check|break)", line):
            assert "--language de" in line


def test_the_chapters_in_german_have_the_same_code_and_links(tmp_path):
    for chapter in chapters():
        text = chapter.file.read_text(encoding="utf-8")
        german = GERMAN.markdown(text)
        python = re.compile(r"^```(?:python|yaml)\n.*?^```$", re.MULTILINE | re.DOTALL)
        assert python.findall(german) == python.findall(text)
        assert "## Übungen" in german
        prose = re.sub(r'"[^"]*"', "", python.sub("", CODE.sub("", german)))
        assert not re.search(r" (the|and|of) ", prose), chapter.number
    first = write_pages(tmp_path / "pages", slides=True, language=GERMAN)
    page = first.read_text(encoding="utf-8")
    assert '<html lang="de">' in page
    assert ">Inhalt</a>" in page
    assert "Drehungen und Quaternionen</a>" in page
    assert "ein Hindernis" in (first.parent / "01_why_frames.svg").read_text(encoding="utf-8")
    assert ">Übungen<" not in (first.parent / "slides.html").read_text(encoding="utf-8")


def test_answers_in_german_are_understood():
    for fault in FAULTS:
        assert named_fault(GERMAN.text(fault.name), GERMAN) is fault


def test_the_language_is_that_of_the_option_the_variable_or_the_locale(monkeypatch):
    for name in ("COFRAME_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    assert choose_language().code == "en"
    for name, value in (
        ("LANG", "de_AT.UTF-8"),
        ("LC_MESSAGES", "tr_TR"),
        ("LC_ALL", "de"),
        ("COFRAME_LANGUAGE", "en"),
    ):
        monkeypatch.setenv(name, value)
        assert choose_language().code == ("de" if name in {"LANG", "LC_ALL"} else "en")
    assert choose_language("de").code == "de"
    with pytest.raises(CourseError, match="no language 'xx'"):
        choose_language("xx")


def test_the_commands_speak_german(tmp_path, monkeypatch):
    def run(*words):
        return CliRunner().invoke(app, ["lab", *words])

    monkeypatch.setenv("COLUMNS", "100")
    assert "Als Nächstes: lesen Sie" in run("new", str(tmp_path / "lab"), "--language", "de").output
    assert "Drehungen und Quaternionen" in run("handbook", "2", "--language", "de").output
    answered = run("break", "5", "--answer", "zweiter Publisher", "--language", "de").output
    assert answered.startswith("Richtig: Zwei Knoten veröffentlichen den Arm")
    unknown = run("handbook", "--language", "xx")
    assert unknown.exit_code == 1
    assert "Languages: en, de" in unknown.output


def test_errors_are_in_the_language_of_the_command(tmp_path):
    def error_of(*words, code=1):
        result = CliRunner().invoke(app, ["lab", *words])
        assert result.exit_code == code
        assert isinstance(result.exception, SystemExit), "a traceback"
        return result.output

    place = str(tmp_path / "lab")
    assert "Es gibt keinen Ordner" in error_of("check", place, "--language", "de")
    create_folder(tmp_path / "lab", None, GERMAN)
    for name in file_names():
        if name.endswith(".py"):
            (tmp_path / "lab" / name).unlink()
    assert "enthält keine der Dateien" in error_of("run", place, "--no-browser")
    again = error_of("new", place, "--language", "de")
    assert "enthält bereits" in again
    assert "nichts wird überschrieben" in again
    for words, problem, advice in (
        (["check", place, "--moodle", "m.csv"], "nur für eine Klasse", "Ergänzen Sie --all"),
        (["check", place, "--only", "x"], "unbekanntes Kriterium x", "Kriterien: static"),
        (["check", "--all", place, "--canvas", "c.csv"], "brauchen die Teilnehmer", "Ergänzen Sie --roster DATEI."),
        (["new", place, "--zip"], "--zip gilt für eine Klasse", "lassen Sie --zip weg"),
        (["break", "3", "--answer", "x"], "'x' bezeichnet nicht genau einen Fehler", "Fehler: "),
        (["break"], "entweder eine Nummer oder --random SEED", "Nummern: 1 bis "),
        (["handbook", "99"], "Es gibt kein Kapitel 99", "Kapitel: 1 bis "),
    ):
        output = error_of(*words, "--language", "de", code=2)
        assert problem in output
        assert advice in output
    for words in (["break", "3", "--answer", "x"], ["check", place], ["handbook"], ["new", place]):
        assert "no language '../../x'" in error_of(*words, "--language", "../../x")


def test_a_folder_is_graded_in_the_language_in_which_it_was_created(tmp_path, monkeypatch):
    for name in ("COFRAME_LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"):
        monkeypatch.delenv(name, raising=False)
    for student, language in (("ada", GERMAN), ("bob", ENGLISH)):
        create_folder(tmp_path / "class" / student, None, language)
    path = tmp_path / "class" / "ada"
    assert recorded_language(path) == "de"

    def graded(*words):
        return CliRunner().invoke(app, ["lab", "check", *map(str, words), "--only", "urdf"]).output

    assert "Punkte in diesem Teil der Prüfung" in graded(path)
    assert "Points in this part" in graded(path, "--language", "en")
    graded(tmp_path / "class", "--all", "--feedback", tmp_path / "feedback")
    for student, language in (("ada", "de"), ("bob", "en")):
        assert f'<html lang="{language}">' in (tmp_path / "feedback" / f"{student}.html").read_text(encoding="utf-8")
    for text in ('{"language": ["de"]}', '{"language": "../../x"}', "[]", "{", '{"language": "' + "x" * 9999 + '"}'):
        (path / "lab.json").write_text(text)
        assert choose_language(None, recorded_language(path)) is ENGLISH


def test_sentences_of_students_are_translated_in_a_short_time():
    begin = time.process_time()
    parts = ("a: ", "; ", ". ", ", ", " and ", "a and b, c. d; e: f of g ", " and w are sin(", " of ")
    for length in (499, 999, 9_999):
        for part in parts:
            sentence = ("x " + part * length)[:length]
            assert GERMAN.text(sentence)
    assert time.process_time() - begin < 15.0  # 2 s; minutes if all ways to divide a sentence were tried
    assert GERMAN.text("a: " * 300 + "x") == "a: " * 300 + "x"


def test_a_translation_with_other_placeholders_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr(catalogue, "FOLDER", tmp_path)
    (tmp_path / "xx" / "LC_MESSAGES").mkdir(parents=True)
    path = tmp_path / "xx" / "LC_MESSAGES" / "grader.po"
    for text, problem in (
        ('msgid "no {0}"\nmsgstr "ohne {1}"\n', "'ohne {1}' has other placeholders than 'no {0}'"),
        ('msgid "a"\nmsgstr 9**9**9\n', "is damaged"),
        ('msgid "a"\nmsgstr "b\n', "is damaged"),
    ):
        path.write_text(text)
        messages.cache_clear()
        with pytest.raises(CourseError, match=re.escape(problem)):
            messages("xx", "grader")
    messages.cache_clear()
    assert languages() == ["en", "xx"]
    monkeypatch.setattr(catalogue, "FOLDER", tmp_path / "missing")
    assert languages() == ["en"]


def test_fuzzy_and_empty_entries_count_as_missing():
    class File:
        def read(self):
            return 'msgid "a"\nmsgstr "b"\n\n#, fuzzy\nmsgid "c"\nmsgstr "d"\n\nmsgid "e"\nmsgstr ""\n'

    found = Catalogue(File())
    assert found.messages == {"a": "b"}
    assert (found.gettext("a"), found.gettext("c")) == ("b", "c")
