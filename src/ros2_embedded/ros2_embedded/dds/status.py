# SPDX-License-Identifier: Apache-2.0
"""Events of endpoints: matches, refused qualities of service, missed deadlines."""

from __future__ import annotations

import ctypes as ct
from dataclasses import dataclass

from cyclonedds.internal import dds_c_t

from ros2_embedded.dds import library


@dataclass(frozen=True, slots=True)
class StatusKind:
    """One kind of event.

    Attributes:
        bit: Its bit in status masks.
        function: C function that reads it.
        structure: What the function fills.
    """

    bit: int
    function: str
    structure: type[ct.Structure]


OFFERED_DEADLINE_MISSED = StatusKind(
    1 << 1, "dds_get_offered_deadline_missed_status", dds_c_t.offered_deadline_missed_status
)
REQUESTED_DEADLINE_MISSED = StatusKind(
    1 << 2, "dds_get_requested_deadline_missed_status", dds_c_t.requested_deadline_missed_status
)
OFFERED_INCOMPATIBLE_QOS = StatusKind(
    1 << 3, "dds_get_offered_incompatible_qos_status", dds_c_t.offered_incompatible_qos_status
)
REQUESTED_INCOMPATIBLE_QOS = StatusKind(
    1 << 4,
    "dds_get_requested_incompatible_qos_status",
    dds_c_t.requested_incompatible_qos_status,
)
SAMPLE_LOST = StatusKind(1 << 5, "dds_get_sample_lost_status", dds_c_t.sample_lost_status)
LIVELINESS_LOST = StatusKind(
    1 << 9, "dds_get_liveliness_lost_status", dds_c_t.liveliness_lost_status
)
LIVELINESS_CHANGED = StatusKind(
    1 << 10, "dds_get_liveliness_changed_status", dds_c_t.liveliness_changed_status
)
PUBLICATION_MATCHED = StatusKind(
    1 << 11, "dds_get_publication_matched_status", dds_c_t.publication_matched_status
)
SUBSCRIPTION_MATCHED = StatusKind(
    1 << 12, "dds_get_subscription_matched_status", dds_c_t.subscription_matched_status
)


def watch(handle: int, kinds: list[StatusKind]) -> None:
    """Choose the events for which an endpoint wakes a waitset.

    Args:
        handle: Handle of the endpoint.
        kinds: The events.
    """
    mask = 0
    for kind in kinds:
        mask |= kind.bit
    library.set_status_mask(handle, mask)


def take_status(handle: int, kind: StatusKind) -> ct.Structure | None:
    """Read an event of an endpoint.

    Args:
        handle: Handle of the endpoint.
        kind: The event.

    Returns:
        The status, None if nothing has changed since the last time or the endpoint is gone.
    """
    status = kind.structure()
    read = library.status_function(kind.function, kind.structure)
    if read(handle, ct.byref(status)) < 0:
        return None
    changes = (name for name, *_ in kind.structure._fields_ if name.endswith("_change"))
    return status if any(getattr(status, name) for name in changes) else None
