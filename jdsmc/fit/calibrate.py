"""The call that calibrates a model gas."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .. import check
from .. import sweep as sweeps
from ..errors import unbroken
from ..estimate import Estimate
from ..results.result import Result
from ..running.checkpoint import check_none
from ..running.run import run
from ..scenarios import AbstractScene
from .elastic import matches, scales
from .elastic_curve import elastic_sweep, law
from .labelled import labelled
from .newton import newton
from .numbers import check_model
from .targets import FREE, SERIES, Target, check_free, nearest, targets_of
from .transient import transient

USUAL = {"n_particles": 4096, "rtol": 1e-3}
"""Of what is run, if nothing else is said: β to 1%. Small gases, as most of a run is warm-up; what
4096 particles change is the same in both gases, and a tenth of the error."""


def calibrate(
    reference: Result | AbstractScene | Mapping[str, Any],
    model: AbstractScene,
    target: str | Sequence[str] = "shear_stress",
    weights: Sequence[float] | Mapping[str, float] | None = None,
    free: str | Sequence[str] | None = None,
    *,
    sweep: Result | None = None,
    **options,
) -> Result:
    """Numbers of a model gas, rate and drag of an elastic one, that make it do what another does.

    Arguments:
        reference: a result or a scene (which is run), of one gas or swept over its restitution; or
            numbers {name: Estimate}, at each restitution of the model.
        model: a scene whose free numbers are adjusted. For `UniformShear` of `ElasticHardSpheres`
            the exact scaling serves all restitutions by one sweep; any other is fitted at one
            point, by Newton's method with `jdsmc.sensitivity`.
        target: names of observables (docs/observables.md). A text as on the command line: a comma
            separates fits, a plus joins observables in one; a list is one joint fit. The name
            `series/temperature` is a whole transient from the same start, at one point: least
            squares over the series of a swept model.
        weights: of the relative misfits of a joint fit, in order or by name; all 1.
        free: names of numbers of the gas or the scene; by default `rate_factor`, and `drag_factor`
            too for a list of two or more.
        sweep: a result of the scene `elastic_sweep(model, restitution)`, which is run otherwise.
        options: of `jdsmc.run`, for whatever is run; 4096 particles and rtol = 0.001 if not said.
    Returns: a `Result` with the free numbers and `misfit`, the root of the mean square of the
    relative deviations left (%), each with its error, over `restitution` and `target`. Where
    nothing matches there is NaN, and a remark says what comes nearest. Errors hold those of both
    gases.
    Raises ValueError or TypeError for bad input, before anything is run, and what `run` raises;
    after Ctrl-C `jdsmc.errors.Interrupted`, a KeyboardInterrupt with the `.result` of its run.
    """
    fits = targets_of(target, weights)
    free = _free(free, target, fits)
    check_model(model, free)
    scaled = scales(model, free) and not fits[0].of_series
    elastic: Any = model
    for fit in fits:
        check_free(free, fit)
        check_names(model, fit, scaled)
    alpha: Any = None if "restitution" in free else restitutions(reference, model)
    names = list(dict.fromkeys(name for fit in fits for name in fit.names))
    if not isinstance(sweep, Result | None):
        raise TypeError(f"sweep must be a result of elastic_sweep(model, ...), got {sweep!r}.")
    options = USUAL | options
    check_none(options, "a calibration")
    if fits[0].of_series:
        return _transients(reference, model, fits, free, options)
    if not scaled and alpha is not None and len(alpha) > 1:
        raise ValueError(
            f"only free numbers {' and '.join(FREE)} of a sheared elastic gas are fitted over a "
            "sweep; give one restitution."
        )
    swept = elastic_sweep(elastic, alpha) if scaled else None
    if not isinstance(reference, AbstractScene):
        _wanted(reference, names[0], 1 if alpha is None else len(alpha))
    if isinstance(reference, AbstractScene):
        reference = unbroken(run(reference, **options))
    wanted = {name: _wanted(reference, name, 1 if alpha is None else len(alpha)) for name in names}
    if swept is not None and alpha is not None:
        made = unbroken(run(swept, **options)) if sweep is None else sweep
        found = matches(alpha, fits, free, wanted, elastic, made)
        how = f"the elastic gas: {made.attrs['stopped']}"
    else:
        for name, each in wanted.items():
            if not np.all(np.isfinite(each[0].value)):
                raise ValueError(f"the reference has no steady {name}, which is {each[0].value}.")
        ends = [newton(model, free, f, [wanted[n][0] for n in f.names], options) for f in fits]
        found, made = [match for match, _ in ends], ends[-1][1]
        how = f"Newton's method ended: {made.attrs['stopped']}"
    return labelled(alpha, fits, free, found, model, reference, made, how)


def _transients(reference, model, fits: list[Target], free, options: dict) -> Result:
    if len(sweeps.points(model)[0]) > 1:
        raise ValueError("transients are fitted at one point; give one restitution.")
    if isinstance(reference, AbstractScene):
        if "duration" not in options:
            raise ValueError("a transient needs duration, the time (τ0) for which it is followed.")
        reference = unbroken(run(reference, **options))
    if not isinstance(reference, Result):
        raise TypeError("the reference of a transient must be a scene or a result.")
    ends = [transient(model, free, fit, reference, options) for fit in fits]
    how = f"least squares over time series: {ends[-1][1].attrs['stopped']}"
    found = [match for match, _ in ends]
    return labelled(None, fits, free, found, model, reference, ends[-1][1], how)


def _free(free, target, fits: list[Target]) -> tuple[str, ...]:
    if free is None:
        several = not isinstance(target, str) and len(fits[0].names) > 1
        return FREE if several else FREE[:1]
    names = (free,) if isinstance(free, str) else free
    if not isinstance(names, list | tuple) or not all(isinstance(one, str) for one in names):
        raise TypeError(f"free = {free!r} is neither the name of a number nor a tuple of names.")
    if len(set(names)) < len(names):
        raise ValueError(f"free = {free!r} names a number twice; name each once.")
    return tuple(names)


def check_names(model: AbstractScene, fit: Target, scaled: bool) -> None:
    """Raise ValueError for observables that the model does not have or the fit cannot use."""
    known = [one.name for one in (*model.reports, *model.evolves) if not one.dims]
    for name in fit.names:
        if scaled:
            law(name)
        plain = name.removeprefix(SERIES)
        if plain not in known:
            raise ValueError(
                f"target {plain!r} is unknown{nearest(plain, known)}; choose from "
                f"{', '.join(known)}."
            )


def restitutions(reference, model: AbstractScene) -> np.ndarray | None:
    """The α of both, (points,), None for a model without; ValueError where they differ."""
    known = sweeps.parameters(model).get("restitution")
    own = None if known is None else np.atleast_1d(np.asarray(known, float))
    if isinstance(reference, AbstractScene):
        swept = sweeps.dimensions(reference)
        theirs = sweeps.parameters(reference).get("restitution")
    elif isinstance(reference, Result):
        swept = {name: reference.steady[name].values for name in reference.dims}
        theirs = swept.get("restitution", reference.attrs.get("parameter_restitution"))
    elif isinstance(reference, Mapping):
        return own
    else:
        raise TypeError(
            "reference must be a result, a scene or numbers {name: Estimate}, got "
            f"{type(reference).__name__}."
        )
    others = [name for name in swept if name != "restitution"]
    if others:
        raise ValueError(
            f"the reference is swept over {', '.join(others)}; take one value with "
            "result.at(...), or sweep its restitution alone."
        )
    if own is not None and theirs is not None and not np.array_equal(np.atleast_1d(theirs), own):
        raise ValueError(
            "reference and model must have the same restitution, here "
            f"{np.asarray(theirs)} and {np.asarray(known)}."
        )
    return own


def _wanted(reference, name: str, count: int) -> list[Estimate]:
    """What is to be matched, at every restitution."""
    if name not in reference:
        there = ", ".join(reference) or "no steady values"
        raise ValueError(f"the reference has no {name!r}; it has {there}.")
    one = reference[name]
    if not isinstance(one, Estimate):
        given = check.physical(one)
        if not isinstance(given, np.ndarray):
            raise TypeError(
                f"{name} = {one!r} of the reference is neither a number nor an Estimate."
            )
        one = Estimate(given, 0.0 * given)
    if not np.all(np.isfinite(one.error) | np.isnan(one.value)):
        raise ValueError(f"{name} of the reference has the error {one.error}; give a finite one.")
    if np.any(np.asarray(one.value) == 0.0):
        raise ValueError(f"{name} of the reference is 0, and misfits are relative; fit another.")
    if np.ndim(one.value) == 0:
        return [one] * count
    if np.shape(one.value) != (count,):
        raise ValueError(
            f"{name} of the reference has the shape {np.shape(one.value)}; it must have one value "
            f"for each of the {count} restitutions."
        )
    return [one[k] for k in range(count)]
