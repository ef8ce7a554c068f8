"""As many threads as processors, but not more than four."""

from __future__ import annotations

import os

from agv_motion.bag.threads import threads


def test_a_thread_for_each_processor_up_to_four(monkeypatch):
    for processors, expected in ((None, 1), (1, 1), (2, 2), (4, 4), (5, 4), (64, 4)):
        monkeypatch.setattr(os, 'cpu_count', lambda found=processors: found)
        assert threads() == expected
