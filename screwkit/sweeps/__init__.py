"""An index over many postures or designs: grids, maps, the best design."""
