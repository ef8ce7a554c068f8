"""What a file of a logger looks like, before anything of it is taken."""

from __future__ import annotations

import pytest

from agv_motion.errors import SourceError
from agv_motion.probe.tables.inspection import inspect


def test_what_is_no_text_is_refused_without_its_bytes_on_the_terminal(tmp_path):
    file = tmp_path / 'bag.csv'
    file.write_bytes(bytes(range(1, 256)) * 12)
    with pytest.raises(SourceError, match='is no table in text: it begins with b') as refused:
        inspect(str(file))
    assert str(refused.value).isprintable()


def test_a_table_with_what_a_power_cut_leaves_is_one(tmp_path):
    file = tmp_path / 'oak.csv'
    rows = [f'2013-06-01T{hour:02}:00:00,0.{500 + hour}\n' for hour in range(24)]
    file.write_text('time,dT\n' + ''.join(rows) + '\0' * 400)
    assert [column.name for column in inspect(str(file)).columns] == ['time', 'dT']
