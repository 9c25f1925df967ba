// Poses, Jacobians and all solutions of a UR5 in C++11, by denavit.hpp.
#include <cmath>
#include <cstdio>
#include <denavit.hpp>

static void list(const char *what, const double *numbers, std::size_t count) {
    std::printf("%-10s", what);
    for (std::size_t i = 0; i < count; i++) std::printf(" %9.5f", numbers[i]);
    std::printf("\n");
}

static void list(const char *what, const std::vector<double> &numbers) { list(what, numbers.data(), numbers.size()); }

static void summary(const denavit::answer &answer) {
    std::printf("status %d: %d solutions, %d families\n", static_cast<int>(answer.status()),
                static_cast<int>(answer.solutions().size()), static_cast<int>(answer.families().size()));
}

int main() try {
    const denavit::robot robot = denavit::robot::catalogue("ur5"); // or ::file("arm.urdf")
    std::printf("%s: %d joints\n", robot.name().c_str(), static_cast<int>(robot.joints()));
    const std::vector<double> q = {0.3, -1.2, 1.5, 0.4, 0.9, -0.6};
    const denavit::pose pose = robot.fk(q);
    list("tool at", {pose.matrix[0][3], pose.matrix[1][3], pose.matrix[2][3]});
    list("vx by", robot.jacobian(q).data(), 6);

    const denavit::solver solver(robot); // prepared once
    {
        const denavit::answer answer = solver.solve(pose);
        summary(answer);
        for (const denavit::solution &s : answer.solutions()) list("", s.q);
        std::vector<double> near = q;
        for (double &x : near) x += 0.1;
        list("nearest", answer.nearest(near));
    }
    // One centimetre up, from where the joints are: what a controller asks for.
    denavit::pose next = pose;
    next.matrix[2][3] += 0.01;
    std::vector<double> joints = q;
    const denavit_status status = solver.track(next, joints);
    std::printf("followed %d", status == DENAVIT_OK);
    list("", joints);

    // A straight wrist, and a pose out of reach.
    summary(solver.solve(robot.fk({0.3, -1.2, 1.5, 0.4, 0, -0.6})));
    next.matrix[0][3] += 3;
    const denavit::answer answer = solver.solve(next);
    std::printf("status %d: %s\n", static_cast<int>(answer.status()), answer.obstacle().c_str());

    next.matrix[0][0] = NAN;
    try {
        solver.solve(next);
    } catch (const denavit::error &e) {
        std::printf("error %d: %s\n", static_cast<int>(e.status()), e.what());
    }
    return 0;
} catch (const denavit::error &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
