# SPDX-License-Identifier: Apache-2.0
"""`import_asterix`: a recording of CAT048 target reports becomes a bag of plots and truth."""

from __future__ import annotations

import argparse
import calendar
import datetime
import sys

import numpy as np

from radar_common.bag import STORAGES, BagWriter
from radar_common.health import Health
from radar_common.tables import NANOSECONDS
from radar_eval import asterix_import
from radar_eval.asterix_records import NAUTICAL_MILE, decode_records
from radar_eval.command_line import dropped_lines, not_negative, progress, run
from radar_eval.recording_file import data_blocks


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code.
    """
    return run(_import, _parser().parse_args(argv))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="import_asterix", description=__doc__)
    parser.add_argument("file", help="raw data blocks (.ast) or a network capture (.pcap)")
    parser.add_argument("--out", required=True, metavar="BAG", help="bag to write")
    parser.add_argument(
        "--psr",
        action="store_true",
        help="take primary positions (I048/040 + I048/130), the offset from the secondary radar "
        "removed; the secondary position becomes the truth",
    )
    parser.add_argument(
        "--keep-offset",
        action="store_true",
        help="leave that offset in, for `register` to find and the tracker to subtract",
    )
    parser.add_argument(
        "--false-plots", type=not_negative, default=0.0, metavar="N", help="to add a scan"
    )
    parser.add_argument("--seed", type=int, default=0, help="of the false plots (default 0)")
    parser.add_argument(
        "--min-range", type=not_negative, default=0.0, metavar="NM", help="take no nearer"
    )
    parser.add_argument("--radar", type=_radar, metavar="SAC/SIC", help="if there are several")
    parser.add_argument(
        "--date",
        type=_midnight,
        metavar="YYYY-MM-DD",
        help="of the first report (default: the day of the capture, or 1970-01-01)",
    )
    parser.add_argument("--storage", choices=sorted(STORAGES), default="mcap")
    return parser


def _radar(text: str) -> int:
    codes = [int(part) for part in text.split("/")]
    if len(codes) != 2 or not all(0 <= code < 256 for code in codes):
        raise argparse.ArgumentTypeError(f"{text!r} is not SAC/SIC, such as 20/129")
    return codes[0] * 256 + codes[1]


def _midnight(text: str) -> int:
    return calendar.timegm(datetime.date.fromisoformat(text).timetuple()) * NANOSECONDS


def _import(arguments: argparse.Namespace) -> int:
    # Asked first, so that nobody waits for a recording to be decoded before hearing that the bag exists.
    writer = BagWriter(arguments.out, storage=arguments.storage)
    health = Health()
    blocks = progress(data_blocks(arguments.file, health), "decoding", unit="blocks")
    recording = decode_records(blocks, health)
    options = asterix_import.ImportOptions(
        primary=arguments.psr,
        keep_offset=arguments.keep_offset,
        radar=arguments.radar,
        nearest=arguments.min_range * NAUTICAL_MILE,
        false_plots=arguments.false_plots,
        seed=arguments.seed,
        midnight=arguments.date,
    )
    imported = asterix_import.import_recording(recording, options)
    with writer:
        for topic, table in progress(asterix_import.messages(imported), "writing", unit="messages"):
            writer.write(topic, table)
    for line in _summary(imported, health, "kept" if arguments.keep_offset else "removed"):
        print(line, file=sys.stdout)
    return 0


def _summary(imported: asterix_import.ImportedRecording, health: Health, what: str) -> list[str]:
    lines = [
        f"{health.counts['target reports']} target reports, scan period "
        f"{imported.rotation.period:.4f} s",
        f"{len(imported.plots) - imported.false_plots} plots, {imported.false_plots} false plots "
        f"added, {len(imported.truth)} rows of truth",
    ]
    if imported.offset is not None:
        offset = imported.offset
        lines.append(
            f"primary minus secondary, {what}: {offset.range_bias:.1f} m, "
            f"{np.degrees(offset.azimuth_bias):.4f} deg; scatter from report to report "
            f"{offset.range_std:.1f} m, "
            f"{np.degrees(offset.azimuth_std):.3f} deg (1 sigma)"
        )
    return lines + dropped_lines(health)
