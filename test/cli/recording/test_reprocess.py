"""`agv reprocess`: workers, clusters, signals, and what is told."""

from __future__ import annotations

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


@pytest.fixture(scope='module')
def results(recorded, tmp_path_factory):
    """Return the folder of the whole bags' results, as this process makes them."""
    folder = tmp_path_factory.mktemp('near') / 'out'
    for name in ('a', 'c'):
        reprocess(recorded / name, folder / name, PLAN)
    return folder


def test_the_same_bytes_from_one_process_and_from_two_workers(alone, recorded, results, tmp_path):
    """Workers are of a new interpreter, with another order of what has no order."""
    for name, workers in (('one', 1), ('two', 2)):
        out_folder = tmp_path / name / 'out'
        status, out, errors = alone(
            'reprocess', recorded, out_folder, '-m', 'pose:=fix', '-j', workers
        )
        assert status == 1
        assert f'error: {recorded / "b"}' in errors
        assert str(recorded / 'a') in out
        assert 'Traceback' not in errors
    found = content(tmp_path / 'one')
    assert len(found) == 2
    assert found == content(tmp_path / 'two') == content(results.parent)


CLUSTER = """
import sys, time
from distributed import LocalCluster

with LocalCluster(
    n_workers=1, threads_per_worker=1, processes=False, host='127.0.0.1', protocol='tcp',
    dashboard_address=None,
) as cluster:
    print(cluster.scheduler_address, flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def cluster(tmp_path):
    """Return the address of a real scheduler with a worker, in a process of their own."""
    pytest.importorskip('distributed')
    process = subprocess.Popen(  # noqa: S603 - our own interpreter
        [sys.executable, '-c', CLUSTER], cwd=tmp_path, text=True, stdin=subprocess.PIPE,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        env=os.environ | {'PYTHONPATH': str(Path(__file__).parents[3])},
    )  # fmt: skip
    yield process.stdout.readline().strip()
    process.communicate(timeout=60.0)


def test_a_cluster_gives_the_same_bytes(alone, recorded, results, tmp_path, cluster):
    status, _, errors = alone(
        'reprocess', recorded, tmp_path / 'far' / 'out', '-m', 'pose:=fix', '--scheduler', cluster,
        timeout=120,
    )  # fmt: skip
    assert status == 1
    assert f'error: {recorded / "b"}' in errors
    assert content(tmp_path / 'far') == content(results.parent)


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


def is_deaf_to_ctrl_c(pid):
    """Return whether a process blocks or ignores it."""
    lines = Path(f'/proc/{pid}/status').read_text().splitlines()
    status = dict(line.split(':\t', 1) for line in lines)
    return bool((int(status['SigBlk'], 16) | int(status['SigIgn'], 16)) >> signal.SIGINT - 1 & 1)


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
    command = ('reprocess', sources, out, '-m', 'pose:=fix', '-j')
    process = alone.start(*command, 2, start_new_session=True)
    wait_until(lambda: len(list(out.glob('.*.unfinished-*/*/*.mcap'))) == 2)
    started = descendants(process.pid)
    assert len(started) >= 2
    assert all(map(is_deaf_to_ctrl_c, started)), 'it is for the first process to heed'
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
    status, told, _ = alone(*command, 1)
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


def test_diff_tells_by_its_status(alone, recorded, results):
    status, out, _ = alone('bag', 'diff', recorded / 'a', recorded / 'c', '--common')
    assert status == 1
    assert 'DIFFERENT' in out
    status, out, _ = alone(
        'bag', 'diff', recorded / 'a', results / 'a', '--topics', '/odom', '-t', '1e-9'
    )
    assert status == 0
