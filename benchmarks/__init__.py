# SPDX-License-Identifier: Apache-2.0
"""Benchmarks of coframe and its peers: `make bench`."""

import os

# Idle threads of NumPy's and SciPy's linear algebra would use the measured cores.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
