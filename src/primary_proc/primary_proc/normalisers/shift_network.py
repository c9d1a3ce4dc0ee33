# SPDX-License-Identifier: Apache-2.0
"""Sums, minima and maxima of an array with itself moved along, planned once and run on many blocks.

A statistic of a sliding window is a network of operations on whole arrays. It is written down as expressions; the plan
runs what the result needs and nothing else, each expression once, in as few buffers as its order allows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Operation = tuple[np.ufunc, npt.NDArray, npt.NDArray, npt.NDArray]


@dataclass(frozen=True, slots=True, order=True)
class Signal:
    """An array of the network, seen from some places further on.

    Attributes:
        node: which array; 0 is the source.
        shift: its element c stands for element c + shift of that array.
    """

    node: int
    shift: int = 0

    def ahead(self, places: int) -> Signal:
        """Look further on.

        Args:
            places: how far.

        Returns:
            The same array, moved.
        """
        return Signal(self.node, self.shift + places)


SOURCE = Signal(0)
"""What the network works on."""


class ShiftNetwork:
    """Expressions on shifted arrays; equal ones are one."""

    def __init__(self) -> None:
        """Start with the source alone."""
        self._nodes: list[tuple[np.ufunc, Signal, Signal]] = []
        self._known: dict[tuple[np.ufunc, Signal, Signal], int] = {}

    def combine(self, operation: np.ufunc, one: Signal, other: Signal) -> Signal:
        """Combine two arrays element by element.

        Args:
            operation: commutative, such as `numpy.minimum`.
            one: first array.
            other: second array.

        Returns:
            The result.
        """
        base = min(one.shift, other.shift)
        low, high = sorted((one.ahead(-base), other.ahead(-base)))
        key = (operation, low, high)
        if key not in self._known:
            self._nodes.append(key)
            self._known[key] = len(self._nodes)
        return Signal(self._known[key], base)

    def plan(self, result: Signal) -> ShiftPlan:
        """Find out what a result needs and where it can lie.

        Args:
            result: wanted, as `combine` gives it of arrays of which one is not moved.

        Returns:
            The plan.

        Raises:
            ValueError: the result is moved itself.
        """
        if result.shift:
            raise ValueError(f"the result lies {result.shift} places ahead of its array")
        needed = self._needed(result)
        last_use = {s.node: node for node in needed for s in self._nodes[node - 1][1:]}
        place = {0: 0}
        free: list[int] = []
        buffers = 1
        steps = []
        for node in needed:
            operation, one, other = self._nodes[node - 1]
            ending = [s for s in {one.node, other.node} if s and last_use[s] == node]
            # An array may be overwritten by what comes of it if it is read at its own place only.
            moved = {s.node for s in (one, other) if s.shift}
            reusable = [s for s in ending if s not in moved]
            if reusable:
                place[node] = place[reusable[0]]
                ending.remove(reusable[0])
            elif free:
                place[node] = free.pop()
            else:
                place[node] = buffers
                buffers += 1
            free += [place[s] for s in ending]
            sources = Signal(place[one.node], one.shift), Signal(place[other.node], other.shift)
            steps.append((operation, *sources, place[node]))
        return ShiftPlan(steps, buffers, place[result.node])

    def _needed(self, result: Signal) -> list[int]:
        """Nodes that a result rests on, in their order."""
        needed, open_nodes = set(), [result.node]
        while open_nodes:
            node = open_nodes.pop()
            if node and node not in needed:
                needed.add(node)
                open_nodes += [s.node for s in self._nodes[node - 1][1:]]
        return sorted(needed)


@dataclass(frozen=True, slots=True)
class ShiftPlan:
    """Operations in their order, on numbered buffers.

    Attributes:
        steps: operation, its two operands (a buffer and a shift each) and the buffer of the result.
        buffers: how many buffers, the source (0) included.
        result: buffer of the result.
    """

    steps: list[tuple[np.ufunc, Signal, Signal, int]]
    buffers: int
    result: int

    def bind(self, buffers: list[npt.NDArray], size: int) -> list[Operation]:
        """Set up the operations for buffers.

        Args:
            buffers: flat arrays, the source first.
            size: elements of each that are in use; the last ones of a result, as many as it looks ahead, are void.

        Returns:
            Operation, operands and result, as views.
        """
        bound = []
        for operation, one, other, target in self.steps:
            length = size - max(one.shift, other.shift)
            operands = [buffers[s.node][s.shift : s.shift + length] for s in (one, other)]
            bound.append((operation, operands[0], operands[1], buffers[target][:length]))
        return bound
