"""Sums over particles on the device; observables from their averages on the host."""
