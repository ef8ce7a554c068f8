"""A plain node in an `InProcessGraph`: the same class as live, the same life, no middleware."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.model.frames import in_namespace
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.parameters import changed, filled, texts
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.quotation import told

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.ros.in_process_graph import InProcessGraph

N = TypeVar('N', bound=PlainNode[Any])
NO_NAMES: dict[str, str] = {}


class InProcessNode(Generic[N]):
    """Runs a plain node in a graph; made is configured."""

    def __init__(
        self,
        graph: InProcessGraph,
        kind: type[N],
        parameters: Mapping[str, Any],
        remap: Mapping[str, str] = NO_NAMES,
        namespace: str = '/',
    ) -> None:
        """Make the node and add it to the graph.

        Args:
            graph: Where it lives.
            kind: Class of the node, or what makes one of port and parameters.
            parameters: Values by dotted name, as a parameter file gives them.
            remap: Full names of topics, by the full names that the node uses.
            namespace: Of the node, such as ``/oak``.

        Raises:
            ConfigurationError: A parameter is wrong, or the node cannot be configured.

        """
        values = filled(kind.takes, parameters, kind.name)
        self.port = InProcessPort(
            graph,
            Place(kind.name, namespace, remap),
            partial(told, given=frozenset(texts(values))),
            is_simulated=bool(parameters.get('use_sim_time', False)),
        )
        self.plain: N = self._attempt(
            'configure', lambda: kind(self.port, in_namespace(values, namespace))
        )
        graph.nodes.append(self)

    def activate(self) -> None:
        """Let the node act.

        Raises:
            ConfigurationError: It cannot begin.

        """
        self._attempt('activate', self.plain.begin)
        self.port.active = True

    def deactivate(self) -> None:
        """Let the node leave its outputs safe and fall silent; what keeps it from that is told."""
        if self.port.active:
            self.port.active = False
            try:
                self.plain.halt()
            except AgvMotionError as error:
                self.port.error(f'cannot halt: {self.port.message_of(error)}')

    def set_parameters(self, changes: Mapping[str, Any]) -> None:
        """Change dynamic parameters by dotted name.

        Raises:
            AgvMotionError: A value is wrong, or the node does not accept it.

        """
        candidate = changed(self.plain.parameters, changes)  # its frames are placed already
        self.plain.accept(candidate)
        self.plain.parameters = candidate

    def _attempt(self, transition: str, act: Callable[[], Any]) -> Any:
        try:
            return act()
        except AgvMotionError as error:
            msg = f'{self.port.name} cannot {transition}: {self.port.message_of(error)}'
            raise ConfigurationError(msg) from error
