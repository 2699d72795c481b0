"""One thread for linear algebra: the tests run side by side, on many small matrices."""

import os

# read when numpy is first imported, which is after this file
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
