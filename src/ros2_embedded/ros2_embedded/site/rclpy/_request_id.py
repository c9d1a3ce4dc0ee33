# SPDX-License-Identifier: Apache-2.0
"""How requests and responses find each other.

As in rmw_cyclonedds, both begin with the number of the client's writer and the sequence
number of the request. All clients of a service see all its responses.
"""

from __future__ import annotations

import os
import struct
from typing import NamedTuple

_FORMAT = struct.Struct("<Qq")


class RequestId(NamedTuple):
    """Identity of a request.

    Attributes:
        client: Number of the client's writer.
        sequence_number: Number of the request at this client.
    """

    client: int
    sequence_number: int

    def pack(self) -> bytes:
        """Make the bytes that stand before the message.

        Returns:
            16 bytes.
        """
        return _FORMAT.pack(*self)

    @classmethod
    def unpack(cls, data: memoryview) -> RequestId:
        """Read the identity of a sample.

        Args:
            data: The sample with its header.

        Returns:
            The identity.
        """
        order = "<" if data[1] else ">"
        return cls(*struct.unpack_from(f"{order}Qq", data, 4))


#: Bytes of a packed identity.
SIZE = _FORMAT.size


def service_topics(service_name: str) -> tuple[str, str]:
    """Get the DDS topics of a service.

    Args:
        service_name: Full name of the service.

    Returns:
        The topics of requests and of responses.
    """
    return f"rq{service_name}Request", f"rr{service_name}Reply"


def new_identity(role: str) -> str:
    """Make the user data by which others pair the reader and the writer of an endpoint.

    Args:
        role: ``clientid`` or ``serviceid``.

    Returns:
        The entry.
    """
    return f"{role}={'.'.join(f'{byte:02x}' for byte in os.urandom(16))};"
