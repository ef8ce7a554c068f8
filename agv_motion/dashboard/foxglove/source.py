"""What the endpoint needs of whoever knows a graph; all is called in the thread of the server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from asyncio import Future
    from collections.abc import Iterable, Mapping

    from agv_motion.dashboard.foxglove.channels import GraphTopic
    from agv_motion.dashboard.foxglove.protocol import ConnectionGraph


class GraphSource(Protocol):
    """A graph, live."""

    @property
    def topics(self) -> Mapping[str, GraphTopic]:
        """Those that are there, by name; another object when something has changed."""

    @property
    def services(self) -> Mapping[str, str]:
        """Type of each service, by name; another object when something has changed."""

    @property
    def complaints(self) -> Mapping[str, str]:
        """Why topics are not served, by name; another object when something has changed."""

    @property
    def connections(self) -> ConnectionGraph:
        """Who speaks with whom; known only while that is wanted."""

    @property
    def simulated(self) -> bool:
        """Whether the time of the robots is a simulation's."""

    def watch(
        self, topics: frozenset[str], *, clients: bool, parameters: bool, connections: bool
    ) -> None:
        """Tell what is wanted.

        Args:
            topics: That clients have chosen.
            clients: Whether there is one.
            parameters: Whether changes of parameters are to be told.
            connections: Whether `connections` is looked at.

        """

    def take(self) -> Iterable[tuple[str, int, bytes]]:
        """Yield topic, time of arrival [ns] and data of each message since the last time."""

    def time(self) -> int | None:
        """Return the robots' simulated time [ns]; None where time is real."""

    def changed_parameters(self) -> Mapping[str, Any]:
        """Return what has changed since the last time: ``/node.parameter`` and its value."""

    def prepare(self, topic: str, kind: str) -> Future[str]:
        """Let who listens to a topic be found before something is published."""

    def publish(self, topic: str, kind: str, data: bytes) -> Future[str]:
        """Publish a message in CDR; the future ends when it is out, or with why it is not."""

    def call(self, service: str, kind: str, data: bytes) -> Future[bytes]:
        """Call a service with a request in CDR; the future has the response, or why none is."""

    def service_definitions(self, kind: str) -> tuple[str, str]:
        """Return the definitions of request and response of a type of service.

        Raises:
            ConfigurationError: It is not installed.

        """
