# SPDX-License-Identifier: Apache-2.0
"""Write the chapters of the handbook as notebooks for those who read them in the repository.

`coframe lab handbook -o FOLDER` writes the same notebooks; src/coframe/course/_notebooks.py says what becomes a cell.

Example:
    python scripts/handbook_notebooks.py            write docs/handbook/notebooks/*.ipynb
    python scripts/handbook_notebooks.py --check    only report files that are out of date
"""

from __future__ import annotations

import sys
from pathlib import Path

from coframe.course._notebooks import notebook

HANDBOOK = Path(__file__).resolve().parents[1] / "docs" / "handbook"
FOLDER = HANDBOOK / "notebooks"
CHAPTERS = sorted(HANDBOOK.glob("[0-9]*.md"))


def main() -> int:
    check, outdated = "--check" in sys.argv, []
    FOLDER.mkdir(exist_ok=True)
    for chapter in CHAPTERS:
        path, text = FOLDER / f"{chapter.stem}.ipynb", notebook(chapter)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            outdated.append(path.name)
            if not check:
                path.write_text(text, encoding="utf-8")
    print(f"{'out of date' if check else 'written'}: {', '.join(outdated) or 'none'}")
    return 1 if outdated and check else 0


if __name__ == "__main__":
    sys.exit(main())
