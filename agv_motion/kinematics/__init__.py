"""ACT: maps between the twist of a rigid body and the motion of its wheels."""
