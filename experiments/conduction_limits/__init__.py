"""Heat conduction at small gradients: known coefficients, from the Fourier flow."""
