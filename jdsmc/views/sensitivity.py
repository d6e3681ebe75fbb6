"""Table and picture of derivatives."""

import numpy as np

from .page import Block, Page


def page(found) -> Page:
    """Filled in below."""
    rows = []
    data = found.to_xarray()
    for name in found:
        for parameter in found.parameters:
            one = found[name][parameter]
            for v, e, t in zip(*map(np.ravel, (one.value, one.error, one.truncation)), strict=True):
                rows.append([name, parameter, f"{v:.5g}", f"{e:.1g}", f"{t:.1g}"])
    del data
    return Page([Block(["derivative of", "by", "value", "error", "truncation"], rows, (0, 1))], [])


def draw(found):
    raise NotImplementedError
