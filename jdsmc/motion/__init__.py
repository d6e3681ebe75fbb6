"""What moves particles between collisions: flows of velocity, flights, walls, cells."""
