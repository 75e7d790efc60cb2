"""Studies: one scene for many values of its parameters, on one machine or many."""
