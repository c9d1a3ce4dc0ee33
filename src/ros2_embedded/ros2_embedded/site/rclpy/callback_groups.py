# SPDX-License-Identifier: Apache-2.0
"""Which callbacks may run at the same time."""

from __future__ import annotations

import weakref
from threading import Lock


class CallbackGroup:
    """Base of the callback groups."""

    def __init__(self) -> None:
        super().__init__()
        self.entities: set[weakref.ref[object]] = set()

    def add_entity(self, entity: object) -> None:
        """Put an entity into the group.

        Args:
            entity: Timer, subscription, service, client or guard condition.
        """
        self.entities.add(weakref.ref(entity))

    def has_entity(self, entity: object) -> bool:
        """Tell whether an entity is in the group.

        Args:
            entity: The entity.

        Returns:
            Whether it is.
        """
        return weakref.ref(entity) in self.entities

    def can_execute(self, entity: object) -> bool:
        """Tell whether the callback of an entity may run now.

        Args:
            entity: Entity of the group.

        Returns:
            Whether it may.
        """
        raise NotImplementedError

    def beginning_execution(self, entity: object) -> bool:
        """Ask to run the callback of an entity.

        Args:
            entity: Entity of the group.

        Returns:
            Whether it may run; then :meth:`ending_execution` must follow.
        """
        raise NotImplementedError

    def ending_execution(self, entity: object) -> None:
        """Tell that the callback of an entity has finished.

        Args:
            entity: Entity of the group.
        """
        raise NotImplementedError


class ReentrantCallbackGroup(CallbackGroup):
    """Any callbacks may run at the same time."""

    def can_execute(self, entity: object) -> bool:
        """Tell that the callback may run."""
        return True

    def beginning_execution(self, entity: object) -> bool:
        """Allow the callback to run."""
        return True

    def ending_execution(self, entity: object) -> None:
        """Take notice."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """One callback at a time, until it has finished, also if it awaits something."""

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: object | None = None
        self._lock = Lock()

    def can_execute(self, entity: object) -> bool:
        """Tell whether no callback of the group is running."""
        with self._lock:
            return self._active_entity is None

    def beginning_execution(self, entity: object) -> bool:
        """Run the callback if no other is running."""
        with self._lock:
            if self._active_entity is not None:
                return False
            self._active_entity = entity
            return True

    def ending_execution(self, entity: object) -> None:
        """Let others run."""
        with self._lock:
            assert self._active_entity is entity
            self._active_entity = None
