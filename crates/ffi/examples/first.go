// Poses, Jacobians and all solutions of a UR5 in Go, by cgo.
package main

/*
#include <denavit.h>
#include <stdlib.h>
*/
import "C"

import (
	"fmt"
	"log"
	"math"
	"runtime"
	"unsafe"
)

// needed ends the program where nothing was computed.
func needed(status C.denavit_status) C.denavit_status {
	if status < 0 {
		log.Fatal(C.GoString(C.denavit_error_message()))
	}
	return status
}

func list(what string, numbers []C.double) {
	fmt.Printf("%-10s", what)
	for _, x := range numbers {
		fmt.Printf(" %9.5f", float64(x))
	}
	fmt.Println()
}

func main() {
	// The last error is that of the thread on which the call was.
	runtime.LockOSThread()
	ur5 := C.CString("ur5")
	defer C.free(unsafe.Pointer(ur5))
	var robot *C.denavit_robot
	needed(C.denavit_robot_catalogue(ur5, nil, &robot)) // or C.denavit_robot_file
	defer C.denavit_robot_free(robot)
	var name *C.char
	var joints C.size_t
	needed(C.denavit_robot_name(robot, &name))
	needed(C.denavit_robot_joints(robot, &joints))
	fmt.Printf("%s: %d joints\n", C.GoString(name), joints)

	q := []C.double{0.3, -1.2, 1.5, 0.4, 0.9, -0.6}
	var pose C.denavit_pose
	needed(C.denavit_fk(robot, &q[0], joints, &pose))
	list("tool at", []C.double{pose.matrix[0][3], pose.matrix[1][3], pose.matrix[2][3]})
	jacobian := make([]C.double, 6*joints)
	needed(C.denavit_jacobian(robot, C.DENAVIT_TOOL, C.DENAVIT_BASE, &q[0], joints, &jacobian[0], 6*joints))
	list("vx by", jacobian[:6])

	var solver *C.denavit_solver // prepared once
	needed(C.denavit_solver_new(robot, C.DENAVIT_GOAL_POSE, nil, 0, &solver))
	defer C.denavit_solver_free(solver)
	solve := func(pose *C.denavit_pose) (*C.denavit_answer, C.denavit_status, C.size_t, C.size_t) {
		var answer *C.denavit_answer
		var solutions, families C.size_t
		status := needed(C.denavit_solve(solver, pose, nil, 0, 0, &answer))
		needed(C.denavit_answer_counts(answer, &solutions, &families, nil))
		return answer, status, solutions, families
	}
	answer, status, solutions, families := solve(&pose)
	fmt.Printf("status %d: %d solutions, %d families\n", status, solutions, families)
	found, near := make([]C.double, joints), make([]C.double, joints)
	for i := C.size_t(0); i < solutions; i++ {
		needed(C.denavit_answer_solution(answer, i, &found[0], joints, nil))
		list("", found)
	}
	for j := range near {
		near[j] = q[j] + 0.1
	}
	needed(C.denavit_answer_nearest(answer, &near[0], joints, &found[0], nil))
	list("nearest", found)
	C.denavit_answer_free(answer)

	// One centimetre up, from where the joints are: what a controller asks for.
	next := pose
	next.matrix[2][3] += 0.01
	status = needed(C.denavit_track(solver, &next, &q[0], joints, &found[0], nil))
	followed := 0
	if status == C.DENAVIT_OK {
		followed = 1
	}
	fmt.Printf("followed %d", followed)
	list("", found)

	// A straight wrist, and a pose out of reach.
	straight := []C.double{0.3, -1.2, 1.5, 0.4, 0, -0.6}
	needed(C.denavit_fk(robot, &straight[0], joints, &pose))
	answer, status, solutions, families = solve(&pose)
	fmt.Printf("status %d: %d solutions, %d families\n", status, solutions, families)
	C.denavit_answer_free(answer)
	next.matrix[0][3] += 3
	answer, status, _, _ = solve(&next)
	var obstacle C.denavit_obstacle
	needed(C.denavit_answer_obstacle(answer, &found[0], joints, &obstacle))
	fmt.Printf("status %d: %s\n", status, C.GoString(obstacle.message))
	C.denavit_answer_free(answer)

	next.matrix[0][0] = C.double(math.NaN())
	status = C.denavit_solve(solver, &next, nil, 0, 0, &answer)
	fmt.Printf("error %d: %s\n", status, C.GoString(C.denavit_error_message()))
}
