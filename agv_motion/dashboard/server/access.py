"""Who stands at a door: by session, or on this machine whoever is at it."""

from __future__ import annotations

import hmac
import secrets
from ipaddress import ip_address
from typing import TYPE_CHECKING

from agv_motion.dashboard.server.roles import Role, Visitor
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from starlette.requests import HTTPConnection

    from agv_motion.dashboard.server.users import Users

PLAIN, SECURE = 'agv_session', '__Host-agv_session'
"""Names of the cookie; by the second a browser keeps it to this host and to TLS."""
NOBODY = Visitor('', Role.PUBLIC, '')


def is_loopback(host: str) -> bool:
    """Return whether an address reaches this machine alone."""
    if host == 'localhost':
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False


class Access:
    """Tells the visitor of each request.

    Without users everybody at this machine is an expert, as whoever can start the page on it could
    speak to the robots without it; a foreign page in the same browser is kept out by its `Origin`
    and by the token that acts must bear. Where there are users, or other machines reach the page,
    everybody must log in.
    """

    def __init__(self, host: str, users: Users | None) -> None:
        """Decide whether a login is needed.

        Args:
            host: Address on which the page is served.
            users: Of the database; None without one.

        Raises:
            ConfigurationError: Other machines reach the page, and there is no user.

        """
        self.users = users
        some = users is not None and bool(users.names())
        if not is_loopback(host) and not some:
            msg = (
                f'on {host} other machines reach the page, and it has no user yet: first run '
                'agv dashboard user add NAME --role operator (or expert, viewer), or stay on '
                '127.0.0.1'
            )
            raise ConfigurationError(msg)
        self.needs_login = some
        self._local = Visitor('local', Role.EXPERT, secrets.token_hex(32))

    def visitor(self, connection: HTTPConnection) -> Visitor:
        """Return who is at the door."""
        if not self.needs_login:
            client = connection.client
            local = client is not None and is_loopback(client.host)
            return self._local if local else NOBODY
        token = token_of(connection)
        found = self.users.visitor(token) if token and self.users is not None else None
        return found or NOBODY

    @staticmethod
    def bears(visitor: Visitor, token: str) -> bool:
        """Return whether an act of a visitor bears its token."""
        return bool(visitor.csrf) and hmac.compare_digest(
            visitor.csrf.encode(), token.encode('utf-8', 'replace')
        )


def token_of(connection: HTTPConnection) -> str:
    """Return the token of a session out of its cookie; empty without one."""
    secure = connection.scope.get('scheme') in {'https', 'wss'}
    return connection.cookies.get(SECURE if secure else PLAIN, '')[:200]
