# SPDX-License-Identifier: Apache-2.0
"""Statistics of sliding windows as networks: windows double in length, so few operations make long ones."""

from __future__ import annotations

from itertools import zip_longest

import numpy as np

from primary_proc.normalisers.shift_network import SOURCE, ShiftNetwork, Signal


def window_sum(network: ShiftNetwork, length: int) -> Signal:
    """Sum of some elements in a row.

    Args:
        network: to write it into.
        length: elements.

    Returns:
        The sum of the elements from each place on.
    """
    result, covered = None, 0
    doubled, width = SOURCE, 1
    while True:
        if length & width:
            part = doubled.ahead(covered)
            result = part if result is None else network.combine(np.add, result, part)
            covered += width
        if covered == length:
            assert result is not None
            return result
        doubled = network.combine(np.add, doubled, doubled.ahead(width))
        width *= 2


def sorted_window(network: ShiftNetwork, length: int) -> list[Signal]:
    """Elements in a row, in rising order.

    Args:
        network: to write them into.
        length: elements.

    Returns:
        The smallest to the greatest of the elements from each place on.
    """
    result: list[Signal] = []
    doubled = [SOURCE]
    while True:
        if length & len(doubled):
            result = merged(network, result, _ahead(doubled, len(result)))
        if len(result) == length:
            return result
        doubled = merged(network, doubled, _ahead(doubled, len(doubled)))


def merged(network: ShiftNetwork, one: list[Signal], other: list[Signal]) -> list[Signal]:
    """Merge two sorted lists (K. E. Batcher 1968: odd-even merge, for any two lengths).

    Args:
        network: to write the result into.
        one: sorted.
        other: sorted.

    Returns:
        All of both, sorted.
    """
    if not one or not other:
        return one or other
    if len(one) == len(other) == 1:
        return _exchanged(network, one[0], other[0])
    first, *evens = merged(network, one[::2], other[::2])
    odds = merged(network, one[1::2], other[1::2])
    result = [first]
    for low, high in zip_longest(odds, evens):
        if low is not None and high is not None:
            result += _exchanged(network, low, high)
        else:
            result.append(low if high is None else high)
    return result


def ordered_of_two(
    network: ShiftNetwork, one: list[Signal], other: list[Signal], order: int
) -> Signal:
    """The k-th smallest of two sorted lists: the least of max(one_i, other_(k - i)), without merging them.

    Args:
        network: to write it into.
        one: sorted.
        other: sorted.
        order: k, 1 for the smallest of both.

    Returns:
        The element of this rank.
    """
    result = None
    for taken in range(max(0, order - len(other)), min(len(one), order) + 1):
        rest = order - taken
        if not taken:
            greatest = other[rest - 1]
        elif not rest:
            greatest = one[taken - 1]
        else:
            greatest = network.combine(np.maximum, one[taken - 1], other[rest - 1])
        result = greatest if result is None else network.combine(np.minimum, result, greatest)
    assert result is not None
    return result


def _exchanged(network: ShiftNetwork, one: Signal, other: Signal) -> list[Signal]:
    return [network.combine(operation, one, other) for operation in (np.minimum, np.maximum)]


def _ahead(signals: list[Signal], places: int) -> list[Signal]:
    return [signal.ahead(places) for signal in signals]
