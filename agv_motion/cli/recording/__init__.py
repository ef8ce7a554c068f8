"""Commands that record a run, play it, compute it again and draw it."""
