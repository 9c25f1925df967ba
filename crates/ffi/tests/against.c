/*
 * libdenavit against the library that it is made of, and against wrong arguments: `against VECTORS`.
 *
 * VECTORS is what `examples/vectors.rs` prints. Poses are held to the product of the table's elementary transforms, which stands here;
 * solutions and torques to the library's; what is written is guarded by numbers before and behind it.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "denavit.h"

#define MOST 16
#define THREADS 8
#define GUARD 12345.678

static int failures = 0;
static int checks = 0;

#define CHECK(condition)                                                                       \
    do {                                                                                       \
        checks++;                                                                              \
        if (!(condition)) {                                                                    \
            failures++;                                                                        \
            fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, denavit_error_message()); \
        }                                                                                      \
    } while (0)

static FILE *vectors;

static double number(void) {
    double x = NAN;
    if (fscanf(vectors, "%lf", &x) != 1) {
        fprintf(stderr, "a number is missing in the vectors\n");
        exit(2);
    }
    return x;
}

static void numbers(double *into, size_t count) {
    for (size_t i = 0; i < count; i++) into[i] = number();
}

static int word(const char *expected) {
    char read[32];
    return fscanf(vectors, "%31s", read) == 1 && strcmp(read, expected) == 0;
}

/* a = a b */
static void multiply(double a[4][4], double b[4][4]) {
    double c[4][4];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            c[i][j] = 0;
            for (int k = 0; k < 4; k++) c[i][j] += a[i][k] * b[k][j];
        }
    memcpy(a, c, sizeof c);
}

static void turn_z(double a[4][4], double t) {
    double r[4][4] = {{cos(t), -sin(t), 0, 0}, {sin(t), cos(t), 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    multiply(a, r);
}

static void turn_x(double a[4][4], double t) {
    double r[4][4] = {{1, 0, 0, 0}, {0, cos(t), -sin(t), 0}, {0, sin(t), cos(t), 0}, {0, 0, 0, 1}};
    multiply(a, r);
}

static void slide(double a[4][4], double x, double z) {
    double r[4][4] = {{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, z}, {0, 0, 0, 1}};
    multiply(a, r);
}

/* The product of a table's transforms. */
static void product(int convention, size_t rows, double cells[][4], int32_t *kinds, const double *q, double pose[4][4]) {
    double x[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (size_t i = 0, j = 0; i < rows; i++) {
        double *c = cells[i];
        double theta = convention == DENAVIT_CONVENTION_STANDARD ? c[0] : c[2];
        double d = convention == DENAVIT_CONVENTION_STANDARD ? c[1] : c[3];
        if (kinds[i] == DENAVIT_REVOLUTE) theta += q[j++];
        if (kinds[i] == DENAVIT_PRISMATIC) d += q[j++];
        if (convention == DENAVIT_CONVENTION_STANDARD) {
            turn_z(x, theta);
            slide(x, c[2], d);
            turn_x(x, c[3]);
        } else {
            turn_x(x, c[0]);
            slide(x, c[1], 0);
            turn_z(x, theta);
            slide(x, 0, d);
        }
    }
    memcpy(pose, x, sizeof x);
}

static double apart(const double *a, const double *b, size_t count) {
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        double d = fabs(a[i] - b[i]);
        if (!(d <= most)) most = d; /* a NaN, too */
    }
    return most;
}

static double poses_apart(const denavit_pose *a, const denavit_pose *b) {
    return apart(&a->matrix[0][0], &b->matrix[0][0], 16);
}

/* What one thread does with a robot and a solver that all use. */
typedef struct {
    const denavit_robot *robot;
    const denavit_solver *solver;
    const double *states;
    const denavit_pose *poses;
    size_t joints, count;
    int wrong;
} task;

static void *work(void *given) {
    task *t = given;
    for (int round = 0; round < 20; round++)
        for (size_t k = 0; k < t->count; k++) {
            denavit_pose pose;
            double jacobian[6 * MOST], q[MOST];
            if (denavit_fk(t->robot, t->states + k * t->joints, t->joints, &pose) != DENAVIT_OK ||
                memcmp(&pose, &t->poses[k], sizeof pose) != 0 ||
                denavit_jacobian(t->robot, DENAVIT_TOOL, 1, t->states + k * t->joints, t->joints, jacobian,
                                 6 * t->joints) != DENAVIT_OK)
                t->wrong++;
            if (round > 0 || k > 0) continue;
            denavit_answer *answer = NULL;
            if (denavit_solve(t->solver, &pose, NULL, 0, 0, &answer) < 0) t->wrong++;
            if (denavit_answer_nearest(answer, t->states + k * t->joints, t->joints, q, NULL) != DENAVIT_OK ||
                denavit_fk(t->robot, q, t->joints, &pose) != DENAVIT_OK || poses_apart(&pose, &t->poses[k]) > 1e-7)
                t->wrong++;
            denavit_answer_free(answer);
            /* Errors are those of this thread. */
            if (denavit_fk(t->robot, NULL, t->joints, &pose) != DENAVIT_BAD_POINTER ||
                strcmp(denavit_error_message(), "q is null") != 0)
                t->wrong++;
        }
    return NULL;
}

static void from_threads(const denavit_robot *robot, const denavit_solver *solver, const double *states,
                         const denavit_pose *poses, size_t joints, size_t count) {
    pthread_t threads[THREADS];
    task tasks[THREADS];
    for (int i = 0; i < THREADS; i++) {
        task t = {robot, solver, states, poses, joints, count, 0};
        tasks[i] = t;
        CHECK(pthread_create(&threads[i], NULL, work, &tasks[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK(tasks[i].wrong == 0);
    }
}

/* The Jacobian by differences of poses. */
static void differences(const denavit_robot *robot, const double *q, size_t n, double *jacobian) {
    for (size_t j = 0; j < n; j++) {
        double p[MOST], h = 1e-6;
        denavit_pose a, b, at;
        memcpy(p, q, n * sizeof *q);
        p[j] = q[j] - h;
        CHECK(denavit_fk(robot, p, n, &a) == DENAVIT_OK);
        p[j] = q[j] + h;
        CHECK(denavit_fk(robot, p, n, &b) == DENAVIT_OK);
        CHECK(denavit_fk(robot, q, n, &at) == DENAVIT_OK);
        double w[3][3];
        for (int r = 0; r < 3; r++) {
            jacobian[(size_t)r * n + j] = (b.matrix[r][3] - a.matrix[r][3]) / (2 * h);
            for (int c = 0; c < 3; c++) {
                w[r][c] = 0;
                for (int k = 0; k < 3; k++)
                    w[r][c] += (b.matrix[r][k] - a.matrix[r][k]) / (2 * h) * at.matrix[c][k];
            }
        }
        jacobian[3 * n + j] = w[2][1];
        jacobian[4 * n + j] = w[0][2];
        jacobian[5 * n + j] = w[1][0];
    }
}

static void many(const denavit_robot *robot, const double *states, size_t joints, size_t count) {
    size_t rows = 1000, in = 0, out = 0;
    CHECK(denavit_prepare(robot, DENAVIT_FUNCTION_FK, &in, &out) == DENAVIT_OK);
    CHECK(in == joints && out == 16);
    double *inputs = malloc(rows * joints * sizeof *inputs);
    double *one = malloc((rows * 16 + 1) * sizeof *one), *four = malloc((rows * 16 + 1) * sizeof *four);
    for (size_t i = 0; i < rows * joints; i++) inputs[i] = states[i % (count * joints)] + 1e-3 * (double)(i / 7);
    one[rows * 16] = four[rows * 16] = GUARD;
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, rows, inputs, rows * joints, one, rows * 16, 1) == DENAVIT_OK);
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, rows, inputs, rows * joints, four, rows * 16, 4) == DENAVIT_OK);
    CHECK(memcmp(one, four, rows * 16 * sizeof *one) == 0);
    CHECK(one[rows * 16] == GUARD && four[rows * 16] == GUARD);
    for (size_t i = 0; i < rows; i += 111) {
        denavit_pose pose;
        CHECK(denavit_fk(robot, inputs + i * joints, joints, &pose) == DENAVIT_OK);
        CHECK(memcmp(&pose, one + 16 * i, sizeof pose) == 0);
    }
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, rows, one, rows * joints, one, rows * 16, 1) == DENAVIT_BAD_POINTER);
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, rows, inputs, rows * joints - 1, one, rows * 16, 1) ==
          DENAVIT_WRONG_LENGTH);
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, SIZE_MAX, inputs, rows * joints, one, rows * 16, 1) ==
          DENAVIT_WRONG_LENGTH);
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, 0, NULL, 0, NULL, 0, 0) == DENAVIT_OK);
    CHECK(denavit_evaluate(robot, 99, 0, NULL, 0, NULL, 0, 0) == DENAVIT_BAD_ARGUMENT);
    inputs[joints] = NAN;
    CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_FK, rows, inputs, rows * joints, one, rows * 16, 1) ==
          DENAVIT_NOT_FINITE);
    free(inputs);
    free(one);
    free(four);
}

/* A pose, what came of it by the library, and here. */
static void solved(const denavit_robot *robot, const denavit_solver *solver, size_t n, int limited,
                   const denavit_pose *pose) {
    int32_t status = (int32_t)number();
    size_t solutions = (size_t)number(), families = (size_t)number(), left_out = (size_t)number();
    double *expected = malloc((solutions * n + 1) * sizeof *expected);
    numbers(expected, solutions * n);
    denavit_answer *answer = NULL;
    CHECK(denavit_solve(solver, pose, NULL, 0, limited, &answer) == status);
    CHECK(denavit_answer_status(answer) == status);
    size_t found = 99, curves = 99, out = 99;
    CHECK(denavit_answer_counts(answer, &found, &curves, &out) == DENAVIT_OK);
    CHECK(found == solutions && curves == families && out == left_out);
    denavit_doubt doubt = -1;
    CHECK(denavit_answer_doubt(answer, &doubt) == DENAVIT_OK);
    CHECK((doubt == DENAVIT_DOUBT_NONE) == (status != DENAVIT_UNDECIDED && status != DENAVIT_NOT_FOUND) ||
          status == DENAVIT_OUTSIDE_LIMITS);
    double q[MOST + 2];
    for (size_t i = 0; i < found; i++) {
        denavit_solution s;
        denavit_pose reached;
        q[0] = q[n + 1] = GUARD;
        CHECK(denavit_answer_solution(answer, i, q + 1, n, &s) == DENAVIT_OK);
        CHECK(q[0] == GUARD && q[n + 1] == GUARD);
        CHECK(apart(q + 1, expected + i * n, n) == 0);
        CHECK(s.residual < 1e-7 && s.multiplicity >= 1 && s.branch != NULL);
        CHECK(denavit_fk(robot, q + 1, n, &reached) == DENAVIT_OK);
        CHECK(poses_apart(&reached, pose) < 1e-6);
        if (s.within_limits) {
            double copies[64 * MOST];
            size_t count = 0;
            CHECK(denavit_answer_copies(answer, i, copies, 64 * n, &count) == DENAVIT_OK);
            CHECK(s.copies == count || count == 64);
            for (size_t k = 0; k < count; k++) {
                CHECK(denavit_fk(robot, copies + k * n, n, &reached) == DENAVIT_OK);
                CHECK(poses_apart(&reached, pose) < 1e-6);
            }
        }
    }
    CHECK(denavit_answer_solution(answer, found, q, n, NULL) == DENAVIT_BAD_ARGUMENT);
    for (size_t i = 0; i < curves; i++) {
        denavit_family f;
        denavit_pose reached;
        double direction[MOST];
        CHECK(denavit_answer_family(answer, i, q, direction, n, &f) == DENAVIT_OK);
        CHECK(f.dimension >= 1 && strlen(f.free_unknowns) > 0);
        double *members = malloc((f.members * n + 1) * sizeof *members);
        double *stretches = malloc((2 * f.stretches + 1) * sizeof *stretches);
        members[f.members * n] = stretches[2 * f.stretches] = GUARD;
        CHECK(denavit_answer_members(answer, i, members, f.members * n, stretches, 2 * f.stretches) == DENAVIT_OK);
        CHECK(members[f.members * n] == GUARD && stretches[2 * f.stretches] == GUARD);
        CHECK(denavit_answer_members(answer, i, members, f.members * n, NULL, 0) == DENAVIT_OK);
        CHECK(denavit_answer_members(answer, i, members, f.members * n + 1, NULL, 0) == DENAVIT_WRONG_LENGTH);
        for (size_t k = 0; k < f.members; k += 1 + f.members / 10) {
            CHECK(denavit_fk(robot, members + k * n, n, &reached) == DENAVIT_OK);
            CHECK(poses_apart(&reached, pose) < 1e-5);
        }
        free(members);
        free(stretches);
    }
    denavit_obstacle obstacle;
    memset(&obstacle, 0, sizeof obstacle);
    int32_t hindered = denavit_answer_obstacle(answer, q, n, &obstacle);
    CHECK(hindered == (found + curves > 0 || status == DENAVIT_OUTSIDE_LIMITS ? DENAVIT_NOT_FOUND : DENAVIT_OK));
    if (hindered == DENAVIT_OK) CHECK(obstacle.distance > 0 && strlen(obstacle.message) > 10);
    if (found + curves == 0) CHECK(denavit_answer_nearest(answer, q, n, q, NULL) == DENAVIT_NOT_FOUND);
    denavit_answer_free(answer);

    /* The same without an object. */
    double all[MOST * MOST], residuals[MOST];
    size_t count = 99;
    denavit_status came = 99;
    CHECK(denavit_ik(solver, pose, 1, NULL, 0, limited, MOST, all, MOST * n, residuals, MOST, &count, 1, &came, 1, 1) ==
          DENAVIT_OK);
    CHECK(came == status && count == found + curves);
    CHECK(found <= MOST && apart(all, expected, found * n) == 0);
    CHECK(count >= MOST || isnan(all[count * n]));
    /* Room for one only; where there is one soon. */
    if (status == DENAVIT_OK) {
        all[n] = GUARD;
        CHECK(denavit_ik(solver, pose, 1, NULL, 0, limited, 1, all, n, NULL, 0, &count, 1, &came, 1, 0) == DENAVIT_OK);
        CHECK(all[n] == GUARD && count == found + curves);
    }
    free(expected);
}

static void wrong_poses(const denavit_solver *solver, const denavit_pose *good, size_t n) {
    denavit_answer *answer = NULL;
    denavit_pose bad[4] = {*good, *good, *good, *good};
    bad[0].matrix[0][0] = NAN;
    bad[1].matrix[1][1] += 0.1;
    for (int r = 0; r < 3; r++) bad[2].matrix[r][0] = -bad[2].matrix[r][0];
    bad[3].matrix[3][0] = 1;
    denavit_status expected[5] = {DENAVIT_NOT_FINITE, DENAVIT_NOT_A_ROTATION, DENAVIT_NOT_A_ROTATION,
                                  DENAVIT_NOT_A_ROTATION, DENAVIT_OK};
    double q[MOST] = {0};
    for (int i = 0; i < 4; i++) {
        CHECK(denavit_solve(solver, &bad[i], NULL, 0, 0, &answer) == expected[i]);
        CHECK(answer == NULL && strncmp(denavit_error_message(), "pose: ", 6) == 0);
        CHECK(denavit_track(solver, &bad[i], q, n, q, NULL) == expected[i]);
    }
    denavit_pose poses[5] = {bad[0], bad[1], bad[2], bad[3], *good};
    double all[5 * MOST];
    size_t counts[5];
    denavit_status came[5];
    CHECK(denavit_ik(solver, poses, 5, NULL, 0, 0, 1, all, 5 * n, NULL, 0, counts, 5, came, 5, 2) == DENAVIT_OK);
    for (int i = 0; i < 4; i++) CHECK(came[i] == expected[i] && counts[i] == 0 && isnan(all[(size_t)i * n]));
    CHECK(came[4] >= 0 && counts[4] > 0 && !isnan(all[4 * n]));
    CHECK(denavit_ik(solver, poses, 5, NULL, 0, 0, 1, all, 5 * n + 1, NULL, 0, counts, 5, came, 5, 2) ==
          DENAVIT_WRONG_LENGTH);
    CHECK(denavit_ik(solver, poses, SIZE_MAX / 2, NULL, 0, 0, 1, all, 5 * n, NULL, 0, counts, 5, came, 5, 2) ==
          DENAVIT_WRONG_LENGTH);
    CHECK(denavit_ik(solver, NULL, 5, NULL, 0, 0, 1, all, 5 * n, NULL, 0, counts, 5, came, 5, 2) == DENAVIT_BAD_POINTER);
    CHECK(denavit_ik(solver, poses, 0, NULL, 0, 0, 1, NULL, 0, NULL, 0, NULL, 0, NULL, 0, 0) == DENAVIT_OK);
    CHECK(denavit_solve(NULL, good, NULL, 0, 0, &answer) == DENAVIT_BAD_POINTER);
    CHECK(denavit_solve(solver, NULL, NULL, 0, 0, &answer) == DENAVIT_BAD_POINTER);
    CHECK(denavit_solve(solver, good, NULL, 0, 0, NULL) == DENAVIT_BAD_POINTER);
    CHECK(denavit_solve(solver, good, q, 5, 0, &answer) == DENAVIT_WRONG_LENGTH);
    CHECK(answer == NULL);
}

static void one_robot(void) {
    int convention = (int)number();
    size_t rows = (size_t)number(), n = 0;
    double cells[MOST][4], limits[MOST][2];
    int32_t kinds[MOST];
    numbers(&cells[0][0], 4 * rows);
    for (size_t i = 0; i < rows; i++) {
        kinds[i] = (int32_t)number();
        n += kinds[i] != DENAVIT_FIXED;
        limits[i][0] = kinds[i] == DENAVIT_REVOLUTE ? -6 : -INFINITY;
        limits[i][1] = kinds[i] == DENAVIT_REVOLUTE ? 3.5 : INFINITY;
    }
    int limited = (int)number();
    denavit_robot *robot = NULL;
    const double *bounds = limited ? &limits[0][0] : NULL;
    CHECK(denavit_robot_table(convention, rows, &cells[0][0], 4 * rows, kinds, rows, bounds, limited ? 2 * rows : 0, NULL,
                              NULL, &robot) == DENAVIT_OK);
    size_t joints = 0, frames = 0;
    CHECK(denavit_robot_joints(robot, &joints) == DENAVIT_OK && joints == n);
    CHECK(denavit_robot_frames(robot, &frames) == DENAVIT_OK && frames == rows + 1);
    denavit_convention named = 0;
    CHECK(denavit_robot_convention(robot, &named) == DENAVIT_OK && named == convention);
    denavit_joint joint;
    CHECK(denavit_robot_joint(robot, 0, &joint) == DENAVIT_OK);
    CHECK(strcmp(joint.variable, "q1") == 0 && joint.kind == kinds[0] && joint.limited == limited);
    CHECK(joint.lower == (limited ? -6 : -INFINITY) && joint.upper == (limited ? 3.5 : INFINITY));
    CHECK(denavit_robot_joint(robot, n, &joint) == DENAVIT_BAD_ARGUMENT);

    CHECK(word("states"));
    size_t count = (size_t)number();
    double states[MOST * MOST];
    denavit_pose poses[MOST];
    numbers(states, count * n);
    for (size_t k = 0; k < count; k++) {
        const double *q = states + k * n;
        denavit_pose expected, frame[MOST];
        product(convention, rows, cells, kinds, q, expected.matrix);
        CHECK(denavit_fk(robot, q, n, &poses[k]) == DENAVIT_OK);
        CHECK(poses_apart(&poses[k], &expected) < 1e-13);
        CHECK(denavit_frames(robot, q, n, frame, rows + 2) == DENAVIT_OK);
        CHECK(poses_apart(&frame[rows], &expected) < 1e-13 && poses_apart(&frame[rows + 1], &expected) < 1e-13);
        product(convention, 1, cells, kinds, q, expected.matrix);
        CHECK(poses_apart(&frame[1], &expected) < 1e-13);
        double jacobian[6 * MOST + 2], wanted[6 * MOST];
        jacobian[0] = jacobian[6 * n + 1] = GUARD;
        CHECK(denavit_jacobian(robot, DENAVIT_TOOL, DENAVIT_BASE, q, n, jacobian + 1, 6 * n) == DENAVIT_OK);
        CHECK(jacobian[0] == GUARD && jacobian[6 * n + 1] == GUARD);
        differences(robot, q, n, wanted);
        CHECK(apart(jacobian + 1, wanted, 6 * n) < 1e-7);
        double other[6 * MOST];
        CHECK(denavit_jacobian(robot, (int32_t)rows, 0, q, n, other, 6 * n) == DENAVIT_OK);
        CHECK(apart(jacobian + 1, other, 6 * n) < 1e-12);
    }
    denavit_solver *solver = NULL;
    CHECK(denavit_solver_new(robot, DENAVIT_GOAL_POSE, NULL, 0, &solver) == DENAVIT_OK);
    const char *method = NULL;
    CHECK(denavit_solver_method(solver, &method) == DENAVIT_OK && strlen(method) > 5);
    CHECK(word("poses"));
    size_t goals = (size_t)number();
    for (size_t k = 0; k < goals; k++) {
        denavit_pose pose;
        numbers(&pose.matrix[0][0], 16);
        solved(robot, solver, n, limited, &pose);
    }
    wrong_poses(solver, &poses[0], n);

    /* Along a short way: near to where the joints were, and there. */
    double q[MOST], away[MOST];
    memcpy(q, states, n * sizeof *q);
    memcpy(away, states, n * sizeof *q);
    for (size_t j = 0; j < n; j++) away[j] += 0.01 * (double)(j + 1);
    denavit_pose ahead, reached;
    denavit_tracked told;
    CHECK(denavit_fk(robot, away, n, &ahead) == DENAVIT_OK);
    denavit_status came = denavit_track(solver, &ahead, q, n, q, &told);
    CHECK(came == DENAVIT_OK || (limited && (came == DENAVIT_OUTSIDE_LIMITS || came == DENAVIT_JUMPED)));
    CHECK(denavit_fk(robot, q, n, &reached) == DENAVIT_OK && poses_apart(&reached, &ahead) < 1e-6);
    CHECK(came != DENAVIT_OK || told.distance < 0.5);

    many(robot, states, n, count);
    from_threads(robot, solver, states, poses, n, count);

    /* Objects outlive what they were made from, and what is saved reads back. */
    const char *toml = NULL;
    CHECK(denavit_robot_toml(robot, &toml) == DENAVIT_OK);
    denavit_robot *again = NULL;
    CHECK(denavit_robot_text(toml, strlen(toml), "toml", NULL, &again) == DENAVIT_OK);
    CHECK(denavit_fk(again, states, n, &reached) == DENAVIT_OK);
    CHECK(memcmp(&reached, &poses[0], sizeof reached) == 0);
    denavit_robot_free(robot);
    denavit_answer *answer = NULL;
    CHECK(denavit_solve(solver, &poses[0], NULL, 0, 0, &answer) >= 0);
    denavit_solver_free(solver);
    CHECK(denavit_answer_nearest(answer, states, n, q, NULL) == DENAVIT_OK);
    CHECK(denavit_fk(again, q, n, &reached) == DENAVIT_OK && poses_apart(&reached, &poses[0]) < 1e-6);
    denavit_answer_free(answer);
    denavit_robot_free(again);
}

static void masses(void) {
    size_t length = (size_t)number();
    char *text = malloc(length + 1);
    CHECK(fgetc(vectors) == '\n' && fread(text, 1, length, vectors) == length);
    denavit_robot *robot = NULL;
    CHECK(denavit_robot_text(text, length, NULL, NULL, &robot) == DENAVIT_OK);
    free(text);
    size_t n = 0;
    int32_t weighs = 0;
    CHECK(denavit_robot_joints(robot, &n) == DENAVIT_OK);
    CHECK(denavit_robot_has_masses(robot, &weighs) == DENAVIT_OK && weighs == 1);
    CHECK(word("states"));
    size_t count = (size_t)number();
    for (size_t k = 0; k < count; k++) {
        double q[MOST], qd[MOST], qdd[MOST], torque[MOST], inertia[MOST * MOST], bias[MOST], gravity[MOST], energy[2];
        double found[MOST * MOST], state[3 * MOST], slopes[3 * MOST * MOST];
        numbers(q, n);
        numbers(qd, n);
        numbers(qdd, n);
        numbers(torque, n);
        numbers(inertia, n * n);
        numbers(bias, n);
        numbers(gravity, n);
        numbers(energy, 2);
        CHECK(denavit_torque(robot, q, qd, qdd, n, found) == DENAVIT_OK && apart(found, torque, n) < 1e-12);
        CHECK(denavit_bias(robot, q, qd, n, found) == DENAVIT_OK && apart(found, bias, n) < 1e-12);
        CHECK(denavit_gravity(robot, q, n, found) == DENAVIT_OK && apart(found, gravity, n) < 1e-12);
        CHECK(denavit_inertia(robot, q, n, found, n * n) == DENAVIT_OK && apart(found, inertia, n * n) < 1e-12);
        CHECK(denavit_inertia(robot, q, n, found, n) == DENAVIT_WRONG_LENGTH);
        CHECK(denavit_energy(robot, q, qd, n, &found[0], &found[1]) == DENAVIT_OK && apart(found, energy, 2) < 1e-12);
        CHECK(denavit_acceleration(robot, q, qd, torque, n, found) == DENAVIT_OK && apart(found, qdd, n) < 1e-9);
        /* In place. */
        memcpy(found, qdd, n * sizeof *qdd);
        CHECK(denavit_torque(robot, q, qd, found, n, found) == DENAVIT_OK && apart(found, torque, n) < 1e-12);
        /* The derivative by the accelerations is the inertia matrix. */
        memcpy(state, q, n * sizeof *q);
        memcpy(state + n, qd, n * sizeof *q);
        memcpy(state + 2 * n, qdd, n * sizeof *q);
        CHECK(denavit_evaluate(robot, DENAVIT_FUNCTION_TORQUE_DERIVATIVES, 1, state, 3 * n, slopes, 3 * n * n, 1) ==
              DENAVIT_OK);
        for (size_t i = 0; i < n; i++) CHECK(apart(slopes + 3 * n * i + 2 * n, inertia + n * i, n) < 1e-12);
    }
    denavit_robot_free(robot);
}

static void wrong_arguments(void) {
    denavit_robot *robot = NULL, *other = NULL;
    denavit_solver *solver = NULL;
    denavit_pose pose;
    denavit_finding finding;
    double q[6] = {0.1, -1, 1, 0.2, 0.7, 0.3}, out[64];
    size_t count = 0;
    const char *text = NULL;
    CHECK(denavit_robot_catalogue("ur-5", NULL, &robot) == DENAVIT_UNKNOWN_ROBOT && robot == NULL);
    CHECK(strstr(denavit_error_message(), "ur5") != NULL);
    CHECK(denavit_robot_catalogue(NULL, NULL, &robot) == DENAVIT_BAD_POINTER);
    CHECK(denavit_robot_catalogue("ur5", NULL, NULL) == DENAVIT_BAD_POINTER);
    CHECK(denavit_robot_catalogue("\xff", NULL, &robot) == DENAVIT_NOT_TEXT);
    CHECK(denavit_robot_file("no/such/file.urdf", NULL, &robot) == DENAVIT_BAD_FILE);
    CHECK(denavit_robot_file("-", NULL, &robot) == DENAVIT_BAD_FILE);
    CHECK(denavit_robot_catalogue("ur5", NULL, &robot) == DENAVIT_OK);

    /* A description with two errors, each with its place. */
    const char *broken = "name = 'x'\nconvention = 'standard'\n[[joints]]\ntheta = 'q1 +'\n[[joints]]\nd = '3 apples'\n";
    CHECK(denavit_robot_text(broken, strlen(broken), "toml", NULL, &other) == DENAVIT_BAD_DESCRIPTION && other == NULL);
    CHECK(denavit_error_findings() == 2);
    CHECK(denavit_error_finding(0, &finding) == DENAVIT_OK && finding.severity == DENAVIT_FINDING_ERROR);
    CHECK(finding.line == 4 && finding.column >= 9 && strstr(finding.rendered, "q1 +") != NULL);
    CHECK(denavit_error_finding(1, &finding) == DENAVIT_OK && finding.line == 6);
    CHECK(denavit_error_finding(2, &finding) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_error_finding(0, NULL) == DENAVIT_BAD_POINTER);
    CHECK(denavit_robot_text(broken, strlen(broken), "pdf", NULL, &other) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_robot_text(NULL, 5, NULL, NULL, &other) == DENAVIT_BAD_POINTER);
    CHECK(denavit_robot_text("", 0, NULL, NULL, &other) == DENAVIT_BAD_DESCRIPTION);
    char noise[4096];
    for (size_t i = 0; i < sizeof noise; i++) noise[i] = (char)(i * 2654435761u >> 13);
    CHECK(denavit_robot_text(noise, sizeof noise, NULL, NULL, &other) < 0);
    CHECK(denavit_robot_text(noise, SIZE_MAX, NULL, NULL, &other) == DENAVIT_WRONG_LENGTH);

    /* A tree: chains of it. */
    const char *urdf = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><joint name='j' type='revolute'>"
                       "<parent link='a'/><child link='b'/><origin xyz='0 0 1'/><axis xyz='0 0 1'/>"
                       "<limit lower='-1' upper='2' effort='1' velocity='3'/></joint><joint name='k' type='prismatic'>"
                       "<parent link='b'/><child link='c'/><axis xyz='1 0 0'/>"
                       "<limit lower='0' upper='1' effort='1' velocity='1'/></joint></robot>";
    denavit_options options;
    memset(&options, 0, sizeof options);
    options.tip = "b";
    CHECK(denavit_robot_text(urdf, strlen(urdf), NULL, &options, &other) == DENAVIT_OK);
    denavit_joint joint;
    CHECK(denavit_robot_joint(other, 0, &joint) == DENAVIT_OK && strcmp(joint.name, "j") == 0 && joint.velocity == 3);
    CHECK(denavit_robot_findings(other, &count) == DENAVIT_OK && count > 0);
    CHECK(denavit_robot_finding(other, 0, &finding) == DENAVIT_OK && strlen(finding.message) > 0);
    denavit_robot *whole = NULL;
    CHECK(denavit_robot_chain(other, NULL, "c", &whole) == DENAVIT_OK);
    CHECK(denavit_robot_joints(whole, &count) == DENAVIT_OK && count == 2);
    CHECK(denavit_robot_find_joint(whole, "k", &count) == DENAVIT_OK && count == 1);
    CHECK(denavit_robot_find_joint(whole, "x", &count) == DENAVIT_BAD_ARGUMENT);
    double two[2] = {0.5, 0.25};
    CHECK(denavit_fk(whole, two, 2, &pose) == DENAVIT_OK && fabs(pose.matrix[2][3] - 1) < 1e-15);
    CHECK(fabs(pose.matrix[0][3] - 0.25 * cos(0.5)) < 1e-15 && fabs(pose.matrix[1][3] - 0.25 * sin(0.5)) < 1e-15);
    denavit_robot_free(whole);
    whole = NULL;
    CHECK(denavit_robot_chain(other, NULL, "x", &whole) == DENAVIT_NO_CHAIN && whole == NULL);
    denavit_robot_free(other);
    other = NULL;
    options.convention = 17;
    CHECK(denavit_robot_text(urdf, strlen(urdf), NULL, &options, &other) == DENAVIT_BAD_ARGUMENT);
    options.convention = DENAVIT_CONVENTION_CRAIG;
    options.arguments_length = 3;
    CHECK(denavit_robot_text(urdf, strlen(urdf), NULL, &options, &other) == DENAVIT_WRONG_LENGTH);
    CHECK(denavit_robot_chain(robot, "a", NULL, &other) == DENAVIT_NO_CHAIN);

    /* Tables that are none. */
    double cells[4] = {0, 0, 1, NAN};
    int32_t kinds[1] = {DENAVIT_REVOLUTE};
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_STANDARD, 1, cells, 4, kinds, 1, NULL, 0, NULL, NULL, &other) ==
          DENAVIT_NOT_FINITE);
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_NONE, 1, cells, 4, kinds, 1, NULL, 0, NULL, NULL, &other) ==
          DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_CRAIG, 2, cells, 4, kinds, 1, NULL, 0, NULL, NULL, &other) ==
          DENAVIT_WRONG_LENGTH);
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_CRAIG, SIZE_MAX, cells, 4, kinds, 1, NULL, 0, NULL, NULL, &other) ==
          DENAVIT_WRONG_LENGTH);
    kinds[0] = 9;
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_CRAIG, 1, cells, 4, kinds, 1, NULL, 0, NULL, NULL, &other) ==
          DENAVIT_BAD_ARGUMENT);
    CHECK(other == NULL);
    /* An offset that is nearly nothing, a quarter turn, a base and a tool. */
    double tiny[4] = {1e-7, 0, 1, acos(-1) / 2};
    kinds[0] = DENAVIT_REVOLUTE;
    denavit_pose base = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 2}, {0, 0, 0, 1}}}, tool = base;
    CHECK(denavit_robot_table(DENAVIT_CONVENTION_STANDARD, 1, tiny, 4, kinds, 1, NULL, 0, &base, &tool, &other) ==
          DENAVIT_OK);
    double zero = 0;
    CHECK(denavit_fk(other, &zero, 1, &pose) == DENAVIT_OK);
    CHECK(fabs(pose.matrix[0][3] - 1) < 1e-6 && fabs(pose.matrix[1][3] + 2) < 1e-6 && pose.matrix[2][3] == 2);
    denavit_robot_free(other);
    other = NULL;

    /* States that are none. */
    CHECK(denavit_fk(NULL, q, 6, &pose) == DENAVIT_BAD_POINTER);
    CHECK(denavit_fk(robot, NULL, 6, &pose) == DENAVIT_BAD_POINTER);
    CHECK(denavit_fk(robot, q, 6, NULL) == DENAVIT_BAD_POINTER);
    CHECK(denavit_fk(robot, q, 5, &pose) == DENAVIT_WRONG_LENGTH);
    CHECK(denavit_fk(robot, (const double *)((const char *)q + 1), 6, &pose) == DENAVIT_BAD_POINTER);
    q[2] = INFINITY;
    CHECK(denavit_fk(robot, q, 6, &pose) == DENAVIT_NOT_FINITE && strstr(denavit_error_message(), "q[2]") != NULL);
    q[2] = 1;
    CHECK(denavit_jacobian(robot, DENAVIT_BASE, DENAVIT_BASE, q, 6, out, 36) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_jacobian(robot, 7, DENAVIT_BASE, q, 6, out, 36) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_jacobian(robot, 3, INT32_MIN, q, 6, out, 36) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_jacobian(robot, 3, 2, q, 6, out, 35) == DENAVIT_WRONG_LENGTH);
    CHECK(denavit_jacobian(robot, 3, 2, q, 6, out, 36) == DENAVIT_OK);
    CHECK(denavit_gravity(robot, q, 6, out) == DENAVIT_NO_MASSES);
    size_t given[7] = {9, 1, 2, 3, 4, 5, 0};
    CHECK(denavit_solver_new(robot, DENAVIT_GOAL_POSE, given, 1, &solver) == DENAVIT_BAD_ARGUMENT);
    given[0] = 0;
    CHECK(denavit_solver_new(robot, DENAVIT_GOAL_POSE, given, 7, &solver) == DENAVIT_BAD_ARGUMENT);
    CHECK(denavit_solver_new(robot, 2, NULL, 0, &solver) == DENAVIT_BAD_ARGUMENT && solver == NULL);
    CHECK(denavit_robot_set(robot, "no_such", 1, &other) == DENAVIT_BAD_ARGUMENT && other == NULL);
    CHECK(denavit_robot_set(robot, "a2", NAN, &other) == DENAVIT_NOT_FINITE && other == NULL);
    denavit_robot_free(robot);

    /* A redundant arm with a joint that is given. */
    robot = NULL;
    CHECK(denavit_robot_catalogue("franka-panda", NULL, &robot) == DENAVIT_OK);
    given[0] = 2;
    CHECK(denavit_solver_new(robot, DENAVIT_GOAL_POSE, given, 1, &solver) == DENAVIT_OK);
    CHECK(denavit_solver_given_length(solver, &count) == DENAVIT_OK && count == 1);
    CHECK(denavit_solver_given(solver, given, 2) == DENAVIT_WRONG_LENGTH);
    CHECK(denavit_solver_given(solver, given, 1) == DENAVIT_OK && given[0] == 2);
    double seven[7] = {0.1, 0.3, 0.4, -1.5, 0.2, 1.4, 0.3};
    denavit_answer *answer = NULL;
    CHECK(denavit_fk(robot, seven, 7, &pose) == DENAVIT_OK);
    CHECK(denavit_solve(solver, &pose, &seven[2], 1, 1, &answer) >= 0);
    double near[7];
    denavit_nearest told;
    CHECK(denavit_answer_nearest(answer, seven, 7, near, &told) == DENAVIT_OK);
    CHECK(apart(near, seven, 7) < 1e-6 && told.distance < 1e-6 && told.within_limits == 1);
    denavit_answer_free(answer);
    answer = NULL;
    CHECK(denavit_solve(solver, &pose, seven, 7, 1, &answer) == DENAVIT_WRONG_LENGTH && answer == NULL);
    denavit_solver_free(solver);
    denavit_robot_free(robot);

    /* Null is freed, too; statuses that are none have words. */
    denavit_robot_free(NULL);
    denavit_solver_free(NULL);
    denavit_answer_free(NULL);
    CHECK(strlen(denavit_status_text(DENAVIT_PANIC)) > 0 && strlen(denavit_status_text(77)) > 0);
    CHECK(denavit_catalogue_length() > 90);
    CHECK(denavit_catalogue(0, &text) == DENAVIT_OK && strlen(text) > 0);
    CHECK(denavit_catalogue(100000, &text) == DENAVIT_BAD_ARGUMENT);
    CHECK(strlen(denavit_version()) >= 5);
}

int main(int argc, char **argv) {
    vectors = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (!vectors) {
        fprintf(stderr, "against VECTORS\n");
        return 2;
    }
    CHECK(strcmp(denavit_error_message(), "") == 0 && denavit_error_findings() == 0);
    char kind[32] = "";
    while (fscanf(vectors, "%31s", kind) == 1 && strcmp(kind, "end") != 0) {
        if (strcmp(kind, "robot") == 0)
            one_robot();
        else if (strcmp(kind, "masses") == 0)
            masses();
        else
            CHECK(!"robots and masses");
        if (failures > 20) break;
    }
    CHECK(strcmp(kind, "end") == 0);
    fclose(vectors);
    wrong_arguments();
    printf("%d checks, %d failures\n", checks, failures);
    return failures != 0;
}
