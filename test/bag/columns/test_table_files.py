"""Columns as CSV: a number a cell, short arrays spread over columns, long ones as JSON."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from agv_motion.bag.columns.table_files import LONGEST_NAME, MOST_COLUMNS, file_names, write_csv


def test_each_field_has_its_cells(tmp_path):
    fields = {
        'x': np.array([0.5, -1.0]),
        'pair': np.array([[1, 2], [3, 4]]),
        'few': np.arange(2 * MOST_COLUMNS).reshape(2, -1),
        'many': np.zeros((2, MOST_COLUMNS + 1), int),
    }
    path = tmp_path / 'a.csv'
    write_csv(path, SimpleNamespace(stamps=np.array([10, 20]), fields=fields))
    head, first, second = (line.split(',', 4) for line in path.read_text().splitlines())
    assert head[:4] == ['log_time', 'x', 'pair[0]', 'pair[1]']
    assert head[4].endswith(f'few[{MOST_COLUMNS - 1}],many')
    assert (first[:4], second[:4]) == (['10', '0.5', '1', '2'], ['20', '-1.0', '3', '4'])
    zeros = ', '.join(['0'] * (MOST_COLUMNS + 1))
    assert first[4].endswith(f',{MOST_COLUMNS - 1},"[{zeros}]"')


def test_no_two_topics_share_a_file():
    names = file_names(['/a/b', '/a__b', '/A/B', '/c', '/..', '/' + 'x' * 400])
    assert names['/c'] == 'c'
    assert len({name.lower() for name in names.values()}) == 6
    assert max(map(len, names.values())) <= LONGEST_NAME + 9
    assert names['/..'].startswith('.._')
