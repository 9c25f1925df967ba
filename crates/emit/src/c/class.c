
/* Fused multiply-add where the processor has it. */
#if defined(@NAME@_STRICT)
#define FUSED 0
#elif defined(__FMA__) || defined(__aarch64__) || defined(@NAME@_MULTIVERSION)
#define FUSED 1
#elif defined(_MSC_VER) && (defined(__AVX2__) || defined(_M_ARM64))
#define FUSED 1
#else
#define FUSED 0
#endif
#if FUSED
#define MULTIPLY_ADD(a, b, c) @FMA@(a, b, c)
#else
#define MULTIPLY_ADD(a, b, c) ((a) * (b) + (c))
#endif
