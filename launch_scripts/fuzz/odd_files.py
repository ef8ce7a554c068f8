"""Folders, and things that somebody takes for a bag."""

from __future__ import annotations

import gzip
import io
import os
import random
import shutil
import tarfile
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import yaml
import zstandard
from odd_bags import Case, Maker, Sent, by_mcap, by_us, drive, file, small

Change = Callable[[Path], object]
METADATA = 'metadata.yaml'


def folder_case(change: Change, *, valid: bool = False, place: str = '') -> Maker:
    """Return what changes something in a folder of two files."""

    def make(folder: Path, _: random.Random) -> Case:
        bag = by_us(folder / 'bag', small()[:12])
        second = by_us(folder / 'other', small()[12:])
        (second / 'other_0.mcap').rename(bag / 'bag_1.mcap')
        shutil.rmtree(second)
        described = yaml.safe_load((bag / METADATA).read_text())
        within = described['rosbag2_bagfile_information']
        within['relative_file_paths'].append('bag_1.mcap')
        within['message_count'] = 24
        (bag / METADATA).write_text(yaml.safe_dump(described, sort_keys=False))
        change(bag)
        return Case(bag, small(), valid, place)

    return make


def describe(**changes: object) -> Change:
    """Return what changes entries of the metadata; None takes one out."""

    def change(bag: Path) -> None:
        described = yaml.safe_load((bag / METADATA).read_text())
        within = described['rosbag2_bagfile_information']
        for key, value in changes.items():
            within[key] = value
            if value is None:
                del within[key]
        (bag / METADATA).write_text(yaml.safe_dump(described, sort_keys=False))

    return change


def write(name: str, data: bytes) -> Change:
    """Return what puts a file into the folder."""
    return lambda bag: (bag / name).write_bytes(data)


def folders() -> Iterator[tuple[str, Maker]]:
    """Yield folders with metadata that is not quite true, and with other things in them."""
    yield 'two files', folder_case(lambda _: None, valid=True)
    told = r'metadata\.yaml'
    wrong = {
        'absent': lambda bag: (bag / METADATA).unlink(), 'empty': write(METADATA, b''),
        'torn': lambda bag: os.truncate(bag / METADATA, 300), 'zeros': write(METADATA, bytes(4096)),
        'no UTF-8': write(METADATA, b'\xff\xfe\0\0'), 'a list': write(METADATA, b'- 1\n- 2\n'),
        'dangerous': write(METADATA, b'!!python/object/apply:os.system ["true"]\n'),
        'laughing': write(METADATA, b'a: &a [x,x,x,x,x,x,x,x,x]\n' + b''.join(
            b'%c: &%c [%s]\n' % (c, c, b','.join([b'*%c' % (c - 1)] * 9)) for c in range(98, 110))),
    }  # fmt: skip
    for name, change in wrong.items():
        yield f'metadata {name}', folder_case(change, place=told)
    for version in (1, 4, 99, -1, 'x', None):
        yield f'metadata of version {version}', folder_case(describe(version=version), valid=True)
    names = {
        'a file that is not there': (['bag_0.mcap', 'bag_1.mcap', 'bag_2.mcap'], False),
        'one file twice': (['bag_0.mcap', 'bag_0.mcap', 'bag_1.mcap'], False),
        'one file only': (['bag_0.mcap'], False), 'none': ([], False),
        'paths of another machine': (['/home/a/bag_0.mcap', 'b/bag_1.mcap'], True),
        'a file outside': (['../../../etc/passwd', 'bag_0.mcap', 'bag_1.mcap'], False),
        'numbers': ([1, 2], False), 'a word': ('bag_0.mcap', False),
    }  # fmt: skip
    for name, (paths, valid) in names.items():
        change = describe(relative_file_paths=paths)
        yield f'metadata names {name}', folder_case(change, valid=valid)
    for count in (0, 23, 25, 10**30, 'many', None):
        yield f'metadata of {count} messages', folder_case(describe(message_count=count))
    for word in ('FILE', 'file', 'MESSAGE', 'x', 5):
        change = describe(compression_mode=word, compression_format='zstd')
        yield f'metadata: compressed by {word}', folder_case(change)
    yield 'metadata: sqlite3', folder_case(describe(storage_identifier='sqlite3'), valid=True)
    foreign = {
        'notes.txt': b'hello', '.DS_Store': bytes(8), 'bag_0.mcap.part': b'\x89MCAP',
        'a.png': b'\x89PNG',
        'bag.yaml': b'a: 1', 'bag_0.mcap.md5': b'abc', 'Thumbs.db': b'x',
    }  # fmt: skip
    for name, data in foreign.items():
        yield f'beside {name}', folder_case(write(name, data), valid=True)
    for name, data in {'bag_2.mcap': b'', 'z.mcap': b'\x89MCAP0\r\n', 'x.db3': b'nothing'}.items():
        yield f'beside {name}', folder_case(write(name, data))
    yield (
        'beside a copy',
        folder_case(lambda bag: shutil.copy(bag / 'bag_0.mcap', bag / 'copy.mcap')),
    )
    yield 'beside a folder', folder_case(lambda bag: (bag / 'bag_2.mcap').mkdir(), valid=True)
    yield 'beside a broken link', folder_case(lambda bag: (bag / 'bag_2.mcap').symlink_to('gone'))
    yield 'renamed files', folder_case(lambda bag: (bag / 'bag_1.mcap').rename(bag / 'x.mcap'))
    yield 'a file lost', folder_case(lambda bag: (bag / 'bag_1.mcap').unlink(), place='bag_1')
    yield 'a file of zeros', folder_case(write('bag_1.mcap', bytes(5000)), place='bag_1')
    yield 'an empty file', folder_case(write('bag_1.mcap', b''), place='bag_1')
    yield 'links to files', folder_case(_linked, valid=True)
    yield 'metadata alone', folder_case(_emptied)
    for name in (
        'a#b?c',
        'a%20b',
        'a [b]',
        "a'b",
        '-r',
        '~',
        '\udcff\udcfe',
        'ä\u0301',
        'a\tb',
        '$(x)',
    ):
        yield f'folder named {name!r}', folder_case_named(name)


def folder_case_named(name: str) -> Maker:
    """Return what gives the folder, and the file in it, another name."""

    def make(folder: Path, _: random.Random) -> Case:
        bag = by_us(folder / 'bag', small()).rename(folder / name)
        (bag / 'bag_0.mcap').rename(bag / f'{name}.mcap')
        (bag / METADATA).unlink()
        return Case(bag / f'{name}.mcap', small(), valid=True)

    return make


def _linked(bag: Path) -> None:
    (bag / 'bag_0.mcap').rename(bag.parent / 'elsewhere')
    (bag / 'bag_0.mcap').symlink_to('../elsewhere')


def _emptied(bag: Path) -> None:
    for path in bag.glob('*.mcap'):
        path.unlink()


def foreign() -> Iterator[tuple[str, Maker]]:
    """Yield what is no bag, and what is one in a wrapping."""
    plain = by_mcap(small())
    packed = zstandard.compress(plain)
    yield 'zstd', lambda f, _: Case(file(f, packed, 'bag.mcap.zstd'), small(), valid=True)
    yield 'zst', lambda f, _: Case(file(f, packed, 'bag.mcap.zst'), small(), valid=True)
    yield 'zstd torn', lambda f, _: Case(file(f, packed[:-50], 'bag.mcap.zstd'), small())
    yield 'zstd twice', lambda f, _: Case(file(f, zstandard.compress(packed), 'bag.zst'), small())
    yield 'mcap called .db3', lambda f, _: Case(file(f, plain, 'bag.db3'), small(), valid=True)
    yield 'mcap called .bin', lambda f, _: Case(file(f, plain, 'bag.bin'), small(), valid=True)
    archive, tarred = io.BytesIO(), io.BytesIO()
    with zipfile.ZipFile(archive, 'w') as zipped:
        zipped.writestr('bag.mcap', plain)
    with tarfile.open(fileobj=tarred, mode='w') as tar:
        info = tarfile.TarInfo('bag.mcap')
        info.size = len(plain)
        tar.addfile(info, io.BytesIO(plain))
    things = {
        'bag.bag': b'#ROSBAG V2.0\n' + bytes(100), 'bag.mcap.gz': gzip.compress(plain),
        'lfs.mcap': b'version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n',
        'bag.zip': archive.getvalue(), 'bag.tar': tarred.getvalue(), 'empty.mcap': b'',
        'text.mcap': b'hello', 'text.db3': b'hello', 'text.txt': b'hello',
        'zeros.mcap': bytes(9999),
        'html.mcap': b'<!DOCTYPE html><html>404 Not Found</html>', 'one.mcap': b'\x89',
        'random.mcap': random.Random(1).randbytes(5000), 'wide.mcap': 'hello'.encode('utf-16'),  # noqa: S311
        'crlf.mcap': plain.replace(b'\r\n', b'\n'), 'a.csv': b'time,value\n1,2\n',
        'a.pdf': b'%PDF-1.4',
        'db.db3-wal': bytes(100), 'bag.mcap.part': plain[:300],
    }  # fmt: skip
    for name, data in things.items():
        yield f'a file {name}', lambda f, _, n=name, d=data: Case(file(f, d, n))
    yield 'nothing', lambda f, _: Case(f / 'not_there')
    yield 'a folder called .mcap', lambda f, _: Case(_made(f / 'bag.mcap', Path.mkdir))
    yield 'a FIFO', lambda f, _: Case(_made(f / 'bag.mcap', os.mkfifo))
    yield 'a FIFO in a folder', lambda f, _: Case(_made(f / 'x.mcap', os.mkfifo).parent)
    yield 'a link to itself', lambda f, _: Case(_made(f / 'bag.mcap', lambda p: p.symlink_to(p)))
    yield (
        'a link to nothing',
        lambda f, _: Case(_made(f / 'b.mcap', lambda p: p.symlink_to('gone'))),
    )
    yield 'a folder in a circle', lambda f, _: Case(_made(f / 'x', lambda p: p.symlink_to(f)))
    yield 'a device', lambda _f, _: Case(Path('/dev/null'))
    yield 'a device without end', lambda _f, _: Case(Path('/dev/zero'))
    yield 'a name too long', lambda f, _: Case(f / ('x' * 300))
    yield 'an empty folder', lambda f, _: Case(_made(f / 'bag', Path.mkdir))
    yield 'bags in a folder', lambda f, _: Case(by_us(f / 'all' / 'bag', small()).parent)
    yield (
        'a robot of its own',
        lambda f, _: Case(by_us(f / 'bag', _two_robots()), _two_robots(), valid=True),
    )


def _made(path: Path, make: Callable[[Path], object]) -> Path:
    make(path)
    return path


def _two_robots() -> list[Sent]:
    found = [
        one._replace(topic=one.topic._replace(name=f'/{robot}{one.topic.name}'))
        for one in drive()
        for robot in ('oak', 'elm')
    ]
    return sorted(found, key=lambda one: one.stamp)


def cases() -> Iterator[tuple[str, Maker]]:
    """Yield all by name."""
    yield from folders()
    yield from foreign()
