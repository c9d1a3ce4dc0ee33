# SPDX-License-Identifier: Apache-2.0
"""The automaton with the fewest states that says the same (E. F. Moore, 1956: refinement of partitions)."""

from __future__ import annotations

from collections.abc import Hashable
from typing import cast

import numpy as np

from primary_proc.automata.automaton import Automaton, Output, explore


def minimised(automaton: Automaton) -> Automaton:
    """Leave out what cannot be reached and merge states that no continuation of the input tells apart.

    States start in one class for each output; a class is split while its members go on to different classes.

    Args:
        automaton: any.

    Returns:
        The smallest automaton that says the same; equivalent automata give equal ones.
    """
    classes = automaton.output.astype(np.int64)
    count = 0
    while count < (count := len(np.unique(classes))):
        seen = np.column_stack([classes, classes[automaton.following]])
        classes = np.unique(seen, axis=0, return_inverse=True)[1].reshape(-1)
    member = np.unique(classes, return_index=True)[1]
    following = classes[automaton.following[member]].tolist()
    said = [Output(value) for value in automaton.output[member]]

    def step(state: Hashable, bit: int) -> Hashable:
        return cast(int, following[cast(int, state)][bit])

    return explore(int(classes[0]), step, lambda state: said[cast(int, state)])
