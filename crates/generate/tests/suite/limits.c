/* The nearest configuration within limits, where one is known to be there: arguments are the joint that is 0 (-1: none), how far the previous
   configuration may be, whether the limits are narrow, how many configurations. */
#include "arm.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define N ARM_VARIABLES

static double unit(void)
{
    static unsigned long long state = 5;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) / 9007199254740992.0;
}

int main(int count, char **words)
{
    const int straight = atoi(words[1]);
    const double far = atof(words[2]);
    const int is_narrow = atoi(words[3]);
    int lost = 0, wrong = 0, none = 0;
    (void)count;
    for (int t = 0; t < atoi(words[4]); t++) {
        double q[N], previous[N], pose[4][4];
        arm_ik_limits limits = arm_limits;
        arm_ik_choice choice;
        for (int j = 0; j < N; j++) {
            const double low = fmax(limits.lower[j], -3.1);
            const double high = fmin(limits.upper[j], 3.1);
            q[j] = j == straight ? 0.0 : low + (high - low) * unit();
            previous[j] = fmin(fmax(q[j] + far * (2.0 * unit() - 1.0), low), high);
        }
        for (int j = 0; is_narrow && j < N; j++) {
            limits.lower[j] = fmax(limits.lower[j], q[j] - 0.1 * unit());
            limits.upper[j] = fmin(limits.upper[j], q[j] + 0.1 * unit());
        }
        arm_fk(q, pose);
        (void)arm_ik_nearest(pose, previous, &limits, &choice);
        lost += !choice.is_found;
        for (int j = 0; choice.is_found && j < N; j++) {
            wrong += choice.q[j] < limits.lower[j] || choice.q[j] > limits.upper[j];
        }
        wrong += choice.is_found && !(choice.missed_shift <= 1e-7 && choice.missed_turn <= 1e-7);
        if (straight >= 0) {
            int there = 0;
            (void)arm_ik_all_within_limits(pose, &limits, 0, NULL, &there);
            none += there == 0;
        }
    }
    /* What is far, or no limit. */
    for (int k = 0; k < 4; k++) {
        static const double numbers[4] = {1e12, 1e18, NAN, HUGE_VAL};
        double q[N] = {0.0}, previous[N] = {0.0}, pose[4][4];
        arm_ik_limits limits = arm_limits;
        arm_ik_choice choice;
        arm_fk(q, pose);
        previous[k % N] = numbers[k];
        wrong += arm_ik_nearest(pose, previous, NULL, &choice) != ARM_IK_NOT_FINITE || choice.is_found
            || choice.missed_shift < HUGE_VAL || choice.missed_turn < HUGE_VAL || choice.distance < HUGE_VAL;
        limits.lower[0] = limits.upper[0] = numbers[k];
        wrong += arm_ik_nearest(pose, q, &limits, &choice) != ARM_IK_NOT_FINITE || choice.is_found;
    }
    printf("lost %d wrong %d none %d\n", lost, wrong, none);
    return 0;
}
