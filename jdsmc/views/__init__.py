"""How results are shown to people: tables and pictures, one file a scene."""

from . import uniform_shear

_SCENES = {"UniformShear": uniform_shear}


def _view(result):
    return _SCENES[result.attrs["scene"]]


def table(result) -> str:
    """Steady values with errors, beside theory."""
    return _view(result).table(result)


def draw(result):
    """The matplotlib figure of a result."""
    return _view(result).draw(result)
