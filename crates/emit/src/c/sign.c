
/* 1, -1, or the number itself where it is 0 or none. */
INLINE double sign_of(double x)
{
    return x > 0 ? 1 : x < 0 ? -1 : x;
}
