"""The `agv` command: a program, not a library; `agv --help` and `README.md` are its manual."""

import os
import sys

from agv_motion.ros.stop import end_at_once, is_program

INTERRUPTED = 130
"""Exit status of a command that was to give an answer, and was ended before; as shells have it"""

if is_program('agv'):  # while its imports run; then `main` takes over
    end_at_once(0 if sys.argv[1:2] in (['run'], ['demo']) else INTERRUPTED)

# the matrices here are small: threads of BLAS cost more than they bring, the more on a busy machine
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')
