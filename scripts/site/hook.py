# SPDX-License-Identifier: Apache-2.0
"""The hook of MkDocs: adds the pages that are generated from the sources, and adapts links that leave the folder docs.

A link to a file of the repository leads to its page if the site has one (`PAGES_OF_FILES`), else to the repository if
`repo_url` is set, else it becomes plain text: the built site has no dead links.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import commands
import doctor_codes
import examples
import performance
import ros_packages
from mkdocs.structure.files import File

from coframe.course.handbook import write_pages
from coframe.course.translation.catalogue import languages
from coframe.course.translation.language import ENGLISH, Language

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]
# Files of the repository outside docs that are pages of the site.
PAGES_OF_FILES = {
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "CODE_OF_CONDUCT.md": "code-of-conduct.md",
    "benchmarks/README.md": "benchmarks.md",
    "conformance/README.md": "conformance.md",
}
# Files whose contents are on a generated page.
SECTIONS_OF_FILES = {
    "README.md": "index.md",
    "SECURITY.md": "reference/security.md",
    "benchmarks/RESULTS.md": "performance.md",
    "examples/README.md": "examples.md",
    "src/coframe/cli/commands.py": "reference/commands/index.md",
    "src/coframe/doctor/code_pages": doctor_codes.PAGE,
    "src/ros": "reference/ros-packages/index.md",
    **{
        f"src/coframe/doctor/code_pages/{code}.md": f"{doctor_codes.PAGE}#{code.lower()}" for code in doctor_codes.CODES
    },
    **{f"examples/{name}": f"examples.md#{anchor}" for name, anchor in examples.ANCHORS.items()},
}
# Weights of pages in the search, by the start of their paths: answers to questions come before lists of names.
BOOSTS = {
    "quickstart.md": 2.0,
    "how-to/": 2.0,
    "concepts/": 2.0,
    "reference/commands/": 0.7,
    "reference/api/": 0.3,
    "reference/ros-packages/": 0.3,
    "decisions/": 0.3,
    "changelog.md": 0.3,
}
_HANDBOOK = "handbook"
_LANGUAGE_NAMES = {"de": "Handbuch auf Deutsch"}  # in the language itself; else the code
_TRANSLATIONS = {code: _LANGUAGE_NAMES.get(code, code) for code in languages() if code != ENGLISH.code}
_LINK = re.compile(r"(?P<open>!?\[(?P<text>(?:[^\[\]]|\[[^\]]*\])*)\])\((?P<url>[^)\s]+)\)")
_CODE = re.compile(r"^(?P<fence>```+|~~~+).*?^(?P=fence)|`[^`\n]+`", re.MULTILINE | re.DOTALL)


def generated_pages() -> dict[str, str]:
    """Return the pages that are not files below docs: their paths, and their Markdown."""
    included = {
        page: (ROOT / file).read_text("utf-8") for file, page in PAGES_OF_FILES.items() if (ROOT / file).exists()
    }
    return {
        **included,
        **commands.pages(),
        **doctor_codes.pages(),
        **examples.pages(),
        **performance.pages(),
        **ros_packages.pages(),
    }


_GENERATED = generated_pages()


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Replace the folders of the navigation by their pages."""
    paths = [path.relative_to(config.docs_dir).as_posix() for path in Path(config.docs_dir).rglob("*.md")]
    config.nav = _expand(config.nav, sorted({*paths, *_GENERATED}))
    return config


def _expand(entry: Any, paths: list[str]) -> Any:
    """Return a part of the navigation with each `folder/` replaced by its pages, the index first."""
    if isinstance(entry, list):
        return [_expand(each, paths) for each in entry]
    if isinstance(entry, dict):
        return {title: _expand(each, paths) for title, each in entry.items()}
    if not entry.endswith("/"):
        return entry
    pages = [path for path in paths if posixpath.dirname(path) + "/" == entry]
    pages = sorted(pages, key=lambda path: (posixpath.basename(path) not in {"index.md", "README.md"}, path))
    return [{commands.NAMES[path]: path} if path in commands.NAMES else path for path in pages]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages."""
    for path, text in _GENERATED.items():
        files.append(File.generated(config, path, content=text))
    return files


def on_page_markdown(markdown: str, *, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Adapt the links that leave the folder docs, and set the weight of the page in the search."""
    page.meta.setdefault("search", {"boost": _boost(page.file.src_uri)})
    sources = {path: file for file, path in PAGES_OF_FILES.items()}
    source = sources.get(page.file.src_uri, f"docs/{page.file.src_uri}")
    return adapt_links(markdown, source, page.file.src_uri, (config.repo_url or "").rstrip("/"), set(files.src_uris))


def _boost(path: str) -> float:
    """Return the weight of a page in the search."""
    return next((boost for start, boost in BOOSTS.items() if path.startswith(start)), 1.0)


def on_page_content(html: str, *, page: Page, **_: Any) -> str:
    """Link to the translations of the handbook, and list only codes in the table of contents of the page of codes."""
    if page.file.src_uri == f"{_HANDBOOK}/README.md":
        links = (f'<a href="{code}/index.html" hreflang="{code}">{name}</a>' for code, name in _TRANSLATIONS.items())
        return f"<p>{', '.join(links)}</p>{html}"
    if page.file.src_uri == doctor_codes.PAGE:
        for title in page.toc:
            for code in title.children:
                code.children.clear()
    return html


def on_post_build(config: MkDocsConfig) -> None:
    """Write the handbook in the other languages of the course."""
    for code in _TRANSLATIONS:
        write_pages(Path(config.site_dir, _HANDBOOK, code), language=Language(code))


def adapt_links(markdown: str, source: str, page: str, repository: str, pages: set[str]) -> str:
    """Return the text of a page with the links that leave docs adapted.

    Args:
        markdown: The text.
        source: The path of the file in the repository that contains the text.
        page: The path of its page, relative to docs.
        repository: The address of the repository, or "".
        pages: The paths of all pages and images, relative to docs.
    """
    # Code that ends before "]" is the text of a link.
    code = [match.span() for match in _CODE.finditer(markdown) if not markdown.startswith("]", match.end())]

    def adapt(match: re.Match[str]) -> str:
        url = match["url"]
        if re.match(r"[a-z]+:|#", url) or any(start <= match.start() < end for start, end in code):
            return match[0]
        path, _, anchor = url.partition("#")
        file = posixpath.normpath(posixpath.join(posixpath.dirname(source), path))
        target = PAGES_OF_FILES.get(file) or SECTIONS_OF_FILES.get(file)
        if target is None and file.startswith("docs/"):
            inside = file.removeprefix("docs/")
            target = inside if inside in pages else f"{inside}/README.md" if f"{inside}/README.md" in pages else None
            if target is None:
                return match[0]  # MkDocs reports it
        if target is not None:
            relative = posixpath.relpath(target, posixpath.dirname(page) or ".")
            return f"{match['open']}({relative}{'#' + anchor if anchor else ''})"
        if not (ROOT / file).exists():
            return match[0]  # MkDocs reports it
        return f"{match['open']}({repository}/tree/main/{file})" if repository else match["text"]

    return _LINK.sub(adapt, markdown)
