# SPDX-License-Identifier: Apache-2.0
"""Run the module in the first argument. This is the script behind `python_command`.

Python puts the folder of this file first on `sys.path`; it contains nothing that a program imports, and is removed.
"""

import sys

if __name__ == "__main__":
    folder = __file__.rpartition("/" if "/" in __file__ else "\\")[0]
    sys.path[:] = [entry for entry in sys.path if entry not in ("", folder)]
    del sys.argv[0]

    import runpy

    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
