"""Transport coefficients from one kick of a cooling gas; `docs/impulse_response.md` derives it.

`kicks`: the displacement fields and fluxes; `response`: the simulation, a scene for the engine;
`integrals`: from fluxes to coefficients, on the host; `labels`: the labelled result. What a user
calls is `jdsmc.transport.navier_stokes`.
"""
