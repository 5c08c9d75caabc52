"""Which constraints depend on which, and what each freedom left is."""
