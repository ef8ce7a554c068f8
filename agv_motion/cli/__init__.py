"""The `agv` command."""

import os

# the matrices here are small: threads of BLAS cost more than they bring, the more on a busy machine
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')
