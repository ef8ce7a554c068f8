"""Build of the ament_python package `agv_motion`, by pip and by colcon alike."""

from pathlib import Path

from setuptools import find_packages, setup

NAME = 'agv_motion'
SHARE = f'share/{NAME}'
HERE = Path(__file__).parent
NODES = sorted(
    path.stem
    for path in (HERE / NAME / 'nodes').glob('*.py')
    if '\ndef main()' in path.read_text(encoding='utf-8')
)

ROS = ['ros-jazzy-common-interfaces', 'ros-jazzy-rclpy', 'ros-jazzy-rmw-fastrtps-cpp']
DASHBOARD = ['argon2-cffi>=23', 'starlette>=0.40', 'uvicorn>=0.35', 'websockets>=13']
PLOT = ['matplotlib>=3.8']
MQTT = ['paho-mqtt>=2.1']


def files(folder: str, pattern: str) -> list[str]:
    """Return the files of a folder as data_files wants them: relative to this one."""
    return sorted(str(path.relative_to(HERE)) for path in (HERE / folder).glob(pattern))


def executables() -> list[str]:
    """Write what `ros2 run` starts after `pip install`; under colcon console scripts take over."""
    folder = HERE / 'build' / 'executables'
    folder.mkdir(parents=True, exist_ok=True)
    for node in NODES:
        script = folder / node
        script.write_text(
            '#!/bin/sh\n'
            'python="$(dirname "$(readlink -f "$0")")/../../bin/python3"\n'
            '[ -x "$python" ] || python=python3\n'
            f'exec "$python" -m {NAME}.nodes.{node} "$@"\n',
            encoding='utf-8',
        )
        script.chmod(0o755)
    return [f'build/executables/{node}' for node in NODES]


setup(
    name=NAME,
    version='0.1.0',
    description='Motion of slow, sensor-driven robots on ROS 2: probes, twist, turrets, one ICR',
    long_description=(HERE / 'README.md').read_text(encoding='utf-8'),
    long_description_content_type='text/markdown',
    license='Apache-2.0',
    keywords=['ROS 2', 'robotics', 'kinematics', 'swerve', 'sap flow', 'rosbag', 'MCAP'],
    classifiers=[
        'Development Status :: 4 - Beta',
        'Intended Audience :: Developers',
        'Intended Audience :: Science/Research',
        'Operating System :: POSIX :: Linux',
        'Programming Language :: Python :: 3',
        'Topic :: Scientific/Engineering',
    ],
    packages=find_packages(include=[NAME, f'{NAME}.*']),
    package_data={NAME: ['dashboard/static/**']},
    python_requires='>=3.10',
    install_requires=[
        'isal>=1.6; platform_machine in "x86_64 AMD64 aarch64 arm64"',
        'lz4>=4',
        'numpy>=1.26',
        'pyserial>=3.5',
        'pyyaml>=6',
        'rich>=13',
        'rosbags>=0.10',
        'shapely>=2',
        # from 0.29 on it imports pydantic: each command would start 0.4 s of computing later
        'typer>=0.12,<0.29',
        'tzdata',
        'zstandard>=0.22',
    ],
    extras_require={
        # ROS 2 Jazzy itself, for a machine without a ROS installation
        'ros': ROS,
        # the operator's page
        'dashboard': DASHBOARD,
        # probes whose logger publishes to a broker
        'mqtt': MQTT,
        'parquet': ['pyarrow>=14'],
        'plot': PLOT,
        # all that `agv demo` wants on a machine without a ROS installation
        'demo': [*ROS, *DASHBOARD, *PLOT],
        'test': [
            *DASHBOARD,
            *MQTT,
            *PLOT,
            'axe-playwright-python>=0.1',
            'catkin_pkg',
            'colcon-common-extensions',
            'colcon-ros',
            'distributed>=2024.5',
            'httpx>=0.27',
            'hypothesis>=6.100',
            'mcap>=1.1',
            'mcap-ros2-support>=0.5',
            'mpmath>=1.3',
            'mypy>=1.11',
            'networkx>=3.1',
            'pandas>=2',
            'playwright>=1.45',
            'pyarrow>=14',
            'pyte>=0.8',
            'pytest>=8',
            'pytest-timeout>=2.3',
            'pytest-xdist>=3.7',
            'ruff>=0.12',
            'types-pyserial',
            'types-pyyaml',
            'yourdfpy>=0.0.56',
        ],
        'benchmark': [
            'evo>=1.31',
            'foxglove-sdk>=0.14',
            'mcap>=1.1',
            'mcap-ros2-support-fast>=0.8',
            'pyarrow>=20',
            'pymcap-cli>=0.34',
            'roboto-mcap-codec>=0.3',
            'robotpy-wpimath',
        ],
        'cluster': ['distributed>=2024.5'],
    },
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (SHARE, ['package.xml']),
        (f'{SHARE}/config', files('config', '*.yaml')),
        *(
            (f'{SHARE}/config/{folder}', files(f'config/{folder}', f'*.{suffix}'))
            for folder, suffix in (('foxglove', 'json'), ('rviz', 'rviz'), ('plotjuggler', 'xml'))
        ),
        (f'{SHARE}/config/ros2_control', files('config/ros2_control', 'tree_*')),
        (f'{SHARE}/launch', files('launch_scripts/launch', '*.launch.py')),
        (f'lib/{NAME}', executables()),
    ],
    entry_points={
        'console_scripts': [
            'agv = agv_motion.cli.main:main',
            *(f'{node} = {NAME}.nodes.{node}:main' for node in NODES),
        ],
    },
    zip_safe=False,
)
