"""Make the pictures of the README: `python docs/make_pictures.py`."""

from pathlib import Path

import matplotlib

import jdsmc


def main() -> None:
    """The demo's picture, as the command line draws it."""
    matplotlib.use("agg")
    scene = jdsmc.scenarios.UniformShear(jdsmc.InelasticHardSpheres(0.9), shear_rate=4.0)
    result = jdsmc.run(scene, seed=0)
    result.plot(Path(__file__).parent / "sheared_gas.png")


if __name__ == "__main__":
    main()
