"""Pictures of increments for rviz: markers as arrays, which the program contact_path_markers publishes."""
