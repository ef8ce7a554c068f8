"""Numbers of this room: what nobody told is nothing, and a tuned number changes on purpose only.

No other test sees most of them: a buffer twice as large gives the same bytes. Who measured anew and
changes one changes it here, too.
"""

from __future__ import annotations

import importlib
import inspect
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from pkgutil import resolve_name

BAG = Path(__file__).parents[2] / 'agv_motion' / 'bag'

TUNED = {
    'catalog.entry.LOOKED_AT': 64,
    'catalog.find.APART': 10_000_000_000,
    'catalog.index.TOGETHER': 50,
    'catalog.index.VERSION': 2,
    'catalog.index._PATIENCE': 30.0,
    'cdr.idl_text._NESTED': 32,
    'cdr.layout._PADDING': 3,
    'cdr.message_decoder.LONGEST_REASON': 300,
    'cdr.message_type.DEEPEST': 32,
    'cdr.message_type.MOST_FIELDS': 20_000,
    'checks.check._FEWEST': 200,
    'checks.check._PARTS': 10,
    'checks.silences.FEWEST': 10,
    'checks.silences._SHARE': 0.9,
    'checks.silences._SPREAD': 1.5,
    'columns.column_builder._ALIGNED': 64,
    'columns.column_builder._GROWTH': 1.2,
    'columns.condition._MOST_NAMED': 12,
    'columns.fixed_layout._GAPS': (32, 8, 0),
    'columns.message_batches._ALL': 2**64 - 1,
    'columns.message_batches._TOGETHER': 2048,
    'columns.table_files.LONGEST_NAME': 150,
    'columns.table_files.MOST_COLUMNS': 64,
    'columns.table_files._BLOCK': 10_000,
    'columns.topic_decoder.FEW': 4,
    'columns.topic_decoder._MOST_LAYOUTS': 16,
    'completeness._MOST': 10**15,
    'editing.latched.MOST': 100,
    'editing.moments._DAY': 86_400_000_000_000,
    'editing.request.MOST_PARTS': 10_000,
    'editing.request.MOST_TOLD': 5,
    'events.black_box._AGAIN': 500_000_000,
    'events.black_box._LATE': 200_000_000,
    'events.event.MOST_MOMENTS': 100,
    'events.event._LONGEST_NAME': 60,
    'events.event_parameters.LONGEST_BEFORE': 86400.0,
    'events.event_parameters.MOST_TRIGGERS': 100,
    'last_messages.FIRST': 5_000_000_000,
    'mcap.chunk_batches._LATEST': 2**64 - 1,
    'mcap.chunk_content.RATIOS': {'': 1, 'lz4': 256, 'zstd': 65536},
    'mcap.summary._LOOKED_AT': 512,
    'mcap.time_order.LONGEST': 4096,
    'mcap.time_order._LATEST': 2**64 - 1,
    'mcap.together.FEW': 256,
    'memory_limit._SHARE': 4,
    'metadata.ENTRIES': 1_000_000,
    'metadata.SIZE': 67_108_864,
    'metadata.NEVER': 2**63 - 1,
    'notes.LONGEST': 1000,
    'playback.delay_histogram.BINS': 10_000,
    'playback.delay_histogram.RESOLUTION': 1e-5,
    'recording.recording.MOST_LATCHED': 100,
    'recording.recording.PERIOD': 0.02,
    'recording.sequence_gaps.MOST_PUBLISHERS': 64,
    'recording.storage_parameters.MEGABYTE': 1e6,
    'sqlite.file.LATEST': 2**63 - 1,
}

NOT_NOTHING = {
    'bag_files._problem': {'harmless': True},
    'cdr.layout._Numbers': {'count': 1},
    'checks.check.Limits': {'tolerance': 0.1, 'gap': 5.0},
    'columns.fixed_layout.LayoutRows.values': {'count': 1, 'step': 1},
    'mcap.chunked_file.ChunkedFile': {'validate': True},
    'mcap.file.McapFile': {'validate': True},
    'mcap.output.McapOutput.close': {'sync': True},
    'mcap.output.NewChunk': {'fresh': True},
    'mcap.scan._Walk': {'believe': True},
    'mcap.scan.look': {'believe': True},
    'mcap.summary.Summary': {'indexed': True},
    'playback.playback.Playback.play_next': {'count': 1},
    'quality_of_service.OfferedQos': {
        'depth': 10, 'deadline': 2**63 - 1, 'lifespan': 2**63 - 1, 'lease_duration': 2**63 - 1,
    },
    'reader.BagReader': {'validate': True},
    'writer.BagWriter': {'chunk_size': 1 << 20, 'chunk_duration': 1.0},
    'writer.BagWriter.flush': {'sync': True},
}  # fmt: skip
"""Numbers that are taken where nobody tells them, but 0 and no; parameters have their own table"""


def functions():
    """Yield the name of each function and class of the room, and itself."""
    for path in sorted(BAG.rglob('*.py')):
        inside = '.'.join(path.relative_to(BAG).with_suffix('').parts)
        module = importlib.import_module(f'agv_motion.bag.{inside}'.removesuffix('.__init__'))
        for name, one in vars(module).items():
            if getattr(one, '__module__', '') != module.__name__:
                continue
            if inspect.isfunction(one):
                yield f'{inside}.{name}', one
            elif inspect.isclass(one) and not issubclass(one, Enum):
                if not (is_dataclass(one) and name.endswith('Parameters')):
                    yield f'{inside}.{name}', one
                for inner, method in vars(one).items():
                    if inspect.isfunction(method) and inner != '__init__':
                        yield f'{inside}.{name}.{inner}', method


def test_what_nobody_told_is_nothing():
    found = {}
    for name, one in functions():
        told = {
            parameter.name: parameter.default
            for parameter in inspect.signature(one).parameters.values()
            if isinstance(parameter.default, (bool, int, float)) and parameter.default
        }
        if told:
            found[name] = told
    assert found == NOT_NOTHING


def test_tuned_numbers_change_on_purpose_only():
    for name, value in TUNED.items():
        module, _, number = name.rpartition('.')
        assert resolve_name(f'agv_motion.bag.{module}:{number}') == value, name
