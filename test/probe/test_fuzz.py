"""Lines and tables of loggers at random; launch_scripts/fuzz/fuzz_probes.py is the long form."""

from __future__ import annotations

import fuzz_probes


def test_whatever_a_logger_sends_is_read_or_told(capsys):
    assert fuzz_probes.main(['2000', '7']) == 0, capsys.readouterr().out
