# SPDX-License-Identifier: Apache-2.0
"""`design`: from the radar's data and the wanted false plots to a detector and its predicted quality.

ros2 run primary_proc design --pfa 4e-3 --n0 11 --pattern sinc2 --detector 3/4-2
ros2 run primary_proc design --false-plots 10 --rings 1024 --pulses-per-scan 4096 --beamwidth-deg 1.4
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path

from primary_proc.calculators.pulse.target_models import TARGETS
from primary_proc.choices import METHODS, NORMALISERS
from primary_proc.design import requirements_for
from primary_proc.parameters import ExtractorParameters
from primary_proc.prediction import Prediction, predict_extractor
from radar_common.antenna_pattern import PATTERNS
from radar_common.frames import TWO_PI
from radar_common.parameters import from_file

_NODE_NAME = "plot_extractor"
_OVERRIDES = {
    "false_plots": "false_plots_per_scan",
    "detector": "detector",
    "normaliser": "normaliser",
    "beamwidth_deg": "beamwidth_deg",
    "pattern": "pattern",
    "target": "fluctuation",
}


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Args:
        argv: arguments; None takes those of the process.

    Returns:
        Exit code: 0, or 1 where the wanted rate is out of reach.
    """
    arguments = _parser().parse_args(argv)
    try:
        prediction = _predict(arguments)
        # Drawing is for people at a desk; a node's machine need not have matplotlib.
        if arguments.figures is not None:
            from primary_proc.figures.design_curves import draw_design

            draw_design(prediction, arguments.figures)
        if arguments.book_figures is not None:
            from primary_proc.figures.book_figures import draw_book_figures

            draw_book_figures(arguments.book_figures)
    except (ValueError, OSError, ImportError) as error:
        print(f"error: {' '.join(str(error).split())}", file=sys.stderr)
        return 1
    if arguments.json:
        print(json.dumps(prediction.as_dict(), indent=2))
    else:
        _print_table(prediction)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="design", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    rate = parser.add_mutually_exclusive_group()
    rate.add_argument(
        "--pfa", type=float, help="false starts per azimuth position of one range ring"
    )
    rate.add_argument("--false-plots", type=float, help="false plots in one turn over all cells")
    beam = parser.add_mutually_exclusive_group()
    beam.add_argument("--n0", type=float, help="pulses in a burst, N0 = 2 phi / step")
    beam.add_argument("--beamwidth-deg", type=float, help="one-way half-power beamwidth")
    parser.add_argument("--rings", type=int, default=1024, help="range cells")
    parser.add_argument("--pulses-per-scan", type=float, default=4096.0, help="pulses in one turn")
    parser.add_argument("--pattern", choices=tuple(PATTERNS), help="two-way antenna pattern")
    parser.add_argument("--target", choices=tuple(TARGETS), help="fluctuation designed for")
    parser.add_argument("--detector", help=f"a program l/m-k, or one of {', '.join(METHODS)}")
    parser.add_argument("--normaliser", choices=tuple(NORMALISERS), help="noise estimate")
    parser.add_argument(
        "--params", type=Path, help="parameter file of plot_extractor to start from"
    )
    parser.add_argument("--json", action="store_true", help="print for machines")
    parser.add_argument("--figures", type=Path, help="folder to draw the design's curves into")
    parser.add_argument(
        "--book-figures",
        type=Path,
        help="folder to draw the curves of Kuzmin 1967, chapter 3, into",
    )
    return parser


def _predict(arguments: argparse.Namespace) -> Prediction:
    parameters = ExtractorParameters()
    if arguments.params is not None:
        parameters = from_file(ExtractorParameters, arguments.params, _NODE_NAME)
    given = {
        field: getattr(arguments, option)
        for option, field in _OVERRIDES.items()
        if getattr(arguments, option) is not None
    }
    if arguments.detector is None and arguments.params is None:
        given["detector"] = "auto"
    parameters = parameters.changed(given)
    if arguments.rings < 1 or not arguments.pulses_per_scan > 0.0:
        raise ValueError("rings and pulses per scan must be positive")
    requirements = requirements_for(parameters, arguments.rings, TWO_PI / arguments.pulses_per_scan)
    if arguments.n0 is not None:
        gap = round(parameters.merge_gap * arguments.n0)
        requirements = replace(requirements, pulses=arguments.n0, gap=gap)
    if arguments.pfa is not None:
        # One ring without merging: false starts and false plots are then the same thing.
        wanted = arguments.pfa * requirements.pulses_per_scan
        requirements = replace(requirements, false_plots=wanted, rings=1, gap=0)
    return predict_extractor(parameters, requirements, arguments.rings)


def _print_table(prediction: Prediction) -> None:
    print(f"detector                      {prediction.detector}")
    print(f"pulses in a burst             {prediction.pulses_in_burst:.2f}")
    print(f"noise over first threshold    {prediction.noise_probability:.6g}")
    print(f"first threshold / sigma       {prediction.first_threshold:.4f}")
    print(f"false starts per position     {prediction.false_starts:.6g}")
    print(f"false plots per turn          {prediction.false_plots:.6g}")
    print(f"loss of the normaliser        {prediction.normaliser_loss_db:.2f} dB")
    print()
    targets = list(prediction.required_snr_db)
    head = "".join(f"{target:>16}" for target in targets)
    print(f"{'':<20}{head}")
    for wanted in prediction.required_snr_db[targets[0]]:
        cells = [prediction.required_snr_db[target][wanted] for target in targets]
        row = "".join(f"{'never' if cell is None else f'{cell:.2f} dB':>16}" for cell in cells)
        print(f"{f'SNR for P_d {wanted}':<20}{row}")
    print()
    print(f"{'SNR, dB':<20}{head}{'azimuth std':>16}")
    for quality in prediction.quality:
        row = "".join(f"{quality.detection[target]:>16.4f}" for target in targets)
        print(f"{quality.snr_db:<20g}{row}{f'{quality.azimuth_std_deg:.3f} deg':>16}")


if __name__ == "__main__":
    sys.exit(main())
