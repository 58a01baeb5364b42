# SPDX-License-Identifier: BSD-3-Clause
"""Plot of `./gimdem bench exchange`."""
from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from bench_plots import CROPPED, saved

Rows = list[dict[str, str]]


def draw(rows: Rows, folder: Path) -> Path:
    cases = list(dict.fromkeys(row["case"] for row in rows))
    with plt.rc_context(CROPPED):
        figure, panels = plt.subplots(1, len(cases), figsize=(4.2 * len(cases), 4.2), sharey=True, squeeze=False)
        for axes, case in zip(panels[0], cases):
            draw_case(axes, [row for row in rows if row["case"] == case])
            axes.set(title=case.replace("_", " "), xlabel="round trip [µs]", xlim=(0, None))
        panels[0][0].legend()
        return saved(figure, folder / "exchange.png")


def draw_case(axes: plt.Axes, rows: Rows) -> None:
    """A bar for each way, from the 10th to the 90th percentile a line; beside it ZeroMQ alone."""
    for shift, prefix, label in ((-0.2, "", "gimdem"), (0.2, "bare_", "ZeroMQ alone, the same bytes")):
        places = [place + shift for place in range(len(rows))]
        medians = [float(row[prefix + "us"]) for row in rows]
        spread = [[median - float(row[f"{prefix}us_p10"]) for median, row in zip(medians, rows)],
                  [float(row[f"{prefix}us_p90"]) - median for median, row in zip(medians, rows)]]
        axes.barh(places, medians, height=0.38, label=label, xerr=spread, error_kw={"linewidth": 0.6})
    axes.set_yticks(range(len(rows)), [f"{row['way'].replace('_', ' ')}\n{float(row['bytes']) / 1e6:.2f} MB" for row in rows],
                    fontsize=6)
    axes.invert_yaxis()
