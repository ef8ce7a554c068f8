"""How large a piece of a bag may be: a quarter of the memory that there is."""

from __future__ import annotations

import os

import pytest

from agv_motion.bag import memory_limit

GIB = 1 << 30


@pytest.mark.parametrize(('machine', 'container', 'largest'), [
    (8 * GIB, None, 2 * GIB), (8 * GIB, 'max', 2 * GIB), (8 * GIB, f'{4 * GIB}', GIB),
    (4 * GIB, f'{8 * GIB}', GIB), (64 * GIB, None, 4 * GIB), (GIB // 4, None, GIB // 4),
    (None, None, 4 * GIB), (None, f'{2 * GIB}', GIB // 2),
])  # fmt: skip
def test_a_quarter_of_what_machine_and_container_give(
    tmp_path, monkeypatch, machine, container, largest
):
    file = tmp_path / 'memory.max'
    if container:
        file.write_text(container)
    monkeypatch.setattr(memory_limit, '_CONTAINER', (tmp_path / 'none', file))

    def sysconf(name):
        if machine is None:
            raise ValueError(name)
        return {'SC_PHYS_PAGES': machine // 4096, 'SC_PAGE_SIZE': 4096}[name]

    monkeypatch.setattr(os, 'sysconf', sysconf)
    assert memory_limit.largest() == largest
