# SPDX-License-Identifier: Apache-2.0
"""Check the built site without a network: every internal link and anchor exists, and no page loads from another host.

Example:
    python scripts/site/check_links.py build/site
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes whose URL the browser loads by itself; `href` of a link does not load anything.
_LOADED = {("img", "src"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("video", "src"), ("link", "href")}
_NOT_LOADED = {"canonical", "prev", "next", "alternate", "edit"}


class Page(HTMLParser):
    """The anchors of a page, and its URLs with whether the browser loads them."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.anchors: set[str] = {"", "__top"}
        self.urls: list[tuple[str, bool]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Collect the anchors and the URLs of a tag."""
        values = {name: value or "" for name, value in attrs}
        self.anchors |= {values[name] for name in ("id", "name") if name in values}
        for name in ("href", "src"):
            if name in values:
                loaded = (tag, name) in _LOADED and values.get("rel") not in _NOT_LOADED
                self.urls.append((values[name], loaded))


def problems(folder: Path) -> list[str]:
    """Return a sentence for each dead link, each URL without a host, and each file from another host."""
    pages = {path.resolve(): Page(path.read_text("utf-8")) for path in sorted(folder.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(folder.resolve())
        if name.name == "404.html":
            continue  # its links are absolute, as the server shows it at any address
        for url, loaded in page.urls:
            if problem := _problem(path, url, loaded, pages):
                found.append(f"{name}: {url}: {problem}")
    return found


def _problem(path: Path, url: str, loaded: bool, pages: dict[Path, Page]) -> str:
    parts = urlsplit(url)
    if parts.scheme in {"http", "https"} or url.startswith("//"):
        if loaded:
            return "is loaded from another host"
        return "" if parts.hostname and "." in parts.hostname else "has no valid host"
    if parts.scheme:
        return "" if parts.scheme in {"mailto", "javascript", "data"} else f"unknown scheme {parts.scheme}"
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if target.is_dir():
        target /= "index.html"
    if not target.exists():
        return "no such file in the site"
    if target in pages and unquote(parts.fragment) not in pages[target].anchors:
        return f"no anchor #{parts.fragment} in {target.name}"
    return ""


def main() -> int:
    """Print the problems of the site in the folder that is given; return the exit status."""
    if len(sys.argv) != 2 or not Path(sys.argv[1], "index.html").exists():
        print(
            "usage: python scripts/site/check_links.py FOLDER (with index.html; `make docs` builds it)", file=sys.stderr
        )
        return 2
    found = problems(Path(sys.argv[1]))
    for each in found:
        print(each)
    pages = len(list(Path(sys.argv[1]).rglob("*.html")))
    print(f"{pages} pages, {len(found)} broken links")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
