# SPDX-License-Identifier: Apache-2.0
"""How every node of the chain starts and ends."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

import rclpy
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ROSInterruptException,
)
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from radar_common.parameters import ParameterError

EXIT_BAD_PARAMETERS = 2


def run(create_node: Callable[[], Node], args: Sequence[str] | None = None) -> int:
    """Spin a node until it is interrupted.

    Args:
        create_node: makes the node; called once ROS is initialised.
        args: command line, None for that of the process.

    Returns:
        Exit code: 0 after an interrupt or a shutdown, 2 if the parameters are impossible.
    """
    rclpy.init(args=list(args) if args is not None else None)
    try:
        node = create_node()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException, ROSInterruptException):
        pass
    except (
        ParameterError,
        InvalidParameterTypeException,
        InvalidParameterValueException,
    ) as error:
        print(f"cannot start: {error}", file=sys.stderr)
        return EXIT_BAD_PARAMETERS
    finally:
        rclpy.try_shutdown()
    return 0
