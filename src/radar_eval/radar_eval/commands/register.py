# SPDX-License-Identifier: Apache-2.0
"""`register`: bias in range and azimuth of a bag's plots against its truth, for the tracker to subtract."""

from __future__ import annotations

import argparse
import dataclasses

import numpy as np

from radar_common.health import Health
from radar_eval.asterix_records import NAUTICAL_MILE
from radar_eval.bag_tables import load_tables
from radar_eval.command_line import dropped_lines, not_negative, print_json, run
from radar_eval.registration import register


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(prog="register", description=__doc__)
    parser.add_argument("bag", help="bag with /radar/plots and /truth")
    parser.add_argument("--truth", metavar="BAG", help="bag to take /truth from instead")
    parser.add_argument(
        "--min-range",
        type=not_negative,
        default=10.0,
        metavar="NM",
        help="compare no plots nearer than this, where heights bias the ranges (default %(default)s)",
    )
    parser.add_argument("--json", action="store_true", help="print the biases for machines")
    return run(_register, parser.parse_args(argv))


def _register(arguments: argparse.Namespace) -> int:
    health = Health()
    tables = load_tables(arguments.bag, truth_path=arguments.truth, health=health)
    found = register(tables, nearest=arguments.min_range * NAUTICAL_MILE)
    if arguments.json:
        print_json(
            dataclasses.asdict(found)
            | {
                "parameters": {
                    "range_bias": found.range.value,
                    "azimuth_bias": found.azimuth.value,
                }
            }
        )
        return 0
    azimuth = [np.degrees(value) for value in dataclasses.astuple(found.azimuth)]
    print(f"{found.plots} plots of {found.targets} targets against their truth")
    print(
        f"range_bias: {found.range.value:.3f}  # m, standard error {found.range.standard_error:.2f}, "
        f"single plots {found.range.scatter:.1f}"
    )
    print(
        f"azimuth_bias: {found.azimuth.value:.7f}  # rad = {azimuth[0]:.4f} deg, standard error "
        f"{azimuth[1]:.4f} deg, single plots {azimuth[2]:.3f} deg"
    )
    for line in dropped_lines(health):
        print(line)
    return 0
