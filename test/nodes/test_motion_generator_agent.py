"""Node `motion_generator` with a zone and a memory: goals, maps, services, restarts, limits."""

from __future__ import annotations

from math import hypot

import pytest

rclpy = pytest.importorskip('rclpy')

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.behavior.memory_file import restore, save
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.qos import LATCHED
from agv_motion.ros.run import StartError

YARD = """
boundary: [[0, 0], [20, 0], [20, 10], [0, 10]]
holes: [[[9, 4], [11, 4], [11, 6], [9, 6]]]
translation_only: [[[16, 0], [20, 0], [20, 10], [16, 10]]]
home: [2, 8]
"""


@pytest.fixture
def zone(tmp_path):
    path = tmp_path / 'zone.yaml'
    path.write_text(YARD)
    return str(path)


@pytest.fixture
def seek(make_senses, zone):
    """Return what makes a tree that seeks, in the yard."""
    return lambda **given: make_senses(zone_file=zone, goals__strategy='memory', **given)


def cells(grid):
    return np.array(grid.data).reshape(grid.info.height, grid.info.width)


class Maps:
    """Both maps of a tree, as they come."""

    def __init__(self, senses):
        self.senses, self.felt = senses, 0.5
        self.flows = senses.tester.listen(OccupancyGrid, 'memory/sap_flow', LATCHED)
        self.visits = senses.tester.listen(OccupancyGrid, 'memory/last_visit', LATCHED)

    def live(self, x, y, flow):
        """Let the tree feel ``flow`` at (x, y), and wait until it remembers both."""
        cell = int(y / 0.25), int(x / 0.25)
        self.senses.stand(x, y, 0.0)
        self.senses.feel(0.9, 0.5, self.felt)  # as before: it may come before the pose does
        self.senses.tester.wait(self.flows, lambda m: cells(m)[cell] >= 0)
        self.felt = flow
        self.senses.feel(0.9, 0.5, flow)
        self.senses.tester.wait(self.flows, lambda m: cells(m)[cell] == round(100.0 * flow))


def ask(senses, service):
    return senses.tester.ask(Trigger, f'motion_generator/{service}', Trigger.Request())


def test_it_chooses_a_goal_and_tells_which_why_and_by_which_way(seek):
    senses = seek()
    goals = senses.tester.listen(PoseStamped, 'goal', LATCHED)
    paths = senses.tester.listen(Path, 'path', LATCHED)
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.9, 0.5, 0.4)
    senses.moves()
    goal = senses.tester.wait(goals).pose.position
    state = senses.tester.wait(senses.states, lambda m: 'walking' in m.data).data
    assert state == f'walking to never visited: ({goal.x:.1f}, {goal.y:.1f})'
    end = senses.tester.wait(paths, lambda m: m.poses).poses[-1].pose.position
    assert (end.x, end.y) == (goal.x, goal.y)


def test_it_goes_back_to_the_sun_and_to_the_shade_it_remembers(seek):
    """From the middle it is sent on until each wish has had its turn."""
    senses = seek(map_period=0.1)
    maps = Maps(senses)
    for x, y, flow in ((8.0, 8.0, 0.5), (2.0, 8.0, 0.83), (8.1, 8.0, 0.5), (14.0, 2.0, 0.1)):
        maps.live(x, y, flow)
    maps.live(8.0, 2.0, 0.5)
    reasons = {ask(senses, 'next_goal').message for _ in range(3)}
    assert 'highest remembered sap flow 0.83 at (2.1, 8.1), felt just now' in reasons
    assert 'lowest remembered sap flow 0.10 at (14.1, 2.1), felt just now' in reasons


def test_the_maps_show_what_it_remembers(seek):
    senses = seek(map_period=0.1)
    maps = Maps(senses)
    empty = senses.tester.wait(maps.flows)
    assert (empty.header.frame_id, empty.info.resolution) == ('map', 0.25)
    assert (empty.info.width, empty.info.height) == (80, 40)
    assert set(empty.data) == {-1}
    maps.live(5.1, 2.1, 0.37)
    flow = cells(maps.flows[-1])
    assert flow[8, 20] == 37
    assert (flow >= 0).sum() == 1
    visit = cells(senses.tester.wait(maps.visits, lambda m: max(m.data) >= 0))
    assert visit[8, 20] == 0
    assert visit[8, 24] == 0  # 1 m away, under the platform
    assert visit[8, 26] == -1


def test_it_goes_home_when_asked_though_little_sap_flows(seek):
    senses = seek()
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.2, 1.0, 0.2)
    senses.moves()
    answer = ask(senses, 'go_home')
    assert answer.success
    assert 'home at (2.0, 8.0), asked to' in answer.message
    senses.commands.clear()
    twist = senses.moves().twist
    assert hypot(twist.linear.x, twist.linear.y) == pytest.approx(0.5 / 60.0)
    assert twist.angular.z == 0.0
    senses.stand(2.1, 8.0, 0.0)
    senses.rests()
    senses.tester.wait(senses.states, lambda m: m.data == 'at home: asked to')


def test_no_home_and_no_other_goal_are_told(make_senses):
    senses = make_senses()
    assert not ask(senses, 'go_home').success
    answer = ask(senses, 'next_goal')
    assert not answer.success
    assert "strategy 'fixed' has one goal" in answer.message


def test_a_service_asked_while_it_is_paused_moves_nothing(seek):
    senses = seek()
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    senses.tester.ask(SetBool, 'motion_generator/pause', SetBool.Request(data=True))
    assert 'chosen later; paused' in ask(senses, 'next_goal').message
    ask(senses, 'go_home')
    senses.rests()
    senses.valid.publish(Bool(data=False))
    assert not senses.moving(senses.rests())


def test_on_delicate_floor_it_does_not_turn_and_says_so(seek):
    senses = seek()
    senses.stand(15.0, 2.0, 0.0)  # the centre is off it, a turret is not
    senses.feel(0.9, 1.0, 0.4)
    assert senses.moves().twist.angular.z == 0.0
    senses.tester.wait(senses.states, lambda m: 'not turning: delicate floor' in m.data)
    senses.stand(14.0, 2.0, 0.0)
    senses.tester.wait(senses.commands, lambda m: m.twist.angular.z > 0.0)


def test_rates_hold_from_command_to_command(seek):
    senses = seek(limits__v_rate=0.5, limits__omega_rate=0.5)
    diagnostics = senses.tester.listen(DiagnosticArray, '/diagnostics')
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(1.0, 1.0, 0.4)
    senses.tester.wait(senses.commands, lambda m: m.twist.linear.x**2 + m.twist.linear.y**2 > 1e-4)
    stamps = [m.header.stamp.sec + 1e-9 * m.header.stamp.nanosec for m in senses.commands]
    speeds = [60.0 * hypot(m.twist.linear.x, m.twist.linear.y) for m in senses.commands]
    steps = zip(stamps, stamps[1:], speeds, speeds[1:], strict=False)
    assert all(w - v <= 0.5 * (b - a) + 1e-3 for a, b, v, w in steps)
    assert len({round(v, 3) for v in speeds}) > 2  # more where no message is lost
    report = senses.tester.wait(diagnostics, lambda m: m.status[0].name == '/motion_generator')
    assert 'limits in force' in {value.key for value in report.status[0].values}


def test_outside_it_returns_slowly_where_that_is_wanted(seek):
    senses = seek(home__outside='return')
    senses.stand(-0.5, 5.0, 0.0)
    senses.feel(1.0, 1.0, 0.4)
    twist = senses.moves().twist
    assert (twist.linear.x, twist.linear.y) == pytest.approx((0.25 / 60.0, 0.0), abs=1e-9)
    assert twist.angular.z == 0.0
    senses.tester.wait(senses.states, lambda m: m.data.startswith('returning slowly'))


def test_the_hours_are_kept(seek):
    """Open for one minute of the week: closed now."""
    senses = seek(
        schedule__enabled=True,
        schedule__days=['sun'],
        schedule__opens='23:58',
        schedule__closes='23:59',
    )
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.tester.wait(senses.states, lambda m: ' until ' in m.data)
    assert not any(senses.moving(command) for command in senses.commands)


# Over a restart


def test_what_it_learnt_is_there_after_a_restart(seek, tmp_path, zone):
    path = tmp_path / 'places.npz'
    senses = seek(memory_file=str(path))
    senses.stand(5.1, 2.1, 0.0)
    senses.feel(0.9, 0.5, 0.75)
    senses.moves()
    senses.node.trigger_shutdown()
    memory = Memory(load_zone(zone))
    assert restore(path, memory) == ''
    assert memory.flow[8, 20] == 0.75
    again = seek(memory_file=str(path))
    flows = again.tester.listen(OccupancyGrid, 'memory/sap_flow', LATCHED)
    assert cells(again.tester.wait(flows))[8, 20] == 75


def test_a_node_stopped_and_started_again_goes_on_and_saves_again(seek, tmp_path, zone):
    path = tmp_path / 'places.npz'
    senses = seek(memory_file=str(path), map_period=0.1)
    maps = Maps(senses)
    for x in (5.1, 7.1):
        maps.live(x, 2.1, 0.75)
        senses.node.trigger_deactivate()
        senses.node.trigger_activate()
    memory = Memory(load_zone(zone))
    restore(path, memory)
    assert memory.flow[8, 20] == memory.flow[8, 28] == 0.75


def test_a_corrupt_memory_is_set_aside_and_the_tree_walks(seek, tmp_path, capfd):
    path = tmp_path / 'places.npz'
    path.write_bytes(b'PK but not for long')
    senses = seek(memory_file=str(path))
    assert 'set aside as places.npz.unusable' in capfd.readouterr().err
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.9, 0.5, 0.4)
    senses.moves()


def test_a_memory_of_another_clock_is_no_obstacle(seek, tmp_path, zone):
    """Kept far in the future, by another clock: the tree goes on remembering."""
    path = tmp_path / 'places.npz'
    memory = Memory(load_zone(zone))
    memory.update(4e9, 14.0, 2.0, 0.9)
    save(path, memory.grid())
    senses = seek(memory_file=str(path), map_period=0.1)
    visits = senses.tester.listen(OccupancyGrid, 'memory/last_visit', LATCHED)
    senses.stand(5.1, 2.1, 0.0)
    senses.feel(0.9, 0.5, 0.4)
    senses.moves()
    both = senses.tester.wait(visits, lambda m: cells(m)[8, 20] == 0)
    assert cells(both)[8, 56] == 0


def test_a_disk_that_does_not_take_it_is_told_and_the_tree_walks(seek, tmp_path):
    file = tmp_path / 'file'
    file.write_text('no folder')
    senses = seek(memory_file=str(file / 'places.npz'))
    senses.tester.graph.spin_until(lambda: 'cannot keep' in senses.node.complaint)
    senses.stand(2.0, 2.0, 0.0)
    senses.feel(0.9, 0.5, 0.4)
    senses.moves()
    senses.node.trigger_deactivate()
    assert 'cannot keep the memory of places' in senses.node.complaint


# What cannot be


def test_a_strategy_that_remembers_needs_a_zone(tester, capfd):
    with pytest.raises(StartError):
        tester.start(MotionGenerator, goals__strategy='memory')
    assert 'give zone_file' in capfd.readouterr().err


@pytest.mark.parametrize(
    ('parameters', 'word'),
    [
        ({'goals__strategy': 'best'}, 'choose one of fixed'),
        ({'schedule__time_zone': 'Paris'}, 'give an IANA name'),
        ({'schedule__opens': 'ten'}, "opens = 'ten'"),
        ({'home__outside': 'swim'}, 'choose one of refuse, return'),
        ({'memory__reach': 0.1}, 'take smaller cells'),
    ],
)
def test_parameters_that_cannot_be_are_refused(tester, parameters, word):
    with pytest.raises(ConfigurationError, match=word):
        tester.start(MotionGenerator, **parameters)
