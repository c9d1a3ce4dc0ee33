# SPDX-License-Identifier: Apache-2.0
"""Emitter filters by the name that the parameter `filter` gives them."""

from __future__ import annotations

from collections.abc import Callable

from bearing_tracker.emitters.bank import FilterBank
from bearing_tracker.emitters.corrections.extended import extended
from bearing_tracker.emitters.corrections.modified_polar import modified_polar
from bearing_tracker.emitters.corrections.pseudo_linear import pseudo_linear
from bearing_tracker.emitters.corrections.sigma_points import cubature, unscented
from bearing_tracker.emitters.interface import EmitterFilter, FilterSettings

DEFAULT_FILTER = "range_parameterised"

FILTERS: dict[str, Callable[[FilterSettings], EmitterFilter]] = {
    DEFAULT_FILTER: lambda settings: FilterBank(settings, extended, settings.range_bins),
    "range_parameterised_ckf": lambda settings: FilterBank(settings, cubature, settings.range_bins),
    "ekf": lambda settings: FilterBank(settings, extended),
    "modified_polar": lambda settings: FilterBank(settings, modified_polar),
    "ukf": lambda settings: FilterBank(settings, unscented),
    "ckf": lambda settings: FilterBank(settings, cubature),
    "pseudo_linear": lambda settings: FilterBank(settings, pseudo_linear),
}
"""Filters by name."""
