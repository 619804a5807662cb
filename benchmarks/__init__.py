"""coframe beside its peers: `make bench`."""

import os

# numpy's and scipy's linear algebra would keep threads busy with waiting, on the cores that are measured.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
