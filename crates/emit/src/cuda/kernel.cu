{
    const size_t i = blockIdx.x * (size_t)blockDim.x + threadIdx.x;
    if (i >= count) {
        return;
    }
    @real@ variables[@n@];
#pragma unroll
    for (int j = 0; j < @n@; j++) {
        variables[j] = q[j * count + i];
    }
    @real@ one@shape@;
    @name@_@f@(variables, @argument@one);
    const @real@ *values = one@first@;
#pragma unroll
    for (int k = 0; k < @m@; k++) {
        @result@[k * count + i] = values[k];
    }
}
