// Joints of an arm as `model.py` writes them, and the model that Pinocchio makes of them.
#pragma once

#include <pinocchio/fwd.hpp>
#include <pinocchio/multibody.hpp>

#include <string>

struct Link {
    double rotation[9], translation[3];
    int axis;
    double mass, lever[3], inertia[9];
};

inline pinocchio::Model model_of(const Link *links, int n)
{
    typedef Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> Matrix;
    typedef Eigen::Map<const Eigen::Vector3d> Vector;
    pinocchio::Model model;
    pinocchio::JointIndex parent = 0;
    for (int i = 0; i < n; i++) {
        const Link &l = links[i];
        const pinocchio::SE3 place(Matrix(l.rotation), Vector(l.translation));
        const std::string name = "j" + std::to_string(i);
        switch (l.axis) {
        case 0: parent = model.addJoint(parent, pinocchio::JointModelRX(), place, name); break;
        case 1: parent = model.addJoint(parent, pinocchio::JointModelRY(), place, name); break;
        default: parent = model.addJoint(parent, pinocchio::JointModelRZ(), place, name);
        }
        const pinocchio::Inertia body(l.mass, Vector(l.lever), Matrix(l.inertia));
        model.appendBodyToJoint(parent, body, pinocchio::SE3::Identity());
    }
    return model;
}
