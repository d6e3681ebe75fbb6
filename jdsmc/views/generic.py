"""Table and picture of any scene, from what its observables say of themselves."""


def table(result) -> str:
    """Steady values with errors and units."""
    if not result.is_steady:
        return f"No steady values ({result.attrs['stopped']})."
    lines = []
    for name in result:
        estimate = result[name]
        lines.append(f"{name:40s} {estimate}")
    return "\n".join([*lines, f"Ended because {result.attrs['stopped']}."])


def draw(result):
    raise NotImplementedError
