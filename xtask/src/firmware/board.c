/* A firmware that calls the generated functions at poses of random configurations, counts instructions and measures the stack.
   With qemu's -icount the virtual clock advances by a nanosecond an instruction; SysTick counts it at 25 MHz. */

#include "@name@.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#define JOINTS @NAME@_VARIABLES
#define REGISTER(address) (*(volatile uint32_t *)(address))

static double unit(void)
{
    static uint32_t state = 12345u;
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) / 16777216.0;
}

/* Instructions since the last call; at most 671 million. */
static double instructions(void)
{
    static uint32_t last;
    const uint32_t now = REGISTER(0xE000E018);
    const uint32_t ticks = (last - now) & 0xFFFFFFu;
    last = now;
    return 40.0 * (double)ticks;
}

static double pose[4][4];
static double q[JOINTS], before[JOINTS];
static @name@_ik_result result;
static @name@_ik_choice choice;

static void call_fk(void)
{
    @name@_fk(q, pose);
}

static void call_ik(void)
{
    (void)@name@_ik(pose, @given@&result);
}

static void call_nearest(void)
{
    (void)@name@_ik_nearest(pose, before, 0, &choice);
}

/* How deep a function goes below its caller, bytes: what of a pattern it overwrites. */
static unsigned deep(void (*function)(void))
{
    enum { ROOM = 200000 };
    volatile uint8_t *const top = __builtin_frame_address(0);
    volatile uint8_t *const low = top - ROOM;
    volatile uint8_t *p;
    for (p = low; p < top - 64; p++) {
        *p = 0xA5;
    }
    function();
    for (p = low; p < top && *p == 0xA5; p++) {
    }
    return (unsigned)(top - p);
}

static void measure(const char *name, void (*function)(void), int count, double quarter)
{
    double most = 0.0, sum = 0.0;
    unsigned stack = 0;
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < JOINTS; j++) {
            const double x = 6.0 * unit() - 3.0;
            q[j] = quarter > 0.0 ? quarter * floor(x / quarter + 0.5) : x;
            before[j] = q[j] + 0.1 * unit();
        }
        @name@_fk(q, pose);
        (void)instructions();
        function();
        const double own = instructions();
        sum += own;
        most = own > most ? own : most;
        if (i < 8) {
            @name@_fk(q, pose);
            const unsigned bytes = deep(function);
            stack = bytes > stack ? bytes : stack;
        }
    }
    printf("%s %.0f %.0f %u\n", name, sum / (double)count, most, stack);
}

int main(void)
{
    REGISTER(0xE000E014) = 0xFFFFFF;
    REGISTER(0xE000E018) = 0;
    REGISTER(0xE000E010) = 5;
    measure("fk", call_fk, @count@, 0.0);
    measure("ik", call_ik, @count@, 0.0);
    measure("ik_nearest", call_nearest, @count@, 0.0);
    measure("ik_singular", call_ik, 8, 1.5707963267948966);
    return 0;
}

extern uint32_t loaded[], data_begin[], data_end[], end[];
extern void initialise_monitor_handles(void);
extern void _exit(int);

/* The unit of floating-point numbers is switched on ahead of anything that could use it. */
void reset(void)
{
    REGISTER(0xE000ED88) |= 0xFu << 20;
    __asm volatile("dsb\n isb");
    for (uint32_t *to = data_begin, *from = loaded; to < data_end; to++, from++) {
        *to = *from;
    }
    for (uint32_t *to = data_end; to < end; to++) {
        *to = 0;
    }
    initialise_monitor_handles();
    _exit(main());
}

__attribute__((section(".vectors"), used)) static const void *const vectors[] = {
    (const void *)0x20400000, (const void *)reset};
