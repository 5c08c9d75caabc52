"""Classes of screw systems and their principal screws, whatever the basis."""
