# SPDX-License-Identifier: Apache-2.0
"""The log of a node on the topic ``/rosout``."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from rcl_interfaces.msg import Log
from rclpy.duration import Duration
from rclpy.impl.log_output import LogRecord, log_output
from rclpy.qos import DurabilityPolicy, QoSProfile

from ros2_embedded.dds.endpoints import Writer
from ros2_embedded.dds.library import DdsError
from ros2_embedded.dds.participant import Participant
from ros2_embedded.messages.codec import serialize

_TYPE = "rcl_interfaces/msg/Log"
_PROFILE = QoSProfile(
    depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(seconds=10)
)


class Rosout:
    """Publishes what the logger of a node and its children log."""

    def __init__(self, participant: Participant, topic: str, logger_name: str) -> None:
        """Begin to publish.

        Args:
            participant: Participant of the node.
            topic: Full name of the topic, ``/rosout`` unless remapped.
            logger_name: Logger of the node.
        """
        self.writer = Writer(participant, f"rt{topic}", _TYPE, _PROFILE)
        self._logger_name = logger_name
        log_output.subscribe(logger_name, self._publish)

    def close(self) -> None:
        """Stop publishing."""
        log_output.unsubscribe(self._logger_name, self._publish)
        self.writer.close()

    def _publish(self, record: LogRecord) -> None:
        seconds, nanoseconds = divmod(record.nanoseconds, 10**9)
        message = Log(
            stamp=Time(sec=seconds, nanosec=nanoseconds),
            level=int(record.severity),
            name=record.name,
            msg=record.message,
            file=record.file,
            function=record.function,
            line=record.line,
        )
        try:
            self.writer.write(serialize(message))
        except DdsError:
            return  # The context was shut down; the console has the message.
