# SPDX-License-Identifier: Apache-2.0
"""Writers and readers of whole samples as CDR bytes."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader

from ros2_embedded.dds import library
from ros2_embedded.dds.library import ANY_STATE, check, delete_entity
from ros2_embedded.dds.participant import Participant
from ros2_embedded.dds.qos import Profile, endpoint_qos
from ros2_embedded.messages.codec import type_hash

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class SampleOrigin:
    """Where and when a sample was written.

    Attributes:
        source_timestamp: Time of writing, nanoseconds since 1970.
        publication_handle: Local handle of the writer.
    """

    source_timestamp: int
    publication_handle: int


class Writer:
    """Writes samples to a topic."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        ros_type: str,
        profile: Profile,
        *,
        user_data: str = "",
        with_request_id: bool = False,
    ) -> None:
        """Create a DDS writer.

        Args:
            participant: Participant that owns it.
            topic: DDS name of the topic.
            ros_type: Message type.
            profile: Quality of service.
            user_data: Entries of the user data before the type hash.
            with_request_id: True for the topics of services.

        Raises:
            cyclonedds.core.DDSException: DDS refuses the policies or the type.
        """
        qos = endpoint_qos(profile, f"{user_data}typehash={type_hash(ros_type)};")
        dds_topic = participant.topic(topic, ros_type, with_request_id)
        self.entity = DataWriter(participant.publisher, dds_topic, qos)
        self.gid = bytes(self.entity.guid.bytes)
        self.handle = int(self.entity._ref)

    @property
    def instance_handle(self) -> int:
        """Number that names the writer in this participant."""
        number = ct.c_uint64()
        check(library.instance_handle(self.handle, ct.byref(number)), "identify a writer")
        return number.value

    def write(self, data: bytearray) -> None:
        """Send a sample; waits while a reliable reader's history is full.

        Args:
            data: CDR with its header, padded to a multiple of four bytes.

        Raises:
            DdsError: The writer is gone, or the data are not of the topic's type.
        """
        pointer = ct.addressof(ct.c_char.from_buffer(data))
        sample = library.CdrSample(pointer, len(data))
        check(library.write(self.handle, ct.byref(sample)), "publish")

    def matched_count(self) -> int:
        """Count the readers that receive from this writer.

        Returns:
            The number of readers.

        Raises:
            DdsError: The writer is gone.
        """
        return check(library.matched_readers(self.handle, None, 0), "count the subscriptions")

    def wait_for_acks(self, timeout: int) -> bool:
        """Wait until every reliable reader has everything.

        Args:
            timeout: Nanoseconds to wait at most.

        Returns:
            False after the timeout.

        Raises:
            DdsError: The writer is gone.
        """
        timed_out = -10
        result = library.wait_for_acks(self.handle, timeout)
        return result != timed_out and check(result, "wait for acknowledgements") == 0

    def assert_liveliness(self) -> None:
        """Declare the writer alive.

        Raises:
            DdsError: The writer is gone.
        """
        check(library.assert_liveliness(self.handle), "assert liveliness")

    def close(self) -> None:
        """Delete the writer; a second time does nothing."""
        delete_entity(self.entity)


class Reader:
    """Takes samples of a topic."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        ros_type: str,
        profile: Profile,
        *,
        user_data: str = "",
        with_request_id: bool = False,
    ) -> None:
        """Create a DDS reader.

        Args:
            participant: Participant that owns it.
            topic: DDS name of the topic.
            ros_type: Message type.
            profile: Quality of service.
            user_data: Entries of the user data before the type hash.
            with_request_id: True for the topics of services.

        Raises:
            cyclonedds.core.DDSException: DDS refuses the policies or the type.
        """
        qos = endpoint_qos(profile, f"{user_data}typehash={type_hash(ros_type)};")
        dds_topic = participant.topic(topic, ros_type, with_request_id)
        self.entity = DataReader(participant.subscriber, dds_topic, qos)
        self.gid = bytes(self.entity.guid.bytes)
        self.handle = int(self.entity._ref)
        condition = library.create_read_condition(self.handle, ANY_STATE)
        #: Handle of the condition that holds while there is something to take.
        self.condition = check(condition, "create a read condition")

    def take(self, convert: Callable[[memoryview], T]) -> tuple[T, SampleOrigin] | None:
        """Take the next sample, if there is one.

        Args:
            convert: Gets the sample as CDR with its header, in memory that is valid only
                during the call, and makes the result of it.

        Returns:
            The converted sample and its origin, or None.

        Raises:
            DdsError: The reader is gone.
        """
        sample = ct.c_void_p()
        info = library.SampleInfo()
        while True:
            count = library.take_cdr(self.handle, ct.byref(sample), 1, ct.byref(info), ANY_STATE)
            if check(count, "take") == 0:
                return None
            try:
                # Samples without data tell only that a writer has gone.
                if info.valid_data:
                    origin = SampleOrigin(info.source_timestamp, info.publication_handle)
                    return _convert(sample, convert), origin
            finally:
                library.serdata_release(sample)

    def matched_count(self) -> int:
        """Count the writers that this reader receives from.

        Returns:
            The number of writers.

        Raises:
            DdsError: The reader is gone.
        """
        return check(library.matched_writers(self.handle, None, 0), "count the publishers")

    def close(self) -> None:
        """Delete the reader; a second time does nothing."""
        delete_entity(self.entity)


def _convert(sample: ct.c_void_p, convert: Callable[[memoryview], T]) -> T:
    size = library.serdata_size(sample)
    buffer = library.Buffer()
    borrowed = library.serdata_borrow(sample, 0, size, ct.byref(buffer))
    try:
        memory = (ct.c_ubyte * size).from_address(buffer.data)
        return convert(memoryview(memory).cast("B"))
    finally:
        library.serdata_return(borrowed, ct.byref(buffer))
