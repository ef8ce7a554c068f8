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

from agv_motion.bag.reader import BagReader
from agv_motion.reprocess import Plan, reprocess

BESIDES = 2
"""processes beside the workers: what they are forked from, and what follows their resources"""
PLAN = Plan(
    'tree.yaml',
    ('granier_probe', 'motion_generator', 'wheel_kinematics'),
    (('/pose', '/fix'),),
    'zstd',
)


def content(folder):
    """Return the bytes of all files of a folder."""
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob('*.mcap'))}


def made_by(agv, recorded, folder, *words):
    """Return the folder of the whole bags' results as a command makes them; one bag is none."""
    status, out, errors = agv('reprocess', recorded, folder / 'out', '-m', 'pose:=fix', *words)
    assert status == 1
    assert f'error: {recorded / "b"}' in errors
    assert str(recorded / 'a') in out
    assert 'Traceback' not in errors
    return folder / 'out'


@pytest.fixture(scope='module')
def results(alone, recorded, tmp_path_factory):
    """Return the folder of the whole bags' results, as one process makes them."""
    return made_by(alone, recorded, tmp_path_factory.mktemp('near'), '-j', 1)


@pytest.fixture
def three(recorded, tmp_path):
    """Return a folder of three recordings of one length."""
    for name in 'abc':
        shutil.copytree(recorded / 'c', tmp_path / 'in' / name)
    return tmp_path / 'in'


def test_the_same_bytes_from_one_process_and_from_two_workers(alone, recorded, results, tmp_path):
    """Workers are of a new interpreter, with another order of what has no order."""
    found = content(results)
    assert len(found) == 2
    assert found == content(made_by(alone, recorded, tmp_path, '-j', 2))
    reprocess(recorded / 'a', tmp_path / 'here' / 'a', PLAN)
    assert content(tmp_path / 'here' / 'a') == content(results / 'a')


CLUSTER = """
import sys
from distributed import LocalCluster
from agv_motion.cli.main import main

with LocalCluster(
    n_workers=1, threads_per_worker=1, processes=False, host='127.0.0.1', protocol='tcp',
    dashboard_address=None,
) as cluster:
    sys.argv += ['--scheduler', cluster.scheduler_address]
    main()
"""
"""A command beside a real scheduler and a worker, with which it speaks by TCP"""


def test_a_cluster_gives_the_same_bytes(recorded, results, tmp_path):
    pytest.importorskip('distributed')

    def beside_a_cluster(*words):
        done = subprocess.run(  # noqa: S603 - our own interpreter
            [sys.executable, '-c', CLUSTER, *words], cwd=tmp_path, text=True, capture_output=True,
            env=os.environ | {'PYTHONPATH': str(Path(__file__).parents[3])}, check=False,
        )  # fmt: skip
        return done.returncode, done.stdout, done.stderr

    assert content(made_by(beside_a_cluster, recorded, tmp_path)) == content(results)


def finished(folder):
    """Return the whole results below a folder, by name, with their bytes."""
    return {p.name: content(p) for p in sorted(folder.iterdir()) if not p.name.startswith('.')}


def messages_in(folder):
    """Return how many messages a bag has."""
    with BagReader(folder) as bag:
        return bag.message_count


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
    alone, three, results, wait_until, number
):
    """Ctrl-C goes to all processes of a terminal; kill to the first one alone."""
    out = three.with_name('out')
    command = ('reprocess', three, out, '-m', 'pose:=fix', '-j')
    process = alone.start(*command, 2, start_new_session=True)
    wait_until(lambda: any(out.glob('.*.unfinished-*/*/*.mcap')))
    # both workers are asked for together, however late the second is with its bag
    wait_until(lambda: len(descendants(process.pid)) >= BESIDES + 2)
    started = descendants(process.pid)
    assert all(map(is_deaf_to_ctrl_c, started)), 'it is for the first process to heed'
    (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
    _, errors = process.communicate(timeout=60)
    wait_until(lambda: all(map(gone, started)))
    assert process.returncode == (-9 if number == signal.SIGKILL else 130)
    assert 'Traceback' not in errors
    before = finished(out)
    assert len(before) < 3
    assert {messages_in(out / name) for name in before} <= {messages_in(results / 'c')}
    if number != signal.SIGKILL:
        assert not list(out.glob('.*'))
        return  # what is left are whole results, as after the kill
    status, told, _ = alone(*command, 1)
    assert status == 0
    assert told.count('there already') == len(before)
    assert finished(out).keys() == set('abc')
    sizes = {sum(map(len, files.values())) for files in finished(out).values()}
    assert len(sizes) == 1
    assert not list(out.glob('.*'))


def test_a_killed_worker_takes_one_bag_with_it_and_no_other(alone, three, wait_until):
    out = three.with_name('out')
    process = alone.start('reprocess', three, out, '-m', 'pose:=fix', '-j', 2)
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
    assert f'{three / "a"}: its worker ended: exit status -9; run again' in errors
    assert finished(out).keys() == {'b', 'c'}
    assert not list(out.glob('.*'))


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
