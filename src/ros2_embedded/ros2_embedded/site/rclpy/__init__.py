# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 client library for Python, for machines without ROS 2.

A program calls :func:`init`, creates nodes, lets their callbacks run by :func:`spin` or an
executor, and calls :func:`shutdown`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.signals import (
    SignalHandlerOptions,
    install_signal_handlers,
    uninstall_signal_handlers,
)
from rclpy.utilities import get_default_context
from rclpy.utilities import (
    get_rmw_implementation_identifier as get_rmw_implementation_identifier,
)
from rclpy.utilities import ok as ok
from rclpy.utilities import shutdown as _shutdown
from rclpy.utilities import try_shutdown as try_shutdown

if TYPE_CHECKING:
    from rclpy.executors import Executor
    from rclpy.node import Node
    from rclpy.parameter import Parameter
    from rclpy.task import Future

_global_executor: Executor | None = None


def init(
    *,
    args: list[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> None:
    """Join a ROS domain.

    Args:
        args: Command line with ROS arguments; None for that of the program.
        context: Context to initialise; None for the default one.
        domain_id: The domain; None to take it from ``ROS_DOMAIN_ID``.
        signal_handler_options: Signals that end spinning; None for SIGINT and SIGTERM with
            the default context, and none with another.

    Raises:
        RuntimeError: The context was initialised before, the domain does not exist or
            cannot be joined, or a ROS argument is wrong.
    """
    is_default = context is None or context is get_default_context()
    context = context or get_default_context()
    if signal_handler_options is None:
        signal_handler_options = SignalHandlerOptions.ALL if is_default else SignalHandlerOptions.NO
    context.init(args, domain_id=domain_id)
    install_signal_handlers(signal_handler_options)


def get_global_executor() -> Executor:
    """Get the executor that the functions of this module use.

    Returns:
        A single-threaded executor of the default context.
    """
    global _global_executor
    if _global_executor is None:
        from rclpy.executors import SingleThreadedExecutor

        executor = _global_executor = SingleThreadedExecutor()

        def reset_executor() -> None:
            global _global_executor
            executor.shutdown()
            _global_executor = None

        get_default_context().on_shutdown(reset_executor)
    return _global_executor


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Leave the domain.

    Args:
        context: Context to shut down; None for the default one.
        uninstall_handlers: Whether signals do again what they did before; None for yes with
            the default context, and no with another.

    Raises:
        RuntimeError: The context is not initialised, or was shut down before.
    """
    is_default = context is None or context is get_default_context()
    _shutdown(context=context)
    if uninstall_handlers or (uninstall_handlers is None and is_default):
        uninstall_signal_handlers()


def create_node(
    node_name: str,
    *,
    context: Context | None = None,
    cli_args: list[str] | None = None,
    namespace: str | None = None,
    use_global_arguments: bool = True,
    enable_rosout: bool = True,
    start_parameter_services: bool = True,
    parameter_overrides: list[Parameter[Any]] | None = None,
    allow_undeclared_parameters: bool = False,
    automatically_declare_parameters_from_overrides: bool = False,
    enable_logger_service: bool = False,
) -> Node:
    """Create a node; the arguments are those of :class:`rclpy.node.Node`.

    Args:
        node_name: Name of the node.
        context: Context it belongs to; None for the default one.
        cli_args: Command line with ROS arguments for this node only.
        namespace: Namespace of the node.
        use_global_arguments: Whether the command line of the program counts.
        enable_rosout: Whether to publish the log on ``/rosout``.
        start_parameter_services: Whether to let others get and set parameters.
        parameter_overrides: Values for parameters, stronger than the command line.
        allow_undeclared_parameters: Whether parameters need not be declared.
        automatically_declare_parameters_from_overrides: Whether to declare all parameters
            that have values from outside.
        enable_logger_service: Whether to let others get and set logger levels.

    Returns:
        The node.
    """
    from rclpy.node import Node

    return Node(
        node_name,
        context=context,
        cli_args=cli_args,
        namespace=namespace,
        use_global_arguments=use_global_arguments,
        enable_rosout=enable_rosout,
        start_parameter_services=start_parameter_services,
        parameter_overrides=parameter_overrides,
        allow_undeclared_parameters=allow_undeclared_parameters,
        automatically_declare_parameters_from_overrides=(
            automatically_declare_parameters_from_overrides
        ),
        enable_logger_service=enable_logger_service,
    )


def spin_once(
    node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Run one callback of a node.

    Args:
        node: The node.
        executor: Executor to use; None for the global one.
        timeout_sec: Longest wait in seconds; None or negative for any.

    Raises:
        ExternalShutdownException: The context was shut down.
    """
    executor = executor or get_global_executor()
    try:
        executor.add_node(node)
        executor.spin_once(timeout_sec=timeout_sec)
    finally:
        executor.remove_node(node)


def spin(node: Node, executor: Executor | None = None) -> None:
    """Run the callbacks of a node until the context is shut down.

    Args:
        node: The node.
        executor: Executor to use; None for the global one.

    Raises:
        ExternalShutdownException: The context was shut down from outside while waiting.
    """
    executor = executor or get_global_executor()
    try:
        executor.add_node(node)
        while executor.context.ok():
            executor.spin_once()
    finally:
        executor.remove_node(node)


def spin_until_future_complete(
    node: Node,
    future: Future[Any],
    executor: Executor | None = None,
    timeout_sec: float | None = None,
) -> None:
    """Run the callbacks of a node until a future is done.

    Args:
        node: The node.
        future: The future.
        executor: Executor to use; None for the global one.
        timeout_sec: Longest wait in seconds; None or negative for any.

    Raises:
        ExternalShutdownException: The context was shut down.
    """
    executor = executor or get_global_executor()
    added = False
    try:
        added = executor.add_node(node)
        executor.spin_until_future_complete(future, timeout_sec)
    finally:
        if added:
            executor.remove_node(node)
