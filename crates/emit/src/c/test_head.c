#include "@name@.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LANES = @N@_LANES };

static int failures;

static void
check(const char *name, int vector, int k, double value, double expected, double allowed)
{
    if (!(fabs(value - expected) <= allowed)) {
        printf("%s, configuration %d, result %d: ", name, vector, k);
        printf("%.17g, expected %.17g within %.2g\n", value, expected, allowed);
        failures++;
    }
}
