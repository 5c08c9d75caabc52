"""One question a module: each takes an assembly and returns a frozen result."""
