"""A page, opened: its database, its users and who may come."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.site import Site
from agv_motion.dashboard.server.store import Store, state_folder
from agv_motion.dashboard.server.users import Users

if TYPE_CHECKING:
    from agv_motion.dashboard.server.fleet import Fleet


def opened(fleet: Fleet, host: str, folder: str = '') -> Site:
    """Return the page of some robots.

    Args:
        fleet: The robots.
        host: Address on which it is served.
        folder: Where the database is; empty: in the state folder of the user.

    Raises:
        ConfigurationError: The database cannot be used; or other machines reach the page, and
            there is no user.

    """
    store = Store(state_folder(folder))
    try:
        return Site(fleet, Access(host, Users(store)), store)
    except BaseException:
        store.close()
        raise
