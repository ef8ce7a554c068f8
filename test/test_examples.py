"""The examples: each runs, tells what was calculated by hand, and is short enough to be read."""

from __future__ import annotations

import ast
import re
import runpy
import signal
import subprocess
import sys
from functools import partial
from math import asin, atan2, atanh, degrees, hypot, pi, sin, sqrt
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / 'launch_scripts' / 'examples'
EXAMPLES = sorted(FOLDER.glob('*.py'))
MOST_LINES = 40


@pytest.fixture
def told(capsys, tmp_path, monkeypatch):
    """Run the example of a number in an empty folder; return the lines that it prints."""
    monkeypatch.chdir(tmp_path)

    def run(number: int) -> list[str]:
        (path,) = FOLDER.glob(f'{number:02}_*.py')
        runpy.run_path(str(path), run_name='__main__')
        return capsys.readouterr().out.splitlines()

    return run


def numbers(line: str) -> list[float]:
    return [float(number) for number in re.findall(r'-?\d+(?:\.\d+)?', line)]


@pytest.mark.parametrize('path', EXAMPLES, ids=lambda path: path.stem)
def test_an_example_is_short_and_says_what_it_shows(path):
    text = path.read_text(encoding='utf-8')
    assert len(text.splitlines()) <= MOST_LINES
    assert ast.get_docstring(ast.parse(text))


def test_the_examples_are_numbered_without_a_gap_and_each_has_a_test_of_its_numbers():
    given = [int(path.name[:2]) for path in EXAMPLES]
    assert given == list(range(1, len(given) + 1))
    tests = Path(__file__).read_text(encoding='utf-8')
    assert [number for number in given if f'told({number})' not in tests] == []


def test_01_turrets(told):
    lines = told(1)
    assert [numbers(line) for line in lines[1:4]] == [[0.0, 1.0]] * 3
    assert [numbers(line) for line in lines[5:8]] == [[90.0, 1.0]] * 3
    # square to their arms at -45, 45 and 180 degrees
    assert [numbers(line) for line in lines[9:12]] == [[45.0, 1.0], [135.0, 1.0], [-90.0, 1.0]]
    assert lines[12].endswith('scaled by 0.333')  # 2 / 6


def test_02_centre_of_rotation(told):
    lines = told(2)
    assert numbers(lines[0]) == [0.0, 1.0]  # (-vy / wz, vx / wz)
    assert numbers(lines[1]) == [45.0, 30.0, -45.0]
    assert numbers(lines[2]) == [0.01414, 0.0, 0.01414]  # 0.01 sqrt(2), and none at the ICR
    assert numbers(lines[4]) == [0.01, 0.0]
    # About the centroid (0, 1/3) of (1, 0), (0, 1), (-1, 0): sum |d|^2 = 8/3, and the wheels at
    # (0.01, 0.01), (0, 0) and (s, 0), s = 0.01 sqrt(2), have a moment of (0.04 + s) / 3.
    s = 0.01 * sqrt(2.0)
    wz = (0.04 + s) / 8.0
    vx, vy = (0.01 + s) / 3.0 + wz / 3.0, 0.01 / 3.0
    left = [(vx - 0.01, vy + wz - 0.01), (vx - wz, vy), (vx - s, vy - wz)]
    residual = sqrt(sum(x * x + y * y for x, y in left) / 3.0)
    assert numbers(lines[5]) == [round(wz, 4), round(residual, 4)] == [0.0068, 0.0041]


def test_03_steering(told):
    lines = told(3)
    times = [numbers(line)[0] for line in lines[:3]]
    # a quarter turn at 15 deg/s, 0.26 s to get going and to stop at 1 rad/s2; then 1/60 m/s at
    # 0.05 m/s2; each to the step of 0.05 s, one step to set out
    assert times[0] == 0.0
    assert 6.26 <= times[1] <= 6.26 + 0.1
    assert 0.3 <= times[2] - times[1] <= 0.4
    assert [line.split()[2] for line in lines[:3]] == ['AtRest', 'Rolling', 'Rolling']
    assert numbers(lines[3]) == [90.0] * 3
    assert numbers(lines[4]) == [1.0] * 3
    assert lines[5].endswith('left at 1.000 m/min')


def test_04_sap_flow(told):
    lines = told(4)
    assert len(lines) == 9
    # 25 K/mV; K = dT_max / dT - 1, and 118.99e-6 K^1.231
    nine = 0.80 - 0.16 * sin(pi / 4.0)
    flux = [1e6 * 118.99e-6 * (0.80 / mv - 1.0) ** 1.231 for mv in (nine, 0.64)]
    assert all(f'{value:.1f} um/s' in lines[i] for i, value in zip((1, 2), flux, strict=True))
    assert [round(value, 1) for value in flux] == [12.9, 21.6]
    assert 'dT 20.0 K  nan um/s' in lines[0]  # no night has ended
    assert all(line.endswith('sap flow nan') for line in lines[:7])  # nor a day been seen
    assert lines[7].endswith('12.9 um/s  sap flow 0.61')
    assert lines[8].endswith('21.6 um/s  sap flow 1.00')


def test_05_a_tree(told):
    lines = told(5)
    # the tangent from (5, 8) to the circle of margin and rim about the corner (9, 6)
    bearing = degrees(atan2(-2.0, 4.0) - asin(1.68 / hypot(4.0, 2.0)))
    assert numbers(lines[1]) == [round(bearing), 0.8, 0.0]
    assert numbers(lines[4]) == [round(bearing), 0.4, 0.5]
    corners = numbers(lines[2])
    assert corners[:2] == [5.0, 8.0]
    assert corners[-2:] == [15.0, 8.0]
    assert min(corners[1::2]) == 4.32  # 6 - 1.68
    assert lines[6].endswith('resting: the sap stands')
    assert len(lines) == 8


def test_06_omni_odometry(told):
    lines = told(6)
    assert numbers(lines[0]) == [1.0, 1.0, 90.0]  # a quarter of a circle of 1 m
    assert numbers(lines[1]) == [1.0, 1.5, 90.0, 3.0]  # and 5 s of 0.1 m/s
    assert 'at least 3 are needed' in lines[2]


def test_07_fusion(told):
    lines = told(7)
    assert [numbers(line)[1] for line in lines[::2]] == [10.0, 20.0, 30.0, 40.0]  # 2 % of 0.5 m/s
    assert all(abs(numbers(line)[2]) < 10.0 for line in lines[::2])  # better than one fix
    assert ['rejected' in line for line in lines[1::2]] == [False, True, False, False]


def test_08_arc(told):
    lines = told(8)
    outer, inner = 0.9 * pi / 2.0, 0.5 * pi / 2.0
    assert numbers(lines[0]) == [round(outer, 3), round(inner, 3)]
    assert numbers(lines[1])[2:] == [0.7, 0.7, 90.0]  # a circle of 0.5 + 0.4 / 2 m
    duration = outer / 0.3 + 0.3 / 0.3
    assert numbers(lines[2]) == [round(duration, 2)]
    means = 0.3 * 0.05, 0.3 * 0.45, 0.3, 0.3 * (duration - 5.45)  # half way in the cycle
    expected = [[round(0.5 / 0.9 * mean, 3), round(mean, 3)] for mean in means]
    assert [numbers(line)[1:] for line in lines[3:7]] == expected
    assert numbers(lines[7]) == [58.0, round(inner, 3), round(outer, 3)]


def test_09_ghost(told):
    lines = told(9)
    off = [numbers(line)[1] for line in lines[1:5]]
    assert off == sorted(off, reverse=True)
    assert off[-1] < 1.0 < off[0] < 10.0
    error = [numbers(line)[2] for line in lines[1:5]]
    assert error == sorted(error, reverse=True)  # V of a law never grows
    assert numbers(lines[5]) == [2.0, 1.0, 90.0]


def test_10_route(told):
    lines = told(10)
    assert numbers(lines[0]) == [2.0, 7.0]
    # The tractrix of a robot 1 m behind: x from the new line, L artanh(s) - s from the old one,
    # s^2 = 1 - x^2; farthest from both where they are equal.
    x = zero_of(lambda x: atanh(sqrt(1.0 - x * x)) - sqrt(1.0 - x * x) - x)
    for line, distance in zip(lines[1:], (0.25, 0.5, 1.0), strict=True):
        assert numbers(line)[2] == pytest.approx(x * distance, abs=0.003)


def zero_of(function, low=0.1, high=0.9):
    """Return where a falling function is zero, by halving."""
    for _ in range(60):
        middle = (low + high) / 2.0
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return low


def test_11_sequence(told):
    lines = told(11)
    # trapezoids: 2 m / 0.4 + 1 s, 90 / 45 + 0.5 s, and the outer wheel's pi 0.6 m / 0.3 + 1 s
    durations = 6.0, 2.5, 2.0, pi * 0.6 / 0.3 + 1.0
    begins = 0.0, 6.0, 8.5, 10.5
    ends = (2.0, 0.0, 0.0), (2.0, 0.0, 90.0), (2.0, 0.0, 90.0), (1.1, 0.0, -90.0)
    for line, begin, duration, end in zip(lines, begins, durations, ends, strict=False):
        assert numbers(line)[0] == begin
        assert tuple(numbers(line)[-3:]) == end
        assert f': {duration:.2f} s to' in line
    assert lines[4].endswith('takes 7.3 s, but its timeout is 5 s')
    assert len(lines) == 5


def test_12_bag(told):
    lines = told(12)
    assert lines[0].startswith("['metadata.yaml', 'walk_0.mcap']")
    assert numbers(lines[1]) == [10_000.0, 999.9]
    assert lines[1].endswith("['x']")
    assert numbers(lines[2]) == [0.49995, 0.9999, 999.9]


def test_13_reprocess(told):
    pytest.importorskip('rclpy')
    lines = told(13)
    assert [line.partition(': ')[2] for line in lines[:2]] == ['50 messages in; done'] * 2
    assert [numbers(line) for line in lines[3:]] == [
        [i, round(0.2 / 0.05, 3), round(0.2 / 0.0475, 3)] for i in (0, 1)
    ]


def test_14_trees(told):
    lines = told(14)
    for half in (lines[:5], lines[5:]):
        assert sum(numbers(line)[-1] for line in half[1:4]) > 0  # somebody arrived
        assert numbers(half[4])[0] > 0.0


def test_15_motors(graph, tmp_path):
    """They do what they are told, stop when nobody commands, and end with Ctrl-C as a node does."""
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import JointState

    (script,) = FOLDER.glob('15_*.py')
    node, states = graph.add(Node('wheel_kinematics', context=graph.context)), []
    node.create_subscription(JointState, 'turrets/state', states.append, qos_profile_sensor_data)
    commands = node.create_publisher(JointState, 'turrets/command', 1)
    names = [f'turret_{i}_{part}' for part in ('steering', 'wheel') for i in range(3)]
    command = JointState(name=names, position=[1.5, 0.5, -0.5, 0.0, 0.0, 0.0])
    command.velocity = [0.0, 0.0, 0.0, 0.1, 0.2, 0.3]
    motors = subprocess.Popen([sys.executable, str(script)], cwd=tmp_path)  # noqa: S603 - told(15)
    try:
        graph.repeat(
            lambda: commands.publish(command),
            lambda: states and list(states[-1].velocity) == list(command.velocity),
        )
        assert list(states[-1].name) == names
        graph.spin_until(lambda: not any(states[-1].velocity))
        assert list(states[-1].position[:3]) == list(command.position[:3])  # the turrets stay
        slow, middle, fast = states[-1].position[3:]  # and the wheels have rolled
        assert slow > 0.0
        assert (middle, fast) == pytest.approx((2.0 * slow, 3.0 * slow))
    finally:
        motors.send_signal(signal.SIGINT)
        assert motors.wait() == 0


def test_16_a_script_without_a_robot_is_told_so(told, monkeypatch):
    """Beside a robot it is run by test/client/test_robot.py."""
    pytest.importorskip('rclpy')
    from agv_motion import client
    from agv_motion.errors import SourceError

    impatient = partial(client.Robot, patience=0.3)
    monkeypatch.setattr(client, 'Robot', impatient)
    with pytest.raises(SourceError, match='no robot in the namespace'):
        told(16)
