# SPDX-License-Identifier: Apache-2.0
"""The importable message packages: ``std_msgs``, ``std_msgs.msg``, ``std_srvs.srv`` and so on.

The modules have no files. A class is made when its name is first looked up in a module.
"""

from __future__ import annotations

from importlib.abc import Loader
from importlib.machinery import ModuleSpec
from typing import TYPE_CHECKING

from ros2_embedded.messages.classes import message_class, service_class
from ros2_embedded.messages.definitions import type_store

if TYPE_CHECKING:
    from types import ModuleType


def find_spec(fullname: str) -> ModuleSpec | None:
    """Find a module of a message package.

    Args:
        fullname: ``package``, ``package.msg``, ``package.srv`` or, as rosidl has a module
            for every type, ``package.msg._type_name``.

    Returns:
        The specification, or None if there is no such module.
    """
    package, _, rest = fullname.partition(".")
    kind, _, module = rest.partition(".")
    if kind and not type_names(package, kind):
        return None
    if module and module not in _modules_of_types(package, kind):
        return None
    return ModuleSpec(fullname, _Loader(), is_package=not module)


def type_names(package: str, kind: str) -> list[str]:
    """List the types of a package.

    Args:
        package: Name of the package.
        kind: ``msg`` or ``srv``.

    Returns:
        Names of the message or service types, without requests and responses.
    """
    prefix = f"{package}/{kind}/"
    known = type_store().fielddefs
    names = (name.removeprefix(prefix) for name in known if name.startswith(prefix))
    if kind == "srv":
        return [name.removesuffix("_Request") for name in names if name.endswith("_Request")]
    return list(names)


def _make_class(package: str, kind: str, name: str) -> type:
    ros_type = f"{package}/{kind}/{name}"
    if kind == "srv" and not name.endswith(("_Request", "_Response")):
        return service_class(ros_type)
    return message_class(ros_type)


def _modules_of_types(package: str, kind: str) -> dict[str, str]:
    return {
        _make_class(package, kind, name).__module__.rpartition(".")[2]: name
        for name in type_names(package, kind)
    }


class _Loader(Loader):
    """Fills the modules that have no files."""

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave the making of the module to the import system.

        Args:
            spec: Specification of the module.
        """

    def exec_module(self, module: ModuleType) -> None:
        """Fill a module.

        Args:
            module: The new module.
        """
        package, _, rest = module.__name__.partition(".")
        kind, _, type_module = rest.partition(".")
        if not kind:
            return
        names = type_names(package, kind)
        if type_module:
            names = [_modules_of_types(package, kind)[type_module]]
        if kind == "srv":
            names += [f"{name}_{half}" for name in names for half in ("Request", "Response")]

        def get_class(name: str) -> type:
            if name not in names:
                raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
            cls = _make_class(package, kind, name)
            setattr(module, name, cls)
            return cls

        module.__dict__.update(
            __all__=sorted(names), __getattr__=get_class, __dir__=lambda: sorted(names)
        )
