"""One way through: any scene, advanced, watched, assembled."""
