"""Tables in Markdown from the measured numbers, and from nothing else."""

from jdsmc.estimate import format_estimate


def tables(data: dict) -> str:
    """The whole report; parts that were not measured are left out."""
    sections = [_head(data)]
    sections += [write(data[name]) for name, write in PARTS.items() if name in data]
    return "\n\n".join(sections) + "\n"


def grid(header: list[str], rows: list[list]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def spread(summary: dict, form: str = ".3g", scale: float = 1.0) -> str:
    """Median (least to largest)."""
    median, least, largest = (scale * summary[n] for n in ("median", "least", "largest"))
    return f"{median:{form}} ({least:{form}}–{largest:{form}})"


def _head(data: dict) -> str:
    machine = data["machine"]
    versions = ", ".join(f"{name} {version}" for name, version in machine.items())
    took = f"The run took {data['minutes']:.1f} minutes." if "minutes" in data else ""
    quick = "\n\n**Quick mode: tiny sizes, numbers without meaning.**" if data["quick"] else ""
    return (
        "# Homogeneous sheared gas: speed\n\n"
        "Made by `python -m benchmarks.shear`; what is measured and how is said in the modules of "
        "`benchmarks/`. Medians, in brackets the range of the repetitions. "
        f"{took}\n\nMachine: {versions}.{quick}"
    )


def _throughput(part: dict) -> str:
    lines = [
        "## Throughput on one core (α = 0.9, a τ0 = 4, steady)",
        "Turns are alternated; a speed ratio is jdsmc's collisions per second over the peer's of "
        "the same round: above 1 jdsmc is faster. Source: `throughput.py`.",
    ]
    for size in part["sizes"]:
        lines += [f"### N = {size['n_particles']:,}", _costs(size["rows"]), _ratios(size["pairs"])]
    return "\n\n".join(lines)


def _costs(rows: list[dict]) -> str:
    header = ["code", "contestant", "collisions/s", "ns/collision", "ns/candidate", "acceptance"]
    table = []
    for row in rows:
        candidate = row.get("ns_per_candidate")
        table.append(
            [
                row["code"],
                row["name"],
                spread(row["collisions_per_second"]),
                spread(row["ns_per_collision"]),
                spread(candidate) if candidate else "",
                f"{row['acceptance']:.3f}" if candidate else "",
            ]
        )
    return grid(header, table)


def _ratios(pairs: list[dict]) -> str:
    peers = list(dict.fromkeys(pair["peer"] for pair in pairs))
    ours = list(dict.fromkeys(pair["ours"] for pair in pairs))
    found = {(pair["ours"], pair["peer"]): spread(pair["speed_ratio"]) for pair in pairs}
    header = ["speed ratio against", *peers]
    return grid(header, [[one, *(found[one, rival] for rival in peers)] for one in ours])


def _precision(part: dict) -> str:
    percent = f"{100 * part['target']:g}%"
    reference = part["reference"]
    return "\n\n".join(
        [
            f"## Wall time until -P_xy/nT is known to {percent} (α = 0.7, a τ0 = 4)",
            "`jdsmc.run` at its defaults, 8 realizations, by its own rule. Source: `precision.py`.",
            _defaults(part["defaults"]),
            f"All methods on one core. Time to {percent}: warm-up + measurement, extrapolated as "
            "1/√time from the error reached (next column); compilation is not in it. Eight "
            "realizations (the peer: one after the other; two processes would need half). The "
            f"peer is given its warm-up, {part['warm_up']:.1f} collisions per particle. Bias: "
            f"from the reference {format_estimate(reference['value'], reference['error'])}. A "
            "step is shortened by jdsmc where a particle would be hit too often, hence `dt used`.",
            _methods(part["methods"], percent),
        ]
    )


def _defaults(defaults: dict) -> str:
    header = [
        *("cores", "first run, compiling (s)", "later runs (s)", "error reached"),
        *("warm-up (coll./particle)", "all (coll./particle)", "share outside the engine"),
    ]
    rows = [
        [
            name,
            f"{run['first_seconds']:.2f}",
            spread(run["seconds"]),
            spread(run["relative_error"], ".2g", 100) + "%",
            spread(run["warm_up_collisions"]),
            spread(run["collisions"]),
            spread(run["share_outside_engine"], ".0f", 100) + "%",
        ]
        for name, run in defaults.items()
    ]
    return grid(header, rows)


def _methods(methods: list[dict], percent: str) -> str:
    header = [
        *("code", "scheme", "dt/τ", "dt used", f"time to {percent} (s)", "of it warm-up (s)"),
        *("error reached", "-P_xy/nT", "bias", "compiling (s)"),
    ]
    rows = [
        [
            method["code"],
            method["splitting"],
            f"{method['time_step']:g}",
            f"{method['mean_step']:.3g}",
            f"{method['seconds_to_target']:.3g}",
            f"{method['warm_up_seconds']:.3g}",
            f"{100 * method['extrapolated_from']:.2g}%",
            format_estimate(method["value"], method["error"]),
            f"{100 * method['bias']:+.2f} ± {100 * method['bias_error']:.2f}%",
            f"{method['compile_seconds']:.1f}",
        ]
        for method in methods
    ]
    return grid(header, rows)


def _scaling(part: dict) -> str:
    lines = ["## Scaling (all cores, α = 0.9, a τ0 = 4)", "Source: `scaling.py`."]
    for name in ("particles", "realizations"):
        lines += [f"More {name}:", _sizes(part[name])]
    lines.append(
        "A sweep of α in one batch, N = 1000 x 4 realizations a point. The last row has the same "
        "number of points as the row before, at other values:"
    )
    header = ["points", "compiling (s)", "programs", "first chunk (s)", "later chunks (ms)"]
    rows = [
        [
            row["points"],
            f"{row['compile_seconds']:.2f}",
            row["programs"],
            f"{row['first_chunk_seconds']:.2f}",
            spread(row["seconds_per_chunk"], ".3g", 1e3),
        ]
        for row in part["sweep"]
    ]
    return "\n\n".join([*lines, grid(header, rows)])


def _sizes(rows: list[dict]) -> str:
    header = [
        *("N", "realizations", "s per chunk of 64 steps", "ns per particle-step"),
        *("peak memory (MB)", "bytes per particle added"),
    ]
    table = [
        [
            f"{row['n_particles']:,}",
            f"{row['realizations']:,}",
            spread(row["seconds_per_chunk"]),
            spread(row["ns_per_particle_step"]),
            f"{row['peak_bytes'] / 1e6:.0f}",
            f"{row['bytes_per_particle']:.0f}" if "bytes_per_particle" in row else "",
        ]
        for row in rows
    ]
    return grid(header, table)


def _startup(part: dict) -> str:
    names = {
        "python": "an empty Python process",
        "import": "`import jdsmc`",
        "compile": "of `jdsmc.run`: compiling",
        "run": "`jdsmc.run`, compiling included",
        "process": "fresh process from start to end",
    }
    rows = [[text, spread(part[name])] for name, text in names.items()]
    return "\n\n".join(
        [
            "## Time to the first result (all cores, α = 0.9, a τ0 = 4, defaults)",
            "Source: `startup.py`.",
            grid(["stage", "s"], rows),
        ]
    )


def _gpu(part: dict) -> str:
    title = "## Accelerator"
    if part["device"] is None:
        return f"{title}\n\nno accelerator"
    header = [
        *("contestant", "N", "gases", "particle-steps/s"),
        *("ms per chunk of 64 steps", "least traffic / bandwidth"),
    ]
    rows = [
        [
            row["name"],
            f"{row['n_particles']:,}",
            row["gases"],
            f"{row['particle_steps_per_second']:.3g}",
            spread(row["seconds_per_chunk"], ".3g", 1e3),
            f"{100 * row['share_of_bandwidth']:.2g}%",
        ]
        for row in part["rows"]
    ]
    bandwidth = f"{part['device']}, copies {part['bytes_per_second'] / 1e9:.0f} GB/s. "
    return "\n\n".join([title, bandwidth + "Source: `gpu.py`.", grid(header, rows)])


PARTS = {
    "throughput": _throughput,
    "precision": _precision,
    "scaling": _scaling,
    "startup": _startup,
    "gpu": _gpu,
}
