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


def test_names_of_few_columns_are_found_under_a_longer_line_of_the_station(tmp_path):
    file = tmp_path / 'oak.dat'
    head = '"TOA5","oak","CR1000","1","Std.31","CPU:a.CR1","9","Sap"\n"TIMESTAMP","RECORD","dT"\n'
    rows = ''.join(f'"2013-06-10 00:0{i}:00",{i},0.{4 + i}\n' for i in range(4))
    file.write_text(head + '"TS","RN","mV"\n"","","Avg"\n' + rows)
    seen = inspect(str(file))
    assert seen.time_column == 'TIMESTAMP'
    assert [column.name for column in seen.columns] == ['TIMESTAMP', 'RECORD', 'dT']


def test_decimal_commas_between_commas_are_refused_with_a_remedy(tmp_path):
    file = tmp_path / 'oak.csv'
    file.write_text('time,dT_1,dT_2\n2013-06-10 00:00,0,40,0,50\n2013-06-10 00:30,0,41,-0,51\n')
    with pytest.raises(SourceError, match=r'3 names over rows of 5 cells.*save it with another'):
        inspect(str(file))
