"""Who uses the cores of a CPU: the gases of a run, or the operations of one gas."""

import os

import jax


def leave_cores_to_gases() -> None:
    """Let XLA compute each operation on one core; the gases of a run already use all of them.

    To be called before JAX computes anything; it holds for the whole process, so that it is for
    applications to call (the command line does). Results are the same to the bit. Without it XLA
    splits every loop of a few thousand particles among the cores, and handing over costs more than
    the loop: 1.1 times the CPU time in homogeneous gases, 1.5 in slabs, 2.5 in cooling disks.
    """
    os.environ.setdefault("NPROC", "1")
    jax.config.update("jax_cpu_enable_async_dispatch", False)
