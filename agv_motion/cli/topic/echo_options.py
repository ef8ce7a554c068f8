"""Options that `agv topic echo` and `agv bag echo` have in common, as ros2 names them."""

from __future__ import annotations

from typing import Annotated

import typer

Csv = Annotated[bool, typer.Option('--csv', help='Values separated by commas.')]
Field = Annotated[str, typer.Option(help='Only this field, such as pose.pose.position.')]
FullLength = Annotated[bool, typer.Option('-f', '--full-length', help='Cut nothing.')]
TruncateLength = Annotated[
    int, typer.Option('-l', '--truncate-length', min=0, help='Cut arrays and strings here.')
]
NoArrays = Annotated[bool, typer.Option('--no-arr', help='Hide arrays.')]
NoStrings = Annotated[bool, typer.Option('--no-str', help='Hide strings.')]
FlowStyle = Annotated[bool, typer.Option('--flow-style', help='One line.')]
Filter = Annotated[str, typer.Option('--filter', help='Python expression of m, the message.')]
Once = Annotated[bool, typer.Option('--once', help='Stop after the first message.')]
MessageInfo = Annotated[
    bool, typer.Option('-i', '--include-message-info', help='Stamps and numbers as well.')
]
