# SPDX-License-Identifier: Apache-2.0
"""The C functions of Cyclone DDS that its Python package does not offer.

They write and take whole samples as CDR bytes, and ctypes lets other threads run
meanwhile. (``ddspy_write`` keeps the interpreter lock inside a blocking write, which can
stop the acknowledgements it waits for.)
"""

from __future__ import annotations

import ctypes as ct
from typing import TYPE_CHECKING, Any

from cyclonedds.core import Entity
from cyclonedds.internal import DDS, dds_c_t

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

SampleInfo = dds_c_t.sample_info

#: Samples in any sample, view and instance state.
ANY_STATE = 0x7F

INFINITE = 2**63 - 1


class DdsError(RuntimeError):
    """A DDS operation failed."""


class CdrSample(ct.Structure):
    """A sample as the Python package's DDS type plug-in takes it."""

    _fields_ = (("data", ct.c_void_p), ("size", ct.c_size_t))


class Buffer(ct.Structure):
    """A piece of memory (``ddsrt_iovec_t``)."""

    _fields_ = (("data", ct.c_void_p), ("size", ct.c_size_t))


def _function(name: str, result: Any, arguments: Sequence[Any]) -> Callable[..., int]:
    function = getattr(DDS._dll_handle, name)
    # A copy of its own: the Python package sets other argument types on the shared one.
    prototype = ct.CFUNCTYPE(result, *arguments)
    return prototype(ct.cast(function, ct.c_void_p).value or 0)


_ENTITY = ct.c_int32
write = _function("dds_write", ct.c_int32, [_ENTITY, ct.c_void_p])
take_cdr = _function(
    "dds_takecdr",
    ct.c_int32,
    [_ENTITY, ct.POINTER(ct.c_void_p), ct.c_uint32, ct.POINTER(SampleInfo), ct.c_uint32],
)
serdata_size = _function("ddsi_serdata_size", ct.c_uint32, [ct.c_void_p])
serdata_borrow = _function(
    "ddsi_serdata_to_ser_ref",
    ct.c_void_p,
    [ct.c_void_p, ct.c_size_t, ct.c_size_t, ct.POINTER(Buffer)],
)
serdata_return = _function("ddsi_serdata_to_ser_unref", None, [ct.c_void_p, ct.POINTER(Buffer)])
serdata_release = _function("ddsi_serdata_unref", None, [ct.c_void_p])
wait_for_acks = _function("dds_wait_for_acks", ct.c_int32, [_ENTITY, ct.c_int64])
assert_liveliness = _function("dds_assert_liveliness", ct.c_int32, [_ENTITY])
matched_readers = _function(
    "dds_get_matched_subscriptions", ct.c_int32, [_ENTITY, ct.c_void_p, ct.c_size_t]
)
matched_writers = _function(
    "dds_get_matched_publications", ct.c_int32, [_ENTITY, ct.c_void_p, ct.c_size_t]
)
set_status_mask = _function("dds_set_status_mask", ct.c_int32, [_ENTITY, ct.c_uint32])
instance_handle = _function(
    "dds_get_instance_handle", ct.c_int32, [_ENTITY, ct.POINTER(ct.c_uint64)]
)
create_read_condition = _function("dds_create_readcondition", _ENTITY, [_ENTITY, ct.c_uint32])
create_guard = _function("dds_create_guardcondition", _ENTITY, [_ENTITY])
set_guard = _function("dds_set_guardcondition", ct.c_int32, [_ENTITY, ct.c_bool])
take_guard = _function("dds_take_guardcondition", ct.c_int32, [_ENTITY, ct.POINTER(ct.c_bool)])
create_waitset = _function("dds_create_waitset", _ENTITY, [_ENTITY])
waitset_attach = _function("dds_waitset_attach", ct.c_int32, [_ENTITY, _ENTITY, ct.c_ssize_t])
waitset_detach = _function("dds_waitset_detach", ct.c_int32, [_ENTITY, _ENTITY])
waitset_wait = _function(
    "dds_waitset_wait",
    ct.c_int32,
    [_ENTITY, ct.POINTER(ct.c_ssize_t), ct.c_size_t, ct.c_int64],
)
delete_handle = _function("dds_delete", ct.c_int32, [_ENTITY])


def status_function(name: str, structure: type[ct.Structure]) -> Callable[..., int]:
    """Get a function that reads and clears a status.

    Args:
        name: Its name in C.
        structure: What it fills.

    Returns:
        The function of an entity's handle and a pointer to the structure.
    """
    return _function(name, ct.c_int32, [_ENTITY, ct.POINTER(structure)])


def check(result: int, action: str) -> int:
    """Raise if a C function failed.

    Args:
        result: What the function returned.
        action: What was tried, for the message.

    Returns:
        The result.

    Raises:
        DdsError: The result is an error code.
    """
    if result < 0:
        raise DdsError(f"failed to {action}: DDS error {result}")
    return result


def delete_entity(entity: Entity) -> None:
    """Delete a DDS entity now, not when its Python object goes; a second time does nothing.

    Args:
        entity: The entity.
    """
    if Entity._entities.pop(entity._ref, None) is not None:
        delete_handle(entity._ref)
