"""``python -m coframe.cli``: the console script where it is not on the path."""

from coframe.cli import main

main()
