/* Poses, Jacobians and all solutions of a UR5 in C99. */
#include <denavit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program where nothing was computed. */
static denavit_status needed(denavit_status status) {
    if (status < 0) {
        fprintf(stderr, "%s: %s\n", denavit_status_text(status), denavit_error_message());
        exit(1);
    }
    return status;
}

static void list(const char *what, const double *numbers, size_t count) {
    printf("%-10s", what);
    for (size_t i = 0; i < count; i++) printf(" %9.5f", numbers[i]);
    printf("\n");
}

int main(void) {
    denavit_robot *robot;
    needed(denavit_robot_catalogue("ur5", NULL, &robot)); /* or denavit_robot_file("arm.urdf", NULL, &robot) */
    const char *name;
    size_t joints;
    needed(denavit_robot_name(robot, &name));
    needed(denavit_robot_joints(robot, &joints));
    printf("%s: %d joints\n", name, (int)joints);

    double q[6] = {0.3, -1.2, 1.5, 0.4, 0.9, -0.6}, jacobian[36];
    denavit_pose pose;
    needed(denavit_fk(robot, q, 6, &pose));
    double position[3] = {pose.matrix[0][3], pose.matrix[1][3], pose.matrix[2][3]};
    list("tool at", position, 3);
    needed(denavit_jacobian(robot, DENAVIT_TOOL, DENAVIT_BASE, q, 6, jacobian, 36));
    list("vx by", jacobian, 6);

    denavit_solver *solver; /* prepared once */
    needed(denavit_solver_new(robot, DENAVIT_GOAL_POSE, NULL, 0, &solver));
    denavit_answer *answer;
    denavit_status status = needed(denavit_solve(solver, &pose, NULL, 0, 0, &answer));
    size_t solutions, families;
    needed(denavit_answer_counts(answer, &solutions, &families, NULL));
    printf("status %d: %d solutions, %d families\n", (int)status, (int)solutions, (int)families);
    double found[6], near[6];
    for (size_t i = 0; i < solutions; i++) {
        needed(denavit_answer_solution(answer, i, found, 6, NULL));
        list("", found, 6);
    }
    for (int j = 0; j < 6; j++) near[j] = q[j] + 0.1;
    needed(denavit_answer_nearest(answer, near, 6, found, NULL));
    list("nearest", found, 6);
    denavit_answer_free(answer);

    /* One centimetre up, from where the joints are: what a controller asks for. */
    denavit_pose next = pose;
    next.matrix[2][3] += 0.01;
    status = needed(denavit_track(solver, &next, q, 6, found, NULL));
    printf("followed %d", status == DENAVIT_OK);
    list("", found, 6);

    /* A straight wrist, and a pose out of reach. */
    double straight[6] = {0.3, -1.2, 1.5, 0.4, 0, -0.6};
    needed(denavit_fk(robot, straight, 6, &pose));
    status = needed(denavit_solve(solver, &pose, NULL, 0, 0, &answer));
    needed(denavit_answer_counts(answer, &solutions, &families, NULL));
    printf("status %d: %d solutions, %d families\n", (int)status, (int)solutions, (int)families);
    denavit_answer_free(answer);
    next.matrix[0][3] += 3;
    status = needed(denavit_solve(solver, &next, NULL, 0, 0, &answer));
    denavit_obstacle obstacle;
    needed(denavit_answer_obstacle(answer, found, 6, &obstacle));
    printf("status %d: %s\n", (int)status, obstacle.message);
    denavit_answer_free(answer);

    next.matrix[0][0] = NAN;
    status = denavit_solve(solver, &next, NULL, 0, 0, &answer);
    printf("error %d: %s\n", (int)status, denavit_error_message());
    denavit_solver_free(solver);
    denavit_robot_free(robot);
    return 0;
}
