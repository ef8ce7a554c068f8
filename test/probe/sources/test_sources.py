"""The table of sources: whoever adds one and forgets a step is told which."""

from __future__ import annotations

import ast
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest
import yaml

from agv_motion.parameters import nested
from agv_motion.probe.sources.sources import SOURCES, SourceParameters

ROOT = Path(__file__).parents[3]
OTHERS = {'RecordedSource': 'stands in for a source while its recording is played'}


def classes_of_sources():
    for path in sorted((ROOT / 'agv_motion' / 'probe' / 'sources').glob('*.py')):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef) and node.name.endswith('Source'):
                methods = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
                bases = {base.id for base in node.bases if isinstance(base, ast.Name)}
                if {'history', 'read', 'close'} <= methods and 'Protocol' not in bases:
                    yield node.name


def test_every_source_stands_in_the_table():
    table = (ROOT / 'agv_motion' / 'probe' / 'sources' / 'sources.py').read_text()
    missing = [name for name in classes_of_sources() if name not in table and name not in OTHERS]
    assert not missing, f'add a row to SOURCES in probe/sources/sources.py for {missing}'


@pytest.mark.parametrize('name', SOURCES)
def test_every_source_has_a_group_of_parameters_of_its_name(name):
    groups = dict(nested(SourceParameters))
    assert name in groups, f'add a field {name} to SourceParameters in probe/sources/sources.py'
    assert is_dataclass(groups[name])
    assert len(fields(groups[name])) > 0


@pytest.mark.parametrize('name', SOURCES)
def test_every_source_is_told_to_users(name):
    page = (ROOT / 'agv_motion' / 'nodes' / 'README.md').read_text()
    assert f'| `{name}.' in page, (
        f'run launch_scripts/generate/node_tables.py: {name} is not in its tables'
    )
    words = (ROOT / 'config' / 'tree.yaml').read_text()
    line = next(line for line in words.splitlines() if 'readings come from' in line)
    assert name in line, f'name {name} beside `source` in config/tree.yaml'
    assert yaml.safe_load(words)


def test_the_chosen_source_is_opened_and_counted():
    given = SourceParameters()
    source = given.open_source()
    assert type(source).__name__ == 'SimulatedSource'
    assert len(source.read(1e9)[0].values) == given.probes() == 3
