"""Write the layouts of config/ for Foxglove, Lichtblick, RViz and PlotJuggler from one table."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import yaml

FOLDER = Path(__file__).parents[2] / 'config'


class Look(NamedTuple):
    """What is shown of a robot."""

    names: tuple[str, ...]
    """namespaces; '' for none"""
    plots: dict[str, tuple[str, ...]]
    """title, and paths of numbers relative to the namespace"""
    words: tuple[str, ...]
    """paths of texts: what it does, who drives"""
    ways: tuple[str, ...]
    """topics of nav_msgs/Path"""
    clicked: str
    """topic of the pose that a person clicks: a goal, or where it is"""
    wheels: str
    """topic of the joints that are plotted in PlotJuggler"""
    joints: tuple[str, ...]


SPEEDS = ('cmd_vel.twist.linear.x', 'cmd_vel.twist.linear.y', 'cmd_vel.twist.angular.z')
PLACE = ('ground_truth.pose.pose.position.x', 'ground_truth.pose.pose.position.y')
MEASURED = ('pose.pose.pose.position.x', 'pose.pose.pose.position.y')
SAP = tuple(f'granier/sap_flow.vector.{axis}' for axis in 'xyz')
TURRETS = tuple(f'turret_{i}_steering' for i in range(3))

LOOKS = {
    'tree': Look(
        ('',), {'sap flow': SAP, 'twist [m/s, rad/s]': SPEEDS, 'place [m]': MEASURED + PLACE},
        ('state.data', 'driver.message'), ('path',), 'goal_pose', 'turrets/state', TURRETS,
    ),
    'trees': Look(
        ('oak', 'ash', 'elm'), {'sap flow': SAP[:1], 'place [m]': MEASURED},
        ('state.data',), ('path',), 'goal_pose', 'turrets/state', TURRETS[:1],
    ),
    'omni': Look(
        ('',), {'twist [m/s, rad/s]': SPEEDS, 'place [m]': MEASURED + PLACE,
                'slip [m/s]': ('wheels/residual.data',)},
        ('driver.message',), (), 'initialpose', 'wheels/state', ('wheel_0', 'wheel_1', 'wheel_2'),
    ),
    'differential': Look(
        ('',), {'twist [m/s, rad/s]': SPEEDS, 'done': ('sequence/progress.data',),
                'place [m]': PLACE},
        ('sequence/state.data', 'driver.message'), ('sequence/path',), 'goal_pose', 'wheels/state',
        ('left_wheel', 'right_wheel'),
    ),
}  # fmt: skip


def full(name: str, path: str) -> str:
    """Return a path with the namespace before it."""
    return f'/{name}/{path}' if name else f'/{path}'


def foxglove(look: Look) -> str:
    """Return the layout for Foxglove and Lichtblick."""
    panels: dict[str, Any] = {'3D!scene': scene(look)}
    for number, (title, paths) in enumerate(look.plots.items()):
        panels[f'Plot!{number}'] = {
            'title': title,
            'paths': [
                {'value': full(name, path), 'timestampMethod': 'receiveTime', 'enabled': True}
                for name in look.names for path in paths
            ],
            'showLegend': True, 'showXAxisLabels': True, 'showYAxisLabels': True,
            'legendDisplay': 'floating', 'isSynced': True, 'xAxisVal': 'timestamp',
        }  # fmt: skip
    panels['StateTransitions!words'] = {
        'isSynced': True,
        'paths': [{'value': full(name, path), 'timestampMethod': 'receiveTime'}
                  for name in look.names for path in look.words],
    }  # fmt: skip
    side = [key for key in panels if key != '3D!scene']
    layout: Any = side[-1]
    for count, key in enumerate(reversed(side[:-1]), 2):
        layout = {'first': key, 'second': layout, 'direction': 'column',
                  'splitPercentage': round(100.0 / count, 1)}  # fmt: skip
    whole = {
        'configById': panels, 'globalVariables': {}, 'userNodes': {},
        'playbackConfig': {'speed': 1},
        'layout': {'first': '3D!scene', 'second': layout, 'direction': 'row',
                   'splitPercentage': 60},
    }  # fmt: skip
    return json.dumps(whole, indent=2) + '\n'


def scene(look: Look) -> dict[str, Any]:
    """Return the configuration of the 3D panel: the map, seen from above."""
    topics = {full(name, topic): {'visible': True}
              for name in look.names for topic in ('scene', *look.ways)}  # fmt: skip
    layers: dict[str, Any] = {
        'grid': {'layerId': 'foxglove.Grid', 'instanceId': 'grid', 'label': 'Grid', 'visible': True,
                 'size': 40, 'divisions': 40, 'frameId': 'map', 'order': 1},
    }  # fmt: skip
    for order, name in enumerate(look.names, 2):
        if name:
            layers[name] = {
                'layerId': 'foxglove.Urdf', 'instanceId': name, 'label': name, 'visible': True,
                'sourceType': 'topic', 'topic': full(name, 'robot_description'),
                'framePrefix': f'{name}/', 'order': order,
            }  # fmt: skip
        else:
            topics['/robot_description'] = {'visible': True}
    clicked = full(look.names[0], look.clicked)
    return {
        'followTf': 'map', 'followMode': 'follow-none',
        'cameraState': {'perspective': False, 'distance': 25, 'phi': 0, 'thetaOffset': 0,
                        'target': [0, 0, 0], 'targetOffset': [10, 7.5, 0],
                        'targetOrientation': [0, 0, 0, 1], 'fovy': 45, 'near': 0.5, 'far': 5000},
        'scene': {'transforms': {'editable': False}}, 'transforms': {},
        'topics': topics, 'layers': layers,
        'publish': {'type': 'pose', 'poseTopic': clicked} if look.clicked == 'goal_pose'
                   else {'type': 'pose_estimate', 'poseEstimateTopic': clicked},
    }  # fmt: skip


def topic(name: str, *, latched: bool = False) -> dict[str, Any]:
    """Return a topic as RViz writes it."""
    durability = 'Transient Local' if latched else 'Volatile'
    return {'Value': name, 'Depth': 5, 'History Policy': 'Keep Last',
            'Reliability Policy': 'Reliable' if latched else 'Best Effort',
            'Durability Policy': durability}  # fmt: skip


def rviz(look: Look) -> str:
    """Return the configuration for RViz."""
    kind = 'rviz_default_plugins'
    shown: list[dict[str, Any]] = [
        {'Class': f'{kind}/Grid', 'Name': 'Grid', 'Enabled': True, 'Plane Cell Count': 40},
        {'Class': f'{kind}/TF', 'Name': 'TF', 'Enabled': False, 'Show Names': True},
    ]
    for name in look.names:
        label = f' of {name}' if name else ''
        shown.append({
            'Class': f'{kind}/RobotModel', 'Name': f'Robot{label}', 'Enabled': True,
            'Description Source': 'Topic', 'TF Prefix': name,
            'Description Topic': topic(full(name, 'robot_description'), latched=True),
        })  # fmt: skip
        shown.append({'Class': f'{kind}/MarkerArray', 'Name': f'Scene{label}', 'Enabled': True,
                      'Topic': topic(full(name, 'scene'), latched=True)})  # fmt: skip
        shown += [
            {'Class': f'{kind}/Path', 'Name': f'Path{label}', 'Enabled': True,
             'Topic': topic(full(name, way), latched=True)} for way in look.ways
        ]  # fmt: skip
    tools: list[dict[str, Any]] = [
        {'Class': f'{kind}/MoveCamera'},
        {'Class': f'{kind}/SetInitialPose', 'Topic': {'Value': full(look.names[0], 'initialpose')}},
    ]
    if look.clicked == 'goal_pose':
        goal = {'Value': full(look.names[0], 'goal_pose')}
        tools.append({'Class': f'{kind}/SetGoal', 'Topic': goal})
    whole = {
        'Panels': [{'Class': 'rviz_common/Displays', 'Name': 'Displays'},
                   {'Class': 'rviz_common/Views', 'Name': 'Views'}],
        'Visualization Manager': {
            'Class': '', 'Displays': shown, 'Enabled': True,
            'Global Options': {'Fixed Frame': 'map', 'Frame Rate': 30},
            'Name': 'root', 'Tools': tools, 'Value': True,
            'Views': {'Current': {'Class': f'{kind}/TopDownOrtho', 'Name': 'Current View',
                                  'Scale': 40, 'X': 10.0, 'Y': 7.5}},
        },
    }  # fmt: skip
    return yaml.safe_dump(whole, sort_keys=False)


def plotjuggler(look: Look) -> str:
    """Return the layout for PlotJuggler: a plot under the other, all on one time."""
    root = ET.Element('root')
    tabs = ET.SubElement(root, 'tabbed_widget', parent='main_window', name='Main Window')
    tab = ET.SubElement(tabs, 'Tab', tab_name='robot', containers='1')
    container = ET.SubElement(tab, 'Container')
    plots = {title: [full(name, path).replace('.', '/') for name in look.names for path in paths]
             for title, paths in look.plots.items()}  # fmt: skip
    plots['wheels'] = [
        f'{full(name, look.wheels)}/{joint}/{"position" if "steering" in joint else "velocity"}'
        for name in look.names for joint in look.joints
    ]  # fmt: skip
    sizes = ';'.join([f'{1.0 / len(plots):.6f}'] * len(plots))
    splitter = ET.SubElement(
        container, 'DockSplitter', orientation='-', count=str(len(plots)), sizes=sizes
    )
    for title, curves in plots.items():
        area = ET.SubElement(splitter, 'DockArea', name=title)
        plot = ET.SubElement(area, 'plot', mode='TimeSeries', style='Lines')
        for curve in curves:
            ET.SubElement(plot, 'curve', name=curve)
    ET.SubElement(tabs, 'currentTabIndex', index='0')
    ET.SubElement(root, 'use_relative_time_offset', enabled='1')
    ET.indent(root)
    return ET.tostring(root, encoding='unicode', xml_declaration=True) + '\n'


KINDS = {
    ('foxglove', 'json'): foxglove, ('rviz', 'rviz'): rviz, ('plotjuggler', 'xml'): plotjuggler,
}  # fmt: skip


def written() -> dict[Path, str]:
    """Return all files and what stands in them."""
    return {
        FOLDER / folder / f'{robot}.{suffix}': write(look)
        for (folder, suffix), write in KINDS.items()
        for robot, look in LOOKS.items()
    }


def main() -> None:
    """Write them."""
    for path, text in written().items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding='utf-8')


if __name__ == '__main__':
    main()
