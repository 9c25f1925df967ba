#pragma once
#include <Eigen/Dense>
#include <memory>
#include <rclcpp/logging.hpp>
#include <rclcpp/node_interfaces/node_parameters_interface.hpp>
#include <string>

namespace kinematics_interface {

/* Short names, which the class itself must not have. */
using InParameters = std::shared_ptr<rclcpp::node_interfaces::NodeParametersInterface>;
using Vector = Eigen::VectorXd;
using Twist = Eigen::Matrix<double, 6, 1>;
using Frame = Eigen::Matrix<double, 7, 1>;
using Name = const std::string &;

/* That of Jazzy and later, or with HUMBLE defined that of Humble. */
class KinematicsInterface {
public:
    virtual ~KinematicsInterface() = default;
#ifdef HUMBLE
    virtual bool initialize(InParameters, Name) = 0;
#else
    virtual bool initialize(Name, InParameters, Name) = 0;
    virtual bool calculate_jacobian_inverse(
        const Vector &, Name, Eigen::Matrix<double, Eigen::Dynamic, 6> &) = 0;
    virtual bool calculate_frame_difference(Frame &, Frame &, double, Twist &) = 0;
#endif
    virtual bool convert_cartesian_deltas_to_joint_deltas(const Vector &, const Twist &, Name, Vector &) = 0;
    virtual bool convert_joint_deltas_to_cartesian_deltas(const Vector &, const Vector &, Name, Twist &) = 0;
    virtual bool calculate_link_transform(const Vector &, Name, Eigen::Isometry3d &) = 0;
    virtual bool calculate_jacobian(const Vector &, Name, Eigen::Matrix<double, 6, Eigen::Dynamic> &) = 0;
};

} // namespace kinematics_interface
