{
    const size_t i = blockIdx.x * (size_t)blockDim.x + threadIdx.x;
    if (i >= count) {
        return;
    }
    double variables[@n@];
    for (int j = 0; j < @n@; j++) {
        variables[j] = @argument@[j * count + i];
    }
    @name@_@f@_solution found[@MAX@];
    @name@_@f@_certificate certificate;
    const int number = @name@_@f@(variables, @given@found, certificate);
    solutions[i] = number;
    solutions[count + i] = certificate;
    for (int s = 0; s < number; s++) {
        double *place = solutions + (2 + @w@ * s) * count + i;
        for (int k = 0; k < @m@; k++) {
            place[k * count] = found[s].@result@[k];
        }
        place[@m@ * count] = found[s].residual;
        place[(@m@ + 1) * count] = found[s].multiplicity;
        place[(@m@ + 2) * count] = found[s].branch;
        place[(@m@ + 3) * count] = found[s].free;
    }
}
