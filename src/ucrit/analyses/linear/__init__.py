"""The linear equations: modes, forms, transfer functions, responses, steady turns, margins."""
