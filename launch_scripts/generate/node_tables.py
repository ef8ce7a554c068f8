"""Write the tables of parameters in agv_motion/nodes/README.md from their one declaration."""

from __future__ import annotations

import re
from pathlib import Path

from agv_motion.cli.nodes.parameters import markdown
from agv_motion.nodes.catalogue import available, parameters_of

PAGE = Path(__file__).parents[2] / 'agv_motion' / 'nodes' / 'README.md'

TABLE = re.compile(r'\| parameter \|.*\n(?:\|.*\n)*')


def written(page: str) -> str:
    """Return a page with the table of each node as its parameters are declared.

    Raises:
        ValueError: A node has no section, or its section no table.

    """
    before, *sections = re.split(r'(?m)^(?=## )', page)
    found = {section.split('\n', 1)[0].removeprefix('## '): section for section in sections}
    for node in available():
        section = found.get(node, '')
        if not TABLE.search(section):
            msg = f'{PAGE.name} has no section "## {node}" with a table that begins "| parameter |"'
            raise ValueError(msg)
        table = markdown(parameters_of(node))
        found[node] = TABLE.sub(lambda _, table=table: table, section, count=1)
    return before + ''.join(found.values())


def main() -> None:
    """Write them."""
    PAGE.write_text(written(PAGE.read_text(encoding='utf-8')), encoding='utf-8')


if __name__ == '__main__':
    main()
