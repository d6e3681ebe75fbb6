"""The public names, page by page of the reference."""

import importlib
import inspect
import pkgutil
from types import ModuleType
from typing import Any, NamedTuple

import jdsmc
from jdsmc import fit, gases, random, results, scenarios, theory, transport
from jdsmc.results import gravity_effect


class Part(NamedTuple):
    """A page: its title, what stands first, and what it is about by the names users write."""

    title: str
    intro: str
    things: dict[str, Any]


def of(module: ModuleType, *names: str) -> dict[str, Any]:
    """Some names of a module."""
    return {f"{module.__name__}.{name}": getattr(module, name) for name in names}


def functions(module: ModuleType) -> dict[str, Any]:
    """Everything public that is written in a module."""
    return {
        f"{module.__name__}.{name}": thing
        for name, thing in vars(module).items()
        if not name.startswith("_")
        and (inspect.isfunction(thing) or inspect.isclass(thing))
        and thing.__module__ == module.__name__
    }


SCENES = tuple(scene.__name__ for scene in scenarios.SCENES)
BASES = [name for name in scenarios.__all__ if name not in (*SCENES, "SCENES")]

PARTS = {
    "run": Part(
        "Running",
        "Everything a simulation takes, what it returns and what it raises.",
        of(
            jdsmc,
            "run",
            "resume",
            "merge",
            "join_hosts",
            "sensitivity",
            "NotSteadyError",
            "FaultError",
        ),
    ),
    "scenes": Part(
        "Scenes",
        "Classes of `jdsmc.scenarios`. Every physical number may be an array, which is swept. What "
        "each reports: [](../observables.md).",
        of(scenarios, *SCENES),
    ),
    "gases": Part(
        "Gases",
        "The physics of one pair. Every physical number may be an array, which is swept.",
        of(jdsmc, *(name for name in gases.__all__ if name != "AbstractGas")),
    ),
    "results": Part(
        "Results and estimates",
        "What runs return: labelled, with an error on every number.",
        of(jdsmc, "Result", "load", "Estimate", "combine", "Sensitivity", "Derivative")
        | of(results, "join_gases")
        | of(gravity_effect, "at_equal_gradient"),
    ),
    "transport": Part(
        "Transport coefficients",
        transport.__doc__ or "",
        of(transport, "navier_stokes", "resume", "linear_response"),
    ),
    "fit": Part("Calibration", fit.__doc__ or "", of(fit, *fit.__all__)),
    "own": Part(
        "Gases and scenes of your own",
        "What they derive from and are made of. Examples: [](../own_gas.md), [](../own_scene.md).",
        of(jdsmc, "AbstractGas", "number", "choice", "count", "Observable")
        | of(scenarios, *BASES)
        | of(random, "Stream", "normals", "bits", "three_uniforms", "permutation"),
    ),
}

THEORY = {
    name: importlib.import_module(f"{theory.__name__}.{name}")
    for _, name, _ in pkgutil.iter_modules(theory.__path__)
}
"""Modules of kinetic theory, each a part of one page."""
