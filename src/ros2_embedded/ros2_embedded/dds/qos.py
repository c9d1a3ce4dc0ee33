# SPDX-License-Identifier: Apache-2.0
"""ROS quality of service to DDS and back, as rmw_cyclonedds maps it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from cyclonedds.core import Policy, Qos

if TYPE_CHECKING:
    from collections.abc import Mapping

INFINITE = 2**63 - 1
#: Duration that stands for "as the middleware likes".
UNSPECIFIED = 0


class HasNanoseconds(Protocol):
    """A duration."""

    @property
    def nanoseconds(self) -> int:
        """Length of the duration."""


class Profile(Protocol):
    """What is read of a quality-of-service profile; policies are numbered as in rmw."""

    @property
    def history(self) -> int:
        """0 default, 1 keep last, 2 keep all."""

    @property
    def depth(self) -> int:
        """Samples kept under keep last, 0 for the default."""

    @property
    def reliability(self) -> int:
        """0 default, 1 reliable, 2 best effort."""

    @property
    def durability(self) -> int:
        """0 default, 1 transient local, 2 volatile."""

    @property
    def lifespan(self) -> HasNanoseconds:
        """Age at which a sample is dropped."""

    @property
    def deadline(self) -> HasNanoseconds:
        """Longest time between samples."""

    @property
    def liveliness(self) -> int:
        """0 default, 1 automatic, 3 manual by topic."""

    @property
    def liveliness_lease_duration(self) -> HasNanoseconds:
        """Time after which a silent publisher counts as gone."""


def endpoint_qos(profile: Profile, user_data: str) -> Qos:
    """Map a profile to the policies of a DDS reader or writer.

    Args:
        profile: The ROS profile.
        user_data: Type hash and service identity, which other nodes read.

    Returns:
        The DDS policies.
    """
    if profile.history == 2:
        history: Any = Policy.History.KeepAll
    else:
        history = Policy.History.KeepLast(profile.depth or 1)
    policies = [
        history,
        Policy.Reliability.BestEffort
        if profile.reliability == 2
        else Policy.Reliability.Reliable(INFINITE),
        Policy.WriterDataLifecycle(autodispose=False),
        Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
        Policy.Userdata(user_data.encode()),
    ]
    if profile.durability == 1:
        policies.append(Policy.Durability.TransientLocal)
        policies.append(
            Policy.DurabilityService(
                cleanup_delay=0,
                history=history,
                max_samples=-1,
                max_instances=-1,
                max_samples_per_instance=-1,
            )
        )
    else:
        policies.append(Policy.Durability.Volatile)
    if profile.lifespan.nanoseconds != UNSPECIFIED:
        policies.append(Policy.Lifespan(profile.lifespan.nanoseconds))
    if profile.deadline.nanoseconds != UNSPECIFIED:
        policies.append(Policy.Deadline(profile.deadline.nanoseconds))
    lease = profile.liveliness_lease_duration.nanoseconds or INFINITE
    manual = profile.liveliness == 3
    policies.append(
        Policy.Liveliness.ManualByTopic(lease) if manual else Policy.Liveliness.Automatic(lease)
    )
    return Qos(*policies)


def profile_of(qos: Qos) -> dict[str, int]:
    """Map the policies of a discovered endpoint to those of a ROS profile.

    Args:
        qos: Policies as discovery reports them; history is not part of them.

    Returns:
        Policy numbers, and durations in nanoseconds, by the name of the ROS policy.
    """
    policies: Mapping[str, Any] = {policy.__scope__: policy for policy in qos}
    reliability = policies.get("Reliability")
    durability = policies.get("Durability")
    liveliness = policies.get("Liveliness")
    manual = isinstance(liveliness, Policy.Liveliness.ManualByTopic)
    return {
        "history": 3,
        "depth": 0,
        "reliability": 1 if isinstance(reliability, Policy.Reliability.Reliable) else 2,
        "durability": 1 if durability == Policy.Durability.TransientLocal else 2,
        "lifespan": _nanoseconds(policies.get("Lifespan"), "lifespan"),
        "deadline": _nanoseconds(policies.get("Deadline"), "deadline"),
        "liveliness": 3 if manual else 1,
        "liveliness_lease_duration": _nanoseconds(liveliness, "lease_duration"),
    }


def user_data_of(qos: Qos) -> dict[str, str]:
    """Read the ``key=value;`` pairs that ROS endpoints carry.

    Args:
        qos: Policies of a discovered endpoint or participant.

    Returns:
        The pairs; empty for an endpoint that is not of ROS.
    """
    data = next((policy.data for policy in qos if policy.__scope__ == "Userdata"), b"")
    pairs = (pair.partition("=") for pair in data.decode(errors="replace").split(";"))
    return {key: value for key, separator, value in pairs if separator}


def _nanoseconds(policy: Any, name: str) -> int:
    return INFINITE if policy is None else int(getattr(policy, name))
