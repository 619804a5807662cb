# SPDX-License-Identifier: Apache-2.0
"""Run the command line with ``python -m coframe.cli``, where the script ``coframe`` is not on the path."""

from coframe.cli import main

main()
