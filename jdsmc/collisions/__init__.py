"""Collision stages: candidate pairs without a conflict, met, scattered, and counted."""
