"""The daily reports: `GET /reports` lists them, `GET /reports/2026-11-30.html` shows one.

A report is one file of HTML with its figures and styles within; it is shown in a sandbox, where no
script runs and nothing is loaded.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from starlette.responses import FileResponse
from starlette.routing import Route

from agv_motion.dashboard.server.door import Asked, looking, refusal, require_role
from agv_motion.dashboard.server.requests import RequestError
from agv_motion.dashboard.server.roles import Role

if TYPE_CHECKING:
    from pathlib import Path

    from starlette.requests import Request
    from starlette.responses import Response

    from agv_motion.dashboard.server.site import Site

POLICY = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox; frame-ancestors 'none'"
)
MOST = 1000
_NAME = re.compile(r'\d{4}-\d{2}-\d{2}[A-Za-z0-9_.-]{0,60}\.html')


def report_doors(site: Site) -> list[Route]:
    """Return the doors to the reports."""

    def listed(_: Asked) -> list[dict[str, str]]:
        return [
            {'date': path.name.removesuffix('.html'), 'url': f'/reports/{path.name}'}
            for path in reports(site)
        ]

    async def show(request: Request) -> Response:
        try:
            require_role(site.access.visitor(request), Role.VIEWER)
        except RequestError as error:
            return refusal(error)
        found = {path.name: path for path in reports(site)}
        name = str(request.path_params['name'])
        if name not in found:
            return refusal(RequestError(404, f"no report '{name[:60]}'"))
        headers = {'content-security-policy': POLICY}
        return FileResponse(found[name], media_type='text/html', headers=headers)

    return [looking(site, '/reports', listed), Route('/reports/{name}', show)]


def reports(site: Site) -> list[Path]:
    """Return the files of the reports, newest first."""
    folder = site.reports
    if folder is None or not folder.is_dir():
        return []
    found = [
        path
        for path in folder.iterdir()
        if _NAME.fullmatch(path.name) and path.is_file() and not path.is_symlink()
    ]
    return sorted(found, key=lambda path: path.name, reverse=True)[:MOST]
