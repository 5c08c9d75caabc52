"""From a mechanism to its screws, written once over any ring."""
