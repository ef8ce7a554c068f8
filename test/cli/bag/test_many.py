"""One bag, or all in a folder."""

from __future__ import annotations

import pytest

from agv_motion.cli.bag.many import is_bag, jobs
from agv_motion.errors import ConfigurationError


def test_a_folder_of_bags_gives_a_result_each(tmp_path):
    for name in ('a', 'b', 'none'):
        (tmp_path / name).mkdir()
    (tmp_path / 'a' / 'a_0.mcap').touch()
    (tmp_path / 'b' / 'b_0.db3.zstd').touch()
    (tmp_path / 'none' / 'c.txt').touch()
    assert jobs([tmp_path], tmp_path / 'new') == [
        (tmp_path / 'a', tmp_path / 'new' / 'a'), (tmp_path / 'b', tmp_path / 'new' / 'b'),
    ]  # fmt: skip
    assert jobs([tmp_path / 'a'], tmp_path / 'new') == [(tmp_path / 'a', tmp_path / 'new')]
    assert not is_bag(tmp_path / 'none')
    with pytest.raises(ConfigurationError, match='no bag'):
        jobs([tmp_path / 'none'], tmp_path / 'new')
    (tmp_path / 'none' / 'a.mcap').touch()
    with pytest.raises(ConfigurationError, match='two bags of the same name'):
        jobs([tmp_path / 'a', tmp_path / 'none' / 'a.mcap'], tmp_path / 'new')
