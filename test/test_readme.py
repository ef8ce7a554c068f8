"""The pages are true: parameters and examples stand in them, and every link leads somewhere."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from node_tables import PAGE, written

from agv_motion.nodes.catalogue import available

ROOT = Path(__file__).parents[1]

PAGES = [
    ROOT / 'README.md',
    *(p for folder in ('agv_motion', 'launch_scripts') for p in (ROOT / folder).rglob('README.md')),
]
LINK = re.compile(r'\]\(([^)\s]+)\)')
CODE = re.compile(r'^(```.*?^```|(?: {4}|\t).*?$)', re.MULTILINE | re.DOTALL)


def test_the_tables_of_the_nodes_are_as_their_parameters_are_declared():
    page = PAGE.read_text(encoding='utf-8')
    told, meant = page.splitlines(), written(page).splitlines()
    wrong = [line for line in meant if line not in told]
    assert told == meant, f'run python launch_scripts/generate/node_tables.py, for {wrong[:3]}'


def test_a_node_without_a_section_is_named():
    page = PAGE.read_text(encoding='utf-8')
    with pytest.raises(ValueError, match='no section "## simulator"'):
        written(page.replace('\n## simulator\n', '\n## another\n'))


def test_the_readme_names_every_node():
    readme = (ROOT / 'README.md').read_text(encoding='utf-8')
    assert [node for node in available() if f'`{node}`' not in readme] == []


def test_the_readme_is_short():
    assert len((ROOT / 'README.md').read_text(encoding='utf-8').splitlines()) <= 250


def anchors(page: Path) -> set[str]:
    """Return what GitHub makes of the headings of a page."""
    headings = re.findall(r'^#+ (.+)$', page.read_text(encoding='utf-8'), re.MULTILINE)
    return {re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in headings}


def broken(page: Path, text: str) -> list[str]:
    """Return the links of a page that lead nowhere."""
    found = []
    for link in LINK.findall(CODE.sub('', text)):
        if re.match(r'https?://', link):
            continue
        place, _, anchor = link.partition('#')
        target = page.parent / place if place else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            found.append(link)
    return found


@pytest.mark.parametrize('page', PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_leads_somewhere(page):
    assert broken(page, page.read_text(encoding='utf-8')) == []


def test_a_link_that_leads_nowhere_is_found():
    text = '[a](no/such.md) [b](#no-such-heading) [c](README.md#no) [d](README.md) [e](LICENSE)'
    assert broken(ROOT / 'README.md', text) == ['no/such.md', '#no-such-heading', 'README.md#no']


def test_every_room_has_a_page():
    rooms = {path.parent for path in (ROOT / 'agv_motion').glob('*/*.py') if '__' not in path.name}
    assert [room.name for room in sorted(rooms) if not (room / 'README.md').exists()] == []


def test_every_page_can_be_reached_from_the_readme():
    reached, waiting = set(), [ROOT / 'README.md']
    while waiting:
        page = waiting.pop()
        if page not in reached:
            reached.add(page)
            links = LINK.findall(CODE.sub('', page.read_text(encoding='utf-8')))
            targets = ((page.parent / link.partition('#')[0]).resolve() for link in links)
            waiting += [target for target in targets if target.name == 'README.md']
    assert [str(page) for page in PAGES if page not in reached] == []


def test_the_page_of_scripts_names_every_example_by_its_first_line():
    page = (ROOT / 'launch_scripts' / 'README.md').read_text(encoding='utf-8')
    for example in sorted((ROOT / 'launch_scripts' / 'examples').glob('*.py')):
        first = ast.get_docstring(ast.parse(example.read_text(encoding='utf-8'))).splitlines()[0]
        row = f'| [{example.name[:2]}](examples/{example.name}) | {first.rstrip(".")} |'
        assert row in page, row
