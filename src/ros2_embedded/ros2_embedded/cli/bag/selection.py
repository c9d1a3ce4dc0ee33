# SPDX-License-Identifier: Apache-2.0
"""Which topics are recorded or played."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ros2_embedded.cli.names import is_hidden


@dataclass(frozen=True, kw_only=True)
class TopicSelection:
    """The user's choice of topics.

    Attributes:
        everything: Take every topic that is not hidden or excluded.
        topics: Full names to take.
        types: Types whose topics to take.
        pattern: Take topics whose name contains this expression; None takes none by pattern.
        excluded_topics: Full names to leave out in any case.
        excluded_types: Types to leave out in any case.
        excluded_pattern: Leave out topics whose name contains this expression.
        hidden: Take hidden topics as well.
    """

    everything: bool = False
    topics: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()
    pattern: re.Pattern[str] | None = None
    excluded_topics: frozenset[str] = frozenset()
    excluded_types: frozenset[str] = frozenset()
    excluded_pattern: re.Pattern[str] | None = None
    hidden: bool = False

    def takes(self, topic: str, msgtype: str) -> bool:
        """Tell whether a topic is taken.

        Args:
            topic: Its full name.
            msgtype: Its type.
        """
        wanted = (
            self.everything
            or topic in self.topics
            or msgtype in self.types
            or (self.pattern is not None and self.pattern.search(topic) is not None)
        )
        unwanted = (
            topic in self.excluded_topics
            or msgtype in self.excluded_types
            or (self.excluded_pattern is not None and bool(self.excluded_pattern.search(topic)))
            or (is_hidden(topic) and not self.hidden)
        )
        return wanted and not unwanted
