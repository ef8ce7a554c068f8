"""A page, opened: its database, its users and who may come."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.dashboard.server.access import Access
from agv_motion.dashboard.server.history_bag import History
from agv_motion.dashboard.server.site import Site
from agv_motion.dashboard.server.store import Store, state_folder
from agv_motion.dashboard.server.users import Users

if TYPE_CHECKING:
    from agv_motion.dashboard.server.fleet import Fleet


def opened(
    fleet: Fleet, host: str, folder: str = '', bag: str = '', *, recorded: bool = False
) -> Site:
    """Return the page of some robots.

    Args:
        fleet: The robots.
        host: Address on which it is served.
        folder: Where the database is; empty: in the state folder of the user.
        bag: Into which one can look back; empty: none.
        recorded: Whether there is nothing but that bag.

    Raises:
        ConfigurationError: The database cannot be used; or other machines reach the page, and
            there is no user.

    """
    store = Store(state_folder(folder))
    try:
        beside = Path(bag).resolve().parent if bag else state_folder(folder)
        history = History(Path(bag), state_folder(folder) / 'bags') if bag else None
        access = Access(host, Users(store))
        return Site(fleet, access, store, history, reports=beside / 'reports', recorded=recorded)
    except BaseException:
        store.close()
        raise
