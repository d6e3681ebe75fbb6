"""Derivatives of averages with respect to physical numbers, from the linearised generator."""
