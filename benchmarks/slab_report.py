"""The tables of `benchmarks.fourier`, from its raw numbers."""

import numpy as np

from .slab import PAPER


def tables(data: dict) -> str:
    """All of them, as Markdown."""
    parts = _throughput(data["throughput"]), _pairing(data["pairing"]), _precision(data)
    return "\n".join([_head(data), *parts])


def _head(data: dict) -> str:
    machine = ", ".join(f"{name} {value}" for name, value in data["machine"].items())
    return (
        "# Fourier flow: speed\n\nMade by `python -m benchmarks.fourier`; what is measured and how "
        "is said in `slab.py`. Medians, in brackets the range of the repetitions.\n\n"
        f"Machine: {machine}.\n"
    )


def _throughput(cases: list[dict]) -> str:
    lines = [
        "## One particle-step on one core\n",
        "| particles | realizations | dt/τ0 | sampled after | ns per particle-step |",
        "| --- | --- | --- | --- | --- |",
    ]
    for case in cases:
        lines.append(
            f"| {case['n_particles']:,} | {case['realizations']} | {case['time_step']:g} "
            f"| {case['steps']} | {_cell(case['nanoseconds'])} |"
        )
    return "\n".join(lines) + "\n"


def _pairing(cases: list[dict]) -> str:
    lines = [
        "## Partners in 100 layers, on one core\n",
        "Source: `pairing.py`; `seats` is what the library does.\n",
        "| way | particles | ns per particle |",
        "| --- | --- | --- |",
    ]
    for case in cases:
        cells = case["way"], f"{case['n_particles']:,}", _cell(case["nanoseconds"])
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _cell(time: dict) -> str:
    return f"{time['median']:.1f} ({time['least']:.1f}–{time['largest']:.1f})"


def _precision(data: dict) -> str:
    ours, target = data["ours"], data["target"]
    wall, value, error, warm_up = (
        np.array(ours[name][1:]) for name in ("seconds", "value", "error", "warm_up")
    )
    relative = np.sqrt(np.mean((error / value) ** 2))
    typical, share = np.median(wall), np.median(warm_up)
    needed = typical * (share + (1 - share) * (relative / target) ** 2)
    noise = np.sqrt(np.mean(np.square(ours["noise"][1:])))
    particle_time = (noise / target) ** 2
    rate = data["paper"]["seconds"]["median"]
    approach = PAPER["approach"] * PAPER["particles"]
    paper = rate * (approach + particle_time)
    return "\n".join(
        [
            f"## Wall time until κ* is known to {100 * target:g}%, two cores\n",
            "| way | seconds | of it approach | compiling |",
            "| --- | --- | --- | --- |",
            f"| ours at the defaults | {needed:.2f} | {typical * share:.2f} "
            f"| {ours['seconds'][0] - typical:.1f} |",
            f"| the paper's parameters, one run | {paper:.2f} | {rate * approach:.2f} | |",
            "",
            f"Ratio without compiling: {paper / needed:.1f}; with it "
            f"{paper / (needed + ours['seconds'][0] - typical):.1f}. A run of ours took "
            f"{typical:.2f} s, a share of {share:.2f} of its time was approach, and reached "
            f"{100 * relative:.2f}% (κ* = {np.mean(value):.4f}). One run in the paper, 1800 τ0 "
            f"after its approach, knows κ* to {100 * noise / np.sqrt(9e6):.2f}% by our noise.\n",
        ]
    )
