"""Which part of a bag to play, and how: the parameters of a playback."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.bag.selection import Selection
from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class PlaybackParameters:
    """Which part of a bag to play, and how."""

    rate: Annotated[
        float, Spec('seconds of the bag per second', '1', (0.001, 1000.0), dynamic=True)
    ] = 1.0
    loop: Annotated[bool, Spec('begin again at the end, for ever')] = False
    start_offset: Annotated[float, Spec('where in the bag to begin', 's', (0.0, 1e10))] = 0.0
    playback_duration: Annotated[
        float, Spec('how much of the bag to play; negative: all', 's', (-1.0, 1e10))
    ] = -1.0
    playback_until: Annotated[
        float,
        Spec('stop at this time of the bag, since 1970; negative: at its end', 's', (-1, 1e10)),
    ] = -1.0
    playback_until_nsec: Annotated[
        int, Spec('the same, exact, instead of playback_until; negative: not', 'ns')
    ] = -1
    skip_gaps: Annotated[
        bool, Spec('go on at once where nothing was recorded between two bags')
    ] = False
    delay: Annotated[float, Spec('wait before the first message', 's', (0.0, 1e6))] = 0.0
    start_paused: Annotated[bool, Spec('wait for ~/resume')] = False
    topics: Annotated[tuple[str, ...], Spec('play only these')] = ()
    regex: Annotated[str, Spec('play only topics in whose name this is found')] = ''
    exclude_topics: Annotated[tuple[str, ...], Spec('do not play these')] = ()
    exclude_regex: Annotated[str, Spec('do not play topics in whose name this is found')] = ''

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def selection(self) -> Selection:
        """Return which topics to play."""
        return Selection(
            everything=not (self.topics or self.regex),
            topics=self.topics,
            regex=self.regex,
            exclude_topics=self.exclude_topics,
            exclude_regex=self.exclude_regex,
            hidden=True,
        )
