"""`agv bag errors` as a person types it, on bags of three topics that tell poses."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore
from typer.testing import CliRunner

from agv_motion.bag.writer import BagWriter
from agv_motion.cli.bag.group import app
from agv_motion.errors import AgvMotionError

STORE = get_typestore(Stores.ROS2_JAZZY)
ODOMETRY, STAMPED = 'nav_msgs/msg/Odometry', 'geometry_msgs/msg/PoseStamped'
SPOILT = 7
"""Message whose x is no number, where one is wanted"""


def message(kind, stamp, place):
    frame, x, y, heading = place
    make = STORE.types
    time = make['builtin_interfaces/msg/Time'](*divmod(stamp, 10**9))
    header = make['std_msgs/msg/Header'](time, frame)
    turn = make['geometry_msgs/msg/Quaternion'](
        0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2)
    )
    pose = make['geometry_msgs/msg/Pose'](make['geometry_msgs/msg/Point'](x, y, 0.0), turn)
    if kind == STAMPED:
        return make[kind](header, pose)
    vector = make['geometry_msgs/msg/Vector3'](0.0, 0.0, 0.0)
    covered = make['geometry_msgs/msg/PoseWithCovariance'](pose, np.zeros(36))
    twist = make['geometry_msgs/msg/TwistWithCovariance'](
        make['geometry_msgs/msg/Twist'](vector, vector), np.zeros(36)
    )
    return make[kind](header, 'base_link', covered, twist)


def written(path, error, *, spoilt=False):
    """Write a drive along an arc; /pose errs to the left, /odom has another origin; 10 Hz."""
    with BagWriter(path) as bag:
        topics = {}
        for i in range(60):
            stamp, angle = (1000 * 10 + i) * 10**8, 0.05 * i
            x, y = 2 * math.sin(angle), 2 - 2 * math.cos(angle)
            here = math.nan if spoilt and i == SPOILT else x
            for name, kind, place in (
                ('/ground_truth', STAMPED, ('map', x, y, angle)),
                ('/pose', ODOMETRY, ('map', here, y + error, angle)),
                ('/odom', ODOMETRY, ('odom', 7 - y, x, angle + math.pi / 2)),
                ('/late', STAMPED, ('map', x, y, angle)),
            ):
                if name not in topics:
                    text = STORE.generate_msgdef(kind, ros_version=2)[0]
                    topics[name] = bag.add_topic(name, kind, text, type_hash='')
                said = message(kind, stamp + 3600 * 10**9 * (name == '/late'), place)
                bag.write(topics[name], stamp, bytes(STORE.serialize_cdr(said, kind)))
    return path


@pytest.fixture(scope='module')
def bags(tmp_path_factory):
    folder = tmp_path_factory.mktemp('errors')
    return [
        written(folder / 'good', 0.02),
        written(folder / 'bad', 0.3),
        written(folder / 'spoilt', 0.02, spoilt=True),
    ]


def run(*arguments):
    words = ['errors', *map(str, arguments)]
    result = CliRunner().invoke(app, words, catch_exceptions=False, env={'COLUMNS': '200'})
    assert result.exit_code == 0, result.output
    return result.output


def told(*arguments):
    return json.loads(run(*arguments, '--json'))


def test_several_runs_in_a_table(bags):
    """/pose is taken by itself: it is in the frame of the reference."""
    rows = run(bags[0], '--run', bags[1], '--reference', 'ground_truth').splitlines()
    assert rows[0].split() == [
        'bag', 'topic', 'error', 'n', 'rmse', 'mean', 'median', 'std', 'min', 'max', 'sse'
    ]  # fmt: skip
    assert len(rows) == 5
    for row, bag, error in zip(rows[1:3], bags, ('0.02', '0.3'), strict=False):
        assert row.split()[:8] == [
            str(bag), '/pose', 'ape', 'translation', '[m]', '60', error, error
        ]  # fmt: skip
    assert rows[3].split()[2:6] == ['ape', 'rotation', '[deg]', '60']


def test_json_tells_all_and_how_it_was_laid_over(bags):
    found = told(bags[0], '--reference', '/ground_truth', '--driven', '/odom', '--align', 'se2')
    assert (found['metric'], found['align'], found['delta']) == ('ape', 'se2', None)
    (one,) = found['runs']
    assert one['alignment']['translation'] == pytest.approx([0.0, 7.0, 0.0])
    assert one['alignment']['rotation'][0] == pytest.approx([0.0, 1.0, 0.0])
    assert one['errors']['translation'] == pytest.approx(
        {'unit': 'm', 'n': 60} | dict.fromkeys(
            ('rmse', 'mean', 'median', 'std', 'min', 'max', 'sse'), 0.0
        ), abs=1e-12,
    )  # fmt: skip


def test_the_relative_error_does_not_ask_for_the_frame(bags):
    """59 steps of a tenth of a second make 11 consecutive ways of half a second."""
    found = told(
        bags[0], '--reference', '/ground_truth', '--driven', '/odom', '--driven', '/pose',
        '--metric', 'rpe', '--delta', '0.5', '--unit', 'seconds', '--relation', 'full',
    )  # fmt: skip
    assert [one['driven'] for one in found['runs']] == ['/odom', '/pose']
    for one in found['runs']:
        assert one['errors']['full']['n'] == 11
        assert one['errors']['full']['max'] == pytest.approx(0.0, abs=1e-12)
    assert found['delta'] == {
        'size': 0.5, 'unit': 'seconds', 'all_pairs': False, 'tolerance': 0.1
    }  # fmt: skip


def test_a_reference_of_another_bag(bags):
    found = told(
        bags[0], '--run', bags[1], '--reference', '/pose', '--reference-bag', bags[1],
        '--driven', '/pose',
    )  # fmt: skip
    means = [one['errors']['translation']['mean'] for one in found['runs']]
    assert means == pytest.approx([0.28, 0.0])


@pytest.mark.parametrize(
    ('words', 'why'),
    [
        (['--driven', '/odom'], "in frame 'map', /odom in 'odom'.*--align"),
        (['--driven', '/late'], r'/late begins 3600\.000 s after /ground_truth.*--offset -3600'),
        (['--driven', '/pase'], "no topic '/pase'; did you mean '/pose'"),
        (['--metric', 'ate'], "--metric 'ate': choose one of ape, rpe"),
        (['--relation', 'x'], "--relation 'x': choose one of translation, rotation, full"),
        (['--align', 'umeyama'], 'choose one of none, origin, se2, se3'),
        (['--unit', 'm'], 'choose one of frames, metres, seconds'),
        (['--metric', 'rpe', '--delta', '60'], 'no poses are 60 frames apart; all cover 59'),
        (['--scale'], '--scale with --align none'),
        (['--within', '-1'], '--within -1'),
    ],
)
def test_what_cannot_be_compared_is_refused_with_the_reason(bags, words, why):
    with pytest.raises(AgvMotionError, match=why):
        run(bags[0], '--reference', '/ground_truth', *words)


def test_no_number_is_made_of_what_is_none(bags):
    with pytest.raises(AgvMotionError, match=r'/pose: 1 of 60 poses .* nan .* at 1000\.7'):
        run(bags[2], '--reference', '/ground_truth')
    shifted = told(
        bags[2], '--reference', '/ground_truth', '--driven', '/late', '--offset', '-3600'
    )
    assert shifted['runs'][0]['errors']['translation']['max'] == 0.0


def test_a_figure(bags, tmp_path, monkeypatch):
    pytest.importorskip('matplotlib')
    monkeypatch.setattr('agv_motion.report.figure.DOTS_PER_INCH', 20)
    out = run(bags[0], '--reference', '/ground_truth', '--plot', tmp_path / 'errors.png')
    assert f'Figure: {tmp_path / "errors.png"}' in ''.join(out.splitlines())
    assert (tmp_path / 'errors.png').stat().st_size > 2000
