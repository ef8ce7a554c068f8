"""The numbers of a table."""

from __future__ import annotations

from math import isnan

import pytest

from agv_motion.errors import SourceError
from agv_motion.probe.tables.cell_numbers import CellNumbers
from agv_motion.probe.tables.table_parameters import TableParameters

GIVEN = TableParameters()


@pytest.mark.parametrize(
    ('cells', 'numbers'),
    [
        (['0.4', '5', '-1.5e-3', '.5'], [0.4, 5.0, -1.5e-3, 0.5]),
        (['0,400', '5', '-1,5e-3'], [0.4, 5.0, -1.5e-3]),
        (['0.4', '1,5', '0.5'], [0.4, None, 0.5]),
        (['0,4', '1.5', '0,5'], [0.4, None, 0.5]),
        (['no.', '5', '0,4'], [None, 5.0, 0.4]),  # neither a word nor a whole number tells a sign
        (['x', '1_0', 'inf', '0x1', '1e999', '\uff11'], [None] * 6),
    ],
)
def test_one_decimal_sign_a_file(cells, numbers):
    read = CellNumbers.of(cells, GIVEN)
    assert [read.number(cell) for cell in cells] == numbers


@pytest.mark.parametrize(
    'cell', ['', 'NAN', 'NA', 'N/A', '#N/A', '-9999', '-9999.00', '-7999', '---']
)
def test_what_stands_for_none(cell):
    assert isnan(CellNumbers.of(['0.5'], GIVEN).number(cell))


def test_other_words_for_none():
    read = CellNumbers.of(['0.5'], TableParameters(missing=('-1', 'gone')))
    assert isnan(read.number('-1.0'))
    assert isnan(read.number('GONE'))
    assert read.number('-9999') == -9999.0


def test_commas_that_may_be_thousands_are_refused_until_it_is_said():
    with pytest.raises(SourceError, match=r"'2,345' may be .*csv\.decimal"):
        CellNumbers.of(['1,234', '2,345'], GIVEN)
    comma = TableParameters(decimal='comma')
    assert CellNumbers.of(['1,234'], comma).number('1,234') == 1.234
    assert CellNumbers.of(['1,234', '0,5'], GIVEN).number('1,234') == 1.234
