# SPDX-License-Identifier: Apache-2.0
"""The automaton with the fewest states that says the same (E. F. Moore, 1956: refinement of partitions)."""

from __future__ import annotations

import numpy as np

from primary_proc.automata.automaton import Automaton, in_order_of_output


def minimised(automaton: Automaton) -> Automaton:
    """Merge states that no continuation of the input tells apart.

    States start in one class for each output; a class is split while its members go on to different classes.

    Args:
        automaton: every state of which can be reached.

    Returns:
        The smallest equivalent automaton, its classes in the order of their first members.
    """
    classes = automaton.output.astype(np.int64)
    count = 0
    while count < (count := len(np.unique(classes))):
        seen = np.column_stack([classes, classes[automaton.following]])
        classes = np.unique(seen, axis=0, return_inverse=True)[1].reshape(-1)
    member = np.unique(classes, return_index=True)[1]
    member.sort()
    number = np.empty(count, np.int64)
    number[classes[member]] = np.arange(count)
    return in_order_of_output(
        number[classes[automaton.following[member]]], automaton.output[member]
    )
