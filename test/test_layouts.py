"""Layouts for Foxglove, RViz and PlotJuggler: what they name is in the demos, with that type."""

from __future__ import annotations

import importlib
import json
from itertools import chain
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
import yaml

pytest.importorskip('rclpy')

import layouts
from nav_msgs.msg import Path as PathMessage
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from agv_motion.demo import differential, omni, tree, trees

ROOT = Path(__file__).parents[1]
PAGE = ROOT / 'agv_motion' / 'nodes' / 'README.md'
"""Tells what a node takes: goals and poses that a person clicks are in no bag"""

PANELS = {'3D', 'Plot', 'StateTransitions'}
"""Panels of Foxglove 1 and 2 and of Lichtblick alike"""
RVIZ = {
    'RobotModel': String, 'MarkerArray': MarkerArray, 'Path': PathMessage, 'Grid': None, 'TF': None,
}  # fmt: skip
TOOLS = {'SetInitialPose': 'initialpose', 'SetGoal': 'goal_pose', 'MoveCamera': ''}
ROBOTS = sorted(layouts.LOOKS)


def demo_topics(robot):
    """Return the type of each topic that the demo of a robot records."""
    if robot == 'trees':
        rows = [(f'{name}/{row[0]}', row[1]) for name in trees.NAMES for row in trees.OF_EACH]
    else:
        rows = [
            row[:2]
            for row in {'tree': tree, 'omni': omni, 'differential': differential}[robot].TOPICS
        ]
    return {f'/{name.lstrip("/")}': kind for name, kind in rows}


def field_type(kind, field):
    """Return the type of a field of a message, such as double, by its path."""
    for name in field.split('.'):
        told = kind.get_fields_and_field_types()[name]
        if '/' in told:
            package, short = told.split('/')
            kind = getattr(importlib.import_module(f'{package}.msg'), short)
    return told


def require_path(topics, path, types):
    topic, _, field = path.partition('.')
    assert topic in topics, f'{topic} is in no demo'
    assert field_type(topics[topic], field) in types, path


def test_the_files_are_as_the_table_says():
    stale = [p.name for p, text in layouts.written().items() if p.read_text('utf-8') != text]
    assert stale == [], 'run python launch_scripts/generate/layouts.py'


def test_they_are_installed():
    text = (ROOT / 'setup.py').read_text(encoding='utf-8')
    for folder, suffix in layouts.KINDS:
        assert f"('{folder}', '{suffix}')" in text


@pytest.mark.parametrize('robot', ROBOTS)
def test_foxglove_shows_what_is_there(robot):
    layout = json.loads((ROOT / 'config' / 'foxglove' / f'{robot}.json').read_text('utf-8'))
    panels, topics = layout['configById'], demo_topics(robot)
    assert {key.partition('!')[0] for key in panels} == PANELS
    assert sorted(leaves(layout['layout'])) == sorted(panels)
    room = panels['3D!scene']
    shown = {t: topics[t] for t in room['topics']}
    models = [one for one in room['layers'].values() if one['layerId'] == 'foxglove.Urdf']
    assert all(topics[one['topic']] is String for one in models)
    assert all(one['topic'].startswith(f'/{one["framePrefix"]}') for one in models)
    assert len(models) + ('/robot_description' in shown) == len(layouts.LOOKS[robot].names)
    assert {MarkerArray} <= set(shown.values()) <= {MarkerArray, PathMessage, String}
    publish = room['publish']
    clicked = publish.get('poseTopic') or publish['poseEstimateTopic']
    assert f'`{clicked.rpartition("/")[2]}`' in PAGE.read_text('utf-8')
    for key, panel in panels.items():
        for path in panel.get('paths', ()):
            types = {'string'} if key.startswith('State') else {'double', 'float'}
            require_path(topics, path['value'], types)


def leaves(layout):
    if isinstance(layout, str):
        return [layout]
    assert layout['direction'] in {'row', 'column'}
    assert 0 < layout['splitPercentage'] < 100
    return [*leaves(layout['first']), *leaves(layout['second'])]


@pytest.mark.parametrize('robot', ROBOTS)
def test_rviz_shows_what_is_there(robot):
    whole = yaml.safe_load((ROOT / 'config' / 'rviz' / f'{robot}.rviz').read_text('utf-8'))
    manager, topics = whole['Visualization Manager'], demo_topics(robot)
    seen = set()
    for display in manager['Displays']:
        kind = RVIZ[display['Class'].removeprefix('rviz_default_plugins/')]
        told = display.get('Topic') or display.get('Description Topic')
        if kind is not None:
            assert topics[told['Value']] is kind
            assert told['Durability Policy'] == 'Transient Local'  # all three are latched
            seen.add(told['Value'])
        if 'TF Prefix' in display:  # RViz puts the slash itself
            assert f'/{display["TF Prefix"]}/robot_description'.replace('//', '/') == told['Value']
    assert {t for t in topics if t.endswith('/scene')} >= {t for t in seen if t.endswith('/scene')}
    page = PAGE.read_text('utf-8')
    for tool in manager['Tools']:
        end = TOOLS[tool['Class'].removeprefix('rviz_default_plugins/')]
        assert tool.get('Topic', {'Value': ''})['Value'].endswith(end)
        assert not end or f'`{end}`' in page


@pytest.mark.parametrize('robot', ROBOTS)
def test_plotjuggler_plots_what_is_there(robot):
    root = ET.parse(ROOT / 'config' / 'plotjuggler' / f'{robot}.xml').getroot()  # noqa: S314 - our own
    topics, look = demo_topics(robot), layouts.LOOKS[robot]
    curves = [curve.get('name') for curve in root.iter('curve')]
    assert len(curves) == len(set(curves)) > 3
    splitter = root.find('.//DockSplitter')
    assert len(splitter.get('sizes').split(';')) == int(splitter.get('count')) == len(splitter)
    for curve in curves:
        topic = max((t for t in topics if curve.startswith(f'{t}/')), key=len, default='')
        assert topic, f'{curve} is of no topic'
        rest = curve[len(topic) + 1 :]
        if topic.endswith(look.wheels):
            joint, part = rest.split('/')
            assert joint in joints(robot)
            assert part in {'position', 'velocity'}
        else:
            require_path(topics, f'{topic}.{rest.replace("/", ".")}', {'double', 'float'})


def joints(robot):
    """Return the names of the joints of a robot, as its file of parameters has them."""
    name = 'tree' if robot == 'trees' else robot
    given = yaml.safe_load((ROOT / 'config' / f'{name}.yaml').read_text('utf-8'))['/**']
    told = given['ros__parameters']
    return told.get('joint_names') or list(
        chain(
            *((f'turret_{i}_steering', f'turret_{i}_wheel') for i in range(len(told['turret_x'])))
        )
    )
