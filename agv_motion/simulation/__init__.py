"""What stands in for the world: sun, tree, vehicle, measurements; all seeded."""
