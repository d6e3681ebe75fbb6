"""Closed forms and kinetic-model solutions, one problem a file; nothing here runs a simulation."""
