"""`agv reprocess`: workers, clusters, signals, and what is told."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from agv_motion.reprocess import Plan, reprocess

PLAN = Plan(
    'tree.yaml',
    ('granier_probe', 'motion_generator', 'wheel_kinematics'),
    (('/pose', '/fix'),),
    'zstd',
)


def content(folder):
    """Return the bytes of all files of a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob('*.mcap'))}


def test_the_same_bytes_from_two_runs_and_from_two_workers(alone, recorded, tmp_path):
    for name, workers in (('one', 1), ('two', 2)):
        status, out, errors = alone(
            'reprocess',
            recorded,
            tmp_path / name / 'out',
            '-m',
            'pose:=fix',
            '-j',
            workers,
            cold=True,
        )
        assert status == 1
        assert f'error: {recorded / "b"}' in errors
        assert str(recorded / 'a') in out
        assert 'Traceback' not in errors
    found = content(tmp_path / 'one')
    assert len(found) == 2
    assert found == content(tmp_path / 'two')


@pytest.fixture
def cluster(tmp_path, wait_until):
    """Return the address of a real scheduler with a worker process."""
    pytest.importorskip('distributed')
    dask = [sys.executable, '-m', 'distributed.cli.dask_scheduler']
    address_file = tmp_path / 'scheduler.json'
    options = ['--no-dashboard', '--host', '127.0.0.1', '--port', '0']
    quiet = {'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL, 'cwd': tmp_path}
    quiet['env'] = os.environ | {'PYTHONPATH': str(Path(__file__).parents[3])}
    scheduler = subprocess.Popen(  # noqa: S603 - our own interpreter
        [*dask, *options, '--scheduler-file', str(address_file)], **quiet
    )
    worker = subprocess.Popen(  # noqa: S603
        [sys.executable, '-m', 'distributed.cli.dask_worker', '--scheduler-file',
         str(address_file), '--nthreads', '1', '--no-nanny', '--no-dashboard'], **quiet,
    )  # fmt: skip
    try:
        wait_until(lambda: address_file.exists() and address_file.stat().st_size)
        yield json.loads(address_file.read_text())['address']
    finally:
        for process in (worker, scheduler):
            process.terminate()
            process.wait(60)


def test_a_cluster_gives_the_same_bytes(alone, recorded, tmp_path, cluster):
    status, _, errors = alone(
        'reprocess', recorded, tmp_path / 'far' / 'out', '-m', 'pose:=fix', '--scheduler', cluster,
        timeout=120,
    )  # fmt: skip
    assert status == 1
    assert f'error: {recorded / "b"}' in errors
    for name in ('a', 'c'):
        reprocess(recorded / name, tmp_path / 'near' / 'out' / name, PLAN)
    assert content(tmp_path / 'far') == content(tmp_path / 'near')


def finished(folder):
    """Return the whole results below a folder, by name, with their bytes."""
    return {p.name: content(p) for p in sorted(folder.iterdir()) if not p.name.startswith('.')}


def descendants(pid):
    """Return the processes that ``pid`` has started, and those that these have."""
    found = Path(f'/proc/{pid}/task/{pid}/children').read_text()
    return [c for child in map(int, found.split()) for c in (child, *descendants(child))]


def gone(pid):
    """Return whether a process has ended."""
    try:
        return ') Z' in Path(f'/proc/{pid}/stat').read_text()
    except OSError:
        return True


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_a_signal_ends_all_workers_at_once_and_a_rerun_completes(
    alone, recorded, tmp_path, wait_until, number
):
    """Ctrl-C goes to all processes of a terminal; kill to the first one alone."""
    sources = tmp_path / 'in'
    sources.mkdir()
    for name in 'abc':
        shutil.copytree(recorded / 'c', sources / name)
    out = tmp_path / 'out'
    command = ('reprocess', sources, out, '-m', 'pose:=fix', '-j', 2)
    process = alone.start(*command, start_new_session=True)
    wait_until(lambda: len(list(out.glob('.*.unfinished-*/*/*.mcap'))) == 2)
    started = descendants(process.pid)
    assert len(started) >= 2
    (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
    _, errors = process.communicate(timeout=60)
    wait_until(lambda: all(map(gone, started)))
    assert process.returncode == (-9 if number == signal.SIGKILL else 130)
    assert 'Traceback' not in errors
    before = finished(out)
    assert len(before) < 3
    if number != signal.SIGKILL:
        assert not list(out.glob('.*'))
    if number in {signal.SIGTERM, signal.SIGHUP}:
        return  # as SIGINT
    status, told, _ = alone(*command)
    assert status == 0
    assert told.count('there already') == len(before)
    assert finished(out).keys() == set('abc')
    sizes = {sum(map(len, files.values())) for files in finished(out).values()}
    assert len(sizes) == 1
    assert not list(out.glob('.*'))


def test_a_killed_worker_takes_one_bag_with_it_and_no_other(alone, recorded, tmp_path, wait_until):
    sources, out = tmp_path / 'in', tmp_path / 'out'
    sources.mkdir()
    for name in 'abc':
        shutil.copytree(recorded / 'c', sources / name)
    process = alone.start('reprocess', sources, out, '-m', 'pose:=fix', '-j', 2)
    wait_until(lambda: list(out.glob('.a.unfinished-*/a/*.mcap')))
    (lock,) = out.glob('.a.unfinished-*')
    holder = next(
        pid
        for pid in descendants(process.pid)
        if any(os.path.realpath(fd) == str(lock) for fd in Path(f'/proc/{pid}/fd').iterdir())
    )
    os.kill(holder, signal.SIGKILL)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 1
    assert f'{sources / "a"}: its worker ended: exit status -9; run again' in errors
    assert finished(out).keys() == {'b', 'c'}
    assert not list(out.glob('.*'))


def test_a_bag_that_has_lost_something_is_told_each_time_with_status_1(alone, recorded, tmp_path):
    (file,) = (recorded / 'c').glob('*.mcap')
    torn = tmp_path / 'torn.mcap'
    torn.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    for word in (' s ', 'there already'):
        status, out, errors = alone('reprocess', torn, tmp_path / 'out', '-n', 'wheel_kinematics')
        assert status == 1
        assert 'torn.mcap, byte ' in errors
        assert word in out


def test_no_node_is_an_error(alone, recorded, tmp_path):
    status, _, errors = alone('reprocess', recorded / 'c', tmp_path / 'out', '-n', ' ,')
    assert status == 1
    assert 'give at least one node' in errors
    assert not (tmp_path / 'out').exists()


def test_errors_and_warnings_are_told(alone, recorded, tmp_path):
    status, _, errors = alone('reprocess', tmp_path / 'nowhere', tmp_path / 'out')
    assert status == 1
    assert 'nowhere' in errors
    status, out, _ = alone('reprocess', recorded / 'c', tmp_path / 'out')
    assert status == 0
    assert '/pose is not in the bag' in out


def test_diff_tells_by_its_status(alone, recorded, tmp_path):
    reprocess(recorded / 'a', tmp_path / 'out', PLAN)
    status, out, _ = alone('bag', 'diff', recorded / 'a', recorded / 'c', '--common')
    assert status == 1
    assert 'DIFFERENT' in out
    status, out, _ = alone(
        'bag', 'diff', recorded / 'a', tmp_path / 'out', '--topics', '/odom', '-t', '1e-9'
    )
    assert status == 0
