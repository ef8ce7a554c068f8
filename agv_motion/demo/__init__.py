"""The demos: whole robots on one executor, from their configuration to a bag.

A program, not a library: `agv demo` runs it, and nothing is to be imported from here. `README.md`
tells how a `Scenario` (:mod:`.scenario`) and the `Demo` that runs it (:mod:`.frame`) go together.
"""
