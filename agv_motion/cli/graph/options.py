"""Options that the commands have in common which look at the ROS graph, as ros2 names them."""

from __future__ import annotations

from typing import Annotated

import typer

from agv_motion.cli.graph.completion import names_of_nodes

Node = Annotated[
    str,
    typer.Argument(
        help="Name of the node, such as '/oak/wheel_kinematics'.", autocompletion=names_of_nodes
    ),
]
SpinTime = Annotated[float, typer.Option(help='Seconds to wait for discovery.', min=0.0)]
SimTime = Annotated[bool, typer.Option('--use-sim-time', '-s', help='Use simulation time.')]
HiddenNodes = Annotated[bool, typer.Option('--include-hidden-nodes', help='Hidden ones as well.')]
HiddenTopics = Annotated[
    bool, typer.Option('--include-hidden-topics', help='Hidden topics as well.')
]
HiddenServices = Annotated[
    bool, typer.Option('--include-hidden-services', help='Hidden services as well.')
]
Timeout = Annotated[float, typer.Option(help='Seconds to wait for the node.', min=0.0)]
NoDaemon = Annotated[
    bool, typer.Option('--no-daemon', hidden=True, help='As ros2: there is no daemon here.')
]
