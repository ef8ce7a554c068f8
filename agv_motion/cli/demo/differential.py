"""`agv demo differential`: a differential drive that performs a sequence of actions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import terminal
from agv_motion.demo.domain import begin
from agv_motion.demo.folder import results

if TYPE_CHECKING:
    from rich.console import Console

    from agv_motion.nodes.differential_simulator import DifferentialSimulator
    from agv_motion.nodes.sequence import SequenceNode
    from agv_motion.ros.live_node import LiveNode
    from agv_motion.sequence.runner import Status

CONFIG = 'differential.yaml'


def differential(
    *,
    sequence: Annotated[
        str, typer.Option(help='Sequence of actions: a path, or a file of config/.')
    ] = 'sequence_example.yaml',
    time_factor: Annotated[
        float, typer.Option(min=0.1, max=20.0, help='Simulated seconds per second.')
    ] = 2.0,
    seed: Annotated[int, typer.Option(min=0, help='Of slip and noise.')] = 1,
    output: Annotated[Path, typer.Option(help='Folder of the results.')] = Path(
        'demo_output/differential'
    ),
) -> None:
    """Let a differential drive perform a sequence: poses, turns, an arc, a route, and home again.

    Its wheels slip by 5 and 2 %, its motors lag, its camera errs by a centimetre. Leaves a bag
    (MCAP) and a figure of what was planned and what was driven. Examples:

    agv demo differential

    agv demo differential --sequence patrol.yaml --time-factor 1
    """
    from agv_motion.report.run import read_run
    from agv_motion.report.run_figure import draw

    console = terminal()
    begin(console)
    with results(output, 'run.png') as bag:
        told, success = _perform(sequence, time_factor, seed, bag, console)
        console.print(told)
        with opened(bag) as reader:
            draw(read_run(reader), None, output / 'run.png')
            console.print(f'Bag: {bag}\nFigure: {output / "run.png"}')
    if not success:
        raise typer.Exit(1)


def _perform(
    sequence: str, time_factor: float, seed: int, bag: Path, console: Console
) -> tuple[str, bool]:
    """Run the graph until the sequence ends or Ctrl-C; return the last word, and whether done."""
    import rclpy
    from rclpy.signals import SignalHandlerOptions
    from rich.progress import Progress

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.ros.run import spin, start
    from agv_motion.ros.stop import Stop
    from agv_motion.sequence.runner import ENDS, SequenceState

    status: Status | None = None
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    stop = Stop()
    try:
        simulator, sequencer, nodes = _nodes(sequence, time_factor, seed)
        for node in nodes:
            start(node)
        robot, actions = simulator.plain, sequencer.plain
        recorder = DemoRecorder(bag, _topics(), lambda: robot.time)
        with Progress(console=console, transient=True) as progress:
            task = progress.add_task('driving', total=1.0)

            def finished() -> bool:
                nonlocal status
                progress.update(task, completed=actions.share_done(), description=actions.told)
                status = actions.runner.status if actions.runner is not None else status
                ended = status is not None and status.state in ENDS
                failed = bool(recorder.failure or actions.refusal)
                return stop.requested or failed or ended

            spin([recorder, *nodes], finished)
        recorder.close()
        last = recorder.latest('ground_truth')
        if last is None:
            return 'interrupted before anything moved', False
        place = last.pose.pose.position
        done = status is not None and status.state is SequenceState.DONE
        why = actions.refusal or (status.reason if status is not None else '') or 'interrupted'
        where = f'ends at {place.x:.3f} m, {place.y:.3f} m after {robot.elapsed:.1f} s'
        return f'{"done" if done else why}: {where}', done
    finally:
        rclpy.try_shutdown()


def _nodes(
    sequence: str, time_factor: float, seed: int
) -> tuple[LiveNode[DifferentialSimulator], LiveNode[SequenceNode], list[LiveNode[Any]]]:
    """Return the robot, its sequence, and all nodes with the values of ``differential.yaml``."""
    from agv_motion.demo.configured import configured
    from agv_motion.nodes.differential_kinematics import DifferentialKinematics
    from agv_motion.nodes.differential_simulator import DifferentialSimulator
    from agv_motion.nodes.sequence import SequenceNode
    from agv_motion.ros.live_node import LiveNode

    patient = {'use_sim_time': True, 'report_after': 1.0, 'stop_after': 2.0}
    robot = LiveNode(
        DifferentialSimulator,
        **configured(CONFIG, 'differential_simulator', {'time_factor': time_factor, 'seed': seed}),
    )
    actions = LiveNode(
        SequenceNode,
        **configured(CONFIG, 'sequence', patient | {'file': sequence, 'autorun': True}),
        cli_args=['--ros-args', '-r', 'pose:=fix'],
    )
    wheels = LiveNode(
        DifferentialKinematics, **configured(CONFIG, 'differential_kinematics', patient)
    )
    return robot, actions, [actions, wheels, robot]


def _topics() -> list[Any]:
    from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
    from nav_msgs.msg import Odometry
    from nav_msgs.msg import Path as PathMessage
    from sensor_msgs.msg import JointState
    from std_msgs.msg import Float64, String

    from agv_motion.demo.recorder import RecordedTopic

    return [
        RecordedTopic('cmd_vel', TwistStamped),
        RecordedTopic('wheels/command', JointState),
        RecordedTopic('wheels/state', JointState),
        RecordedTopic('odom', Odometry),
        RecordedTopic('fix', PoseWithCovarianceStamped),
        RecordedTopic('ground_truth', Odometry),
        RecordedTopic('sequence/path', PathMessage, latched=True),
        RecordedTopic('sequence/progress', Float64),
        RecordedTopic('sequence/state', String, latched=True),
    ]
