# SPDX-License-Identifier: Apache-2.0
"""How executors find work."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._entity import Entity
from rclpy._work import WorkTracker
from rclpy.context import Context
from rclpy.task import Future, Task

from ros2_embedded.dds.waitset import Guard, WaitSet

if TYPE_CHECKING:
    from rclpy.node import Node

_NS = 10**9


class TimeoutException(Exception):
    """The time to wait is over."""


class ShutdownException(Exception):
    """The executor was shut down."""


class ExternalShutdownException(Exception):
    """The context was shut down."""


class ConditionReachedException(Exception):
    """What was waited for has come."""


class WorkFinder:
    """Waits for work and hands it out.

    Work is found in rounds. A round gives out all tasks that are under way, then waits for
    entities to become ready and gives out those, one at a time. Coroutines that await
    something go on once in a round and whenever a future is done.
    """

    def __init__(self, context: Context) -> None:
        """Start without nodes.

        Args:
            context: Ends the waiting when it is shut down.

        Raises:
            NotInitializedException: The context is not initialised.
        """
        self._context = context
        self._nodes: set[Node] = set()
        self._nodes_lock = threading.RLock()
        self._guard = Guard(self._context.participant)
        self._wait_set = WaitSet(self._context.participant)
        self._graph = self._context.graph
        self._is_shutdown = False
        self._listening = False
        self._tasks_lock = threading.Lock()
        self._new_tasks: deque[Task[Any]] = deque()
        self._suspended_tasks: list[Task[Any]] = []
        self._round: deque[Task[Any] | tuple[Entity, Node]] = deque()
        self._resumed_in_round = False
        self._seen_completions = Future.completions
        self._work = WorkTracker()
        self._context.wake_on_shutdown(self._guard)

    def get_nodes(self) -> list[Node]:
        """List the nodes.

        Returns:
            The nodes.
        """
        with self._nodes_lock:
            return list(self._nodes)

    def wake(self) -> None:
        """Look anew for what to wait for."""
        if self._listening:
            self._guard.trigger()

    def create_task(self, callback: Callable[..., Any], *args: Any, **kwargs: Any) -> Task[Any]:
        """Have a function or coroutine function run.

        Args:
            callback: The function.
            *args: Its arguments.
            **kwargs: Its keyword arguments.

        Returns:
            The task, a future of its result.
        """
        task: Task[Any] = Task(callback, args, kwargs, executor=self)
        self._add_task(task)
        return task

    def wait_for_ready_callbacks(
        self,
        timeout_sec: float | None = None,
        nodes: list[Node] | None = None,
        condition: Callable[[], bool] = lambda: False,
    ) -> tuple[Task[Any], Entity | None, Node | None]:
        """Find work.

        Args:
            timeout_sec: Longest wait in seconds; None or negative for any.
            nodes: Nodes to look at; None for all of the executor.
            condition: Ends the wait when it holds.

        Returns:
            What to run, and where it comes from if it is new.

        Raises:
            TimeoutException: Nothing was found in time.
            ShutdownException: The executor was shut down.
            ExternalShutdownException: The context was shut down.
            ConditionReachedException: The condition holds.
        """
        end = None
        if timeout_sec is not None and timeout_sec >= 0:
            end = time.monotonic() + timeout_sec
        while not self._is_shutdown and not condition():
            while self._round:
                item = self._round.popleft()
                if isinstance(item, Task):
                    if not item.done():
                        return item, None, None
                elif item[1] in (nodes or self._nodes) and item[0].can_execute():
                    return self._handler_of(item[0]), *item
            if not self._context.ok():
                raise ExternalShutdownException
            if not self._start_round() and not self._wait(nodes, end):
                raise TimeoutException
        raise ShutdownException if self._is_shutdown else ConditionReachedException

    def _start_round(self) -> bool:
        with self._tasks_lock:
            self._round.extend(self._new_tasks)
            self._new_tasks.clear()
            if not self._resumed_in_round or self._seen_completions != Future.completions:
                self._resumed_in_round = True
                self._seen_completions = Future.completions
                self._round.extend(self._suspended_tasks)
                self._suspended_tasks.clear()
        return bool(self._round)

    def _wait(self, nodes: list[Node] | None, end: float | None) -> bool:
        """Wait for entities; tells whether there is time left or something was found."""
        # From here on, changes must wake the wait: what follows may not see them.
        self._listening = True
        try:
            entities = [
                (entity, node)
                for node in nodes or self.get_nodes()
                for entity in node.entities()
                if entity.can_execute()
            ]
            left = None if end is None else end - time.monotonic()
            waits = [left, *(entity.wall_time_until_ready() for entity, _ in entities)]
            if self._new_tasks or self._is_shutdown or not self._context.ok():
                waits.append(0.0)
            shortest = min((wait for wait in waits if wait is not None), default=None)
            handles = {entity.wait_handle for entity, _ in entities}
            handles |= {self._guard.condition, self._graph.condition}
            handles.discard(None)
            ready = self._wait_set.wait(
                {handle for handle in handles if handle is not None},
                None if shortest is None else max(int(shortest * _NS), 0),
            )
        finally:
            self._listening = False
        self._guard.take()
        if self._graph.condition in ready:
            self._graph.refresh()
        found = [
            (entity, node)
            for entity, node in entities
            if entity.wall_time_until_ready() == 0.0 or entity.wait_handle in ready
        ]
        self._resumed_in_round = False
        self._round.extend(found)
        return bool(found) or end is None or time.monotonic() < end

    def _handler_of(self, entity: Entity) -> Task[Any]:
        # Until it is taken, the entity must not be found ready again.
        entity._executor_event = True
        return Task(self._handle, (entity,), executor=self)

    async def _handle(self, entity: Entity) -> None:
        group = entity.callback_group
        if self._is_shutdown or group is None or not group.beginning_execution(entity):
            entity._executor_event = False
            self.wake()
            return
        with self._work:
            try:
                try:
                    run = entity.take(self)
                finally:
                    entity._executor_event = False
                    self.wake()
                if run is not None:
                    await run()
            finally:
                group.ending_execution(entity)
                self.wake()

    def _add_task(self, task: Task[Any]) -> None:
        with self._tasks_lock:
            self._new_tasks.append(task)
        self.wake()
