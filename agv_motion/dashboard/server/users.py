"""Users, their passwords and their sessions.

Passwords are kept as argon2id hashes. A session is a random token in a cookie; the database holds
its digest only, so that neither the cookie of another nor a copy of the file logs anybody in, and
logging out ends it for whoever stole it too.
"""

from __future__ import annotations

import hashlib
import hmac
import re
import secrets
import time
from functools import cached_property
from typing import TYPE_CHECKING

from argon2 import PasswordHasher
from argon2.exceptions import Argon2Error, InvalidHashError

from agv_motion.dashboard.server.roles import ROLES, Role, Visitor
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.dashboard.server.store import Store

LASTING = 12 * 3600.0
"""[s] for which a session lasts"""
SHORTEST, LONGEST = 10, 200
"""characters of a password"""
NAME = re.compile(r'[A-Za-z0-9][A-Za-z0-9_.@-]{0,39}')
MOST_HOURS = 24.0 * 31.0
"""for which a token of a tool may last"""
LONGEST_TOKEN = 200
MOST_SESSIONS = 20
"""of one user; the oldest ends first"""


class Users:
    """Those who may come from beyond this machine."""

    def __init__(
        self, store: Store, clock: Callable[[], float] = time.time,
        hasher: PasswordHasher | None = None,
    ) -> None:  # fmt: skip
        """Use the users of a database.

        Args:
            store: The database.
            clock: Returns seconds since 1970.
            hasher: Of passwords; None for the one that its makers recommend.

        """
        self._store, self._clock = store, clock
        self._hasher = hasher or PasswordHasher()
        self._secret = store.secret('csrf', secrets.token_hex(32)).encode()

    @cached_property
    def _nobody(self) -> str:
        """Hash of a password that nobody knows: to verify takes as long as for a user."""
        return self._hasher.hash(secrets.token_hex(16))

    # Users

    def names(self) -> dict[str, str]:
        """Return the role of each user, by name."""
        return dict(self._store.rows('SELECT name, role FROM users ORDER BY name'))

    def add(self, name: str, password: str, role: str) -> None:
        """Add a user.

        Raises:
            ConfigurationError: There is one of this name, or name, password or role cannot be used.

        """
        if not NAME.fullmatch(name):
            msg = f"user '{name}': up to 40 letters, digits, and . _ - @ after the first"
            raise ConfigurationError(msg)
        _require_role(role)
        _require_good(password, name)
        if name in self.names():
            msg = f"there is a user '{name}' already: agv dashboard user password {name}"
            raise ConfigurationError(msg)
        self._store.change(
            'INSERT INTO users VALUES (?, ?, ?, ?)',
            (name, role, self._hasher.hash(password), self._clock()),
        )

    def set_password(self, name: str, password: str) -> None:
        """Give a user another password, and end all its sessions.

        Raises:
            ConfigurationError: There is no such user, or the password cannot be used.

        """
        self._require(name)
        _require_good(password, name)
        hashed = self._hasher.hash(password)
        self._store.change('UPDATE users SET hash = ? WHERE name = ?', (hashed, name))
        self.end_all(name)

    def set_role(self, name: str, role: str) -> None:
        """Give a user another role, at once for its sessions too.

        Raises:
            ConfigurationError: There is no such user, or no such role.

        """
        self._require(name)
        _require_role(role)
        self._store.change('UPDATE users SET role = ? WHERE name = ?', (role, name))

    def remove(self, name: str) -> None:
        """Let a user in no more.

        Raises:
            ConfigurationError: There is no such user.

        """
        self._require(name)
        self.end_all(name)
        self._store.change('DELETE FROM users WHERE name = ?', (name,))

    def verify(self, name: str, password: str) -> bool:
        """Return whether a password is that of a user; takes as long where there is none."""
        found = self._store.rows('SELECT hash FROM users WHERE name = ?', (name,))
        nobody = self._nobody
        hashed = str(found[0][0]) if found else nobody
        try:
            self._hasher.verify(hashed, password[:LONGEST])
        except (Argon2Error, InvalidHashError):
            return False
        return bool(found) and len(password) <= LONGEST

    # Sessions

    def begin(self, name: str) -> str:
        """Begin a session of a user; return its token, which nobody else ever sees."""
        token, now = secrets.token_urlsafe(32), self._clock()
        with self._store.transaction():
            self._store.change('DELETE FROM sessions WHERE expires < ?', (now,))
            self._store.change(
                'DELETE FROM sessions WHERE user = ? AND digest NOT IN (SELECT digest FROM '
                'sessions WHERE user = ? ORDER BY created DESC LIMIT ?)',
                (name, name, MOST_SESSIONS - 1),
            )
            self._store.change(
                'INSERT INTO sessions VALUES (?, ?, ?, ?)',
                (_digest(token), name, now, now + LASTING),
            )
        return token

    def visitor(self, token: str) -> Visitor | None:
        """Return whose session a token is; None if it is none, or is over."""
        found = self._store.rows(
            'SELECT users.name, users.role, sessions.expires FROM sessions JOIN users '
            'ON sessions.user = users.name WHERE sessions.digest = ?', (_digest(token),),
        )  # fmt: skip
        if not found or not self._clock() < found[0][2]:
            return None
        name, role, _ = found[0]
        return Visitor(name, ROLES.get(role, Role.PUBLIC), self.csrf(token))

    def csrf(self, token: str) -> str:
        """Return the token that acts of a session must bear: no other page can know it."""
        return hmac.new(self._secret, token.encode(), hashlib.sha256).hexdigest()

    # Tokens for the Foxglove endpoint: nothing is kept of them

    def bearer_token(self, name: str, role: str, hours: float) -> str:
        """Return a token that tools bear in an address, for `/foxglove` alone.

        It is void once it is over, and when the user is removed or gets another password.

        Args:
            name: Of a user.
            role: That it has at most, and never more than the user has.
            hours: For which it lasts.

        Raises:
            ConfigurationError: There is no such user or role, or it would last too long.

        """
        self._require(name)
        _require_role(role)
        if not 0.0 < hours <= MOST_HOURS:
            msg = f'hours = {hours:g}: must lie in (0, {MOST_HOURS:g}]'
            raise ConfigurationError(msg)
        told = f'{name}!{role}!{round(self._clock() + 3600.0 * hours)}'
        return f'{told}!{self._sealed(told, name)}'

    def bearer(self, token: str) -> Visitor | None:
        """Return whose a token of `bearer_token` is; None if it is none, or is over."""
        told, _, seal = token[:LONGEST_TOKEN].rpartition('!')
        name, _, rest = told.partition('!')
        role, _, end = rest.partition('!')
        found = self.names().get(name)
        good = found is not None and hmac.compare_digest(
            self._sealed(told, name).encode(), seal.encode('utf-8', 'replace')
        )
        if not good or found not in ROLES or role not in ROLES or not self._clock() < int(end):
            return None
        return Visitor(name, min(ROLES[found], ROLES[role]), '')

    def _sealed(self, told: str, name: str) -> str:
        rows = self._store.rows('SELECT hash FROM users WHERE name = ?', (name,))
        words = f'foxglove {told} {rows[0][0] if rows else ""}'
        return hmac.new(self._secret, words.encode(), hashlib.sha256).hexdigest()

    def end(self, token: str) -> None:
        """End a session."""
        self._store.change('DELETE FROM sessions WHERE digest = ?', (_digest(token),))

    def end_all(self, name: str) -> None:
        """End all sessions of a user, on whatever machine."""
        self._store.change('DELETE FROM sessions WHERE user = ?', (name,))

    def _require(self, name: str) -> None:
        names = self.names()
        if name not in names:
            msg = f"no user '{name}'; there are {', '.join(names) or 'none'}"
            raise ConfigurationError(msg)


def _digest(token: str) -> str:
    return hashlib.sha256(token.encode()).hexdigest()


def _require_role(role: str) -> None:
    if role not in ROLES or role == Role.PUBLIC.word:
        choices = ', '.join(one for one in ROLES if one != Role.PUBLIC.word)
        msg = f"role '{role}': choose one of {choices}; the public needs no user"
        raise ConfigurationError(msg)


def _require_good(password: str, name: str) -> None:
    """Refuse a password that is soon guessed; it is never quoted."""
    if not SHORTEST <= len(password) <= LONGEST:
        msg = f'the password has {len(password)} characters: use {SHORTEST} to {LONGEST}'
        raise ConfigurationError(msg)
    if name.lower() in password.lower() or len(set(password)) < 5:
        msg = 'the password is soon guessed: leave out the name, and use more different characters'
        raise ConfigurationError(msg)
