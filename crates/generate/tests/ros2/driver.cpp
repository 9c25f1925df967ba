/* A node in small: the plug-ins of a package, asked by their base classes' interfaces about a robot model. */

#include <cmath>
#include <cstdio>
#include <kinematics_interface/kinematics_interface.hpp>
#include <moveit/kinematics_base/kinematics_base.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <random>
#include <rclcpp/logging.hpp>

/* robot(), BASE, TIP, PACKAGE, JOINTS (names in order), FREE (indices of joints in excess). */
#include "model.hpp"

using kinematics::KinematicsBase;
using kinematics_interface::KinematicsInterface;
using kinematics::Values;

static int failures = 0;

static void check(bool holds, const char *what)
{
    if (!holds) {
        failures++;
        std::printf("not so: %s\n", what);
    }
}

static Eigen::Isometry3d placed(const moveit::core::RobotModel &model, const Values &q, const std::string &link)
{
    moveit::core::RobotState state(moveit::core::RobotModelConstPtr(&model, [](const auto *) {}));
    for (std::size_t j = 0; j < JOINTS.size(); j++) {
        state.setJointPositions(model.getJointModel(JOINTS[j]), &q[j]);
    }
    state.update();
    return state.getGlobalLinkTransform(BASE).inverse() * state.getGlobalLinkTransform(link);
}

static geometry_msgs::msg::Pose message(const Eigen::Isometry3d &x)
{
    const Eigen::Quaterniond q(x.linear());
    geometry_msgs::msg::Pose pose;
    pose.position = {x.translation().x(), x.translation().y(), x.translation().z()};
    pose.orientation = {q.x(), q.y(), q.z(), q.w()};
    return pose;
}

static double apart(const geometry_msgs::msg::Pose &pose, const Eigen::Isometry3d &x)
{
    const auto &o = pose.orientation;
    const Eigen::Quaterniond q(o.w, o.x, o.y, o.z);
    const Eigen::Vector3d p(pose.position.x, pose.position.y, pose.position.z);
    return (q.toRotationMatrix() - x.linear()).cwiseAbs().maxCoeff() + (p - x.translation()).norm();
}

static void test_moveit(const moveit::core::RobotModel &model, const std::vector<Values> &samples)
{
    const auto made = pluginlib::makers<KinematicsBase>().at(PACKAGE "::MoveItPlugin")();
    KinematicsBase &plugin = *made;
    kinematics::KinematicsResult result;
    moveit_msgs::msg::MoveItErrorCodes code;
    Values q;
    std::vector<Values> all;
    check(!plugin.getPositionIK(geometry_msgs::msg::Pose(), samples[0], q, code), "not ready yet");
    check(!plugin.initialize(nullptr, model, "no group", BASE, {TIP}, 0.1), "a group that is not there");
    check(!plugin.initialize(nullptr, model, "arm", TIP, {BASE}, 0.1), "other links");
    check(!plugin.initialize(nullptr, model, "arm", BASE, {TIP, TIP}, 0.1), "two tips");
    moveit::core::RobotModel other = model;
    for (auto &joint : other.joints) {
        joint.origin.translation().x() += joint.moves ? 0.001 : 0.0;
    }
    rclcpp::said().clear();
    check(!plugin.initialize(nullptr, other, "arm", BASE, {TIP}, 0.1), "an arm that is calibrated otherwise");
    check(!rclcpp::said().empty() && rclcpp::said()[0].find("generate again") != std::string::npos, "and why");
    check(plugin.initialize(nullptr, model, "arm", BASE, {TIP}, 0.1), "the arm itself");
    check(plugin.getJointNames() == JOINTS, "names of joints");
    check(!plugin.setRedundantJoints(std::vector<unsigned int>{0, 1, 2}), "other joints in excess");
    check(plugin.setRedundantJoints(FREE), "its own");

    for (const Values &own : samples) {
        const Eigen::Isometry3d there = placed(model, own, TIP);
        const geometry_msgs::msg::Pose pose = message(there);
        check(plugin.getPositionIK(pose, own, q, code) && code.val == code.SUCCESS, "a pose is reached");
        check((placed(model, q, TIP).matrix() - there.matrix()).norm() < 1e-6, "and had");
        for (std::size_t j = 0; j < JOINTS.size(); j++) {
            check(std::fabs(q[j] - own[j]) < 1e-4, "by the seed");
        }
        check(plugin.getPositionIK({pose}, own, all, result) && !all.empty(), "all of them");
        check(result.kinematic_error == kinematics::KinematicErrors::OK, "no error");
        for (const Values &each : all) {
            check((placed(model, each, TIP).matrix() - there.matrix()).norm() < 1e-6, "each has the pose");
        }
        /* Only the last one is without collision. */
        kinematics::KinematicsQueryOptions locked;
        locked.lock_redundant_joints = true;
        const Values last = all.back();
        const auto only = [&](const geometry_msgs::msg::Pose &, const Values &x, moveit_msgs::msg::MoveItErrorCodes &c) {
            double most = 0.0;
            for (std::size_t j = 0; j < x.size(); j++) {
                most = std::fmax(most, std::fabs(x[j] - last[j]));
            }
            c.val = most < 1e-6 ? c.SUCCESS : c.GOAL_IN_COLLISION;
        };
        check(plugin.searchPositionIK(pose, own, 0.0, q, only, code, locked), "the last one, if it must be");
        const auto none = [&](const geometry_msgs::msg::Pose &, const Values &, moveit_msgs::msg::MoveItErrorCodes &c) {
            c.val = c.GOAL_IN_COLLISION;
        };
        check(!plugin.searchPositionIK(pose, own, 0.0, q, none, code), "none, if all collide");
        check(code.val == code.GOAL_IN_COLLISION, "for that reason");
        const Values narrow(own.size(), 1e-3);
        check(plugin.searchPositionIK(pose, own, 0.01, narrow, q, code), "near the seed");
        check(plugin.searchPositionIK(pose, own, 0.01, narrow, q, nullptr, code), "likewise");
        Values elsewhere = own;
        elsewhere[0] += 0.1;
        elsewhere[1] -= 0.1;
        const Values tight(own.size(), 1e-9);
        check(!plugin.searchPositionIK(pose, elsewhere, 0.0, tight, q, code), "not near another seed");
        check(code.val == code.NO_IK_SOLUTION, "no solution then");

        std::vector<geometry_msgs::msg::Pose> poses;
        check(plugin.getPositionFK(plugin.getLinkNames(), own, poses), "all links stand somewhere");
        for (std::size_t k = 0; k < poses.size(); k++) {
            check(apart(poses[k], placed(model, own, plugin.getLinkNames()[k])) < 1e-9, "where the model has them");
        }
    }
    geometry_msgs::msg::Pose far = message(placed(model, samples[0], TIP));
    far.position.z += 100.0;
    check(!plugin.searchPositionIK(far, samples[0], 0.01, q, code), "out of reach");
    check(code.val == code.NO_IK_SOLUTION, "and no solution");
    kinematics::KinematicsQueryOptions options;
    options.return_approximate_solution = true;
    check(plugin.searchPositionIK(far, samples[0], 0.01, q, code, options), "but one that comes close");
    far.orientation = {0.0, 0.0, 0.0, 0.0};
    check(!plugin.getPositionIK(far, samples[0], q, code), "no orientation");
    check(!plugin.getPositionIK(message(placed(model, samples[0], TIP)), {}, q, code), "no seed");
    check(!plugin.getPositionIK(std::vector<geometry_msgs::msg::Pose>(), samples[0], all, result), "no pose");
    check(result.kinematic_error == kinematics::KinematicErrors::EMPTY_TIP_POSES, "said so");
    check(!plugin.getPositionIK({far, far}, samples[0], all, result), "two poses");
    check(result.kinematic_error == kinematics::KinematicErrors::MULTIPLE_TIPS_NOT_SUPPORTED, "said so");
    options.discretization_method = kinematics::DiscretizationMethods::ALL_DISCRETIZED;
    const bool is_some = plugin.getPositionIK({message(placed(model, samples[0], TIP))}, samples[0], all, result, options);
    check(is_some == !FREE.empty(), "values of joints in excess are tried where there are any");
    check(!is_some || all.size() > 16, "and give more solutions");
}

static void test_control(const moveit::core::RobotModel &model, const std::vector<Values> &samples)
{
    const auto made = pluginlib::makers<KinematicsInterface>().at(PACKAGE "::ControlPlugin")();
    KinematicsInterface &plugin = *made;
    const auto parameters = std::make_shared<rclcpp::node_interfaces::NodeParametersInterface>();
    Eigen::Isometry3d x;
    Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(samples[0].data(), samples[0].size());
    check(!plugin.calculate_link_transform(q, TIP, x), "not ready yet");
#ifdef HUMBLE
    check(!plugin.initialize(parameters, "another link"), "another tip");
    check(plugin.initialize(parameters, TIP), "the tip");
#else
    parameters->values["kinematics.tip"] = rclcpp::Parameter("kinematics.tip", std::string("another link"));
    check(!plugin.initialize("", parameters, "kinematics"), "another tip");
    parameters->values["kinematics.tip"] = rclcpp::Parameter("kinematics.tip", std::string(TIP));
    parameters->values["kinematics.alpha"] = rclcpp::Parameter("kinematics.alpha", 1e-9);
    check(plugin.initialize("", parameters, "kinematics"), "the tip");
#endif
    check(!plugin.calculate_link_transform(q, "no such link", x), "another link");
    check(!plugin.calculate_link_transform(Eigen::VectorXd::Zero(99), TIP, x), "another number of joints");
    for (const Values &own : samples) {
        q = Eigen::Map<const Eigen::VectorXd>(own.data(), own.size());
        check(plugin.calculate_link_transform(q, TIP, x), "a transform");
        check((x.matrix() - placed(model, own, TIP).matrix()).norm() < 1e-9, "as the model has it");
        Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
        check(plugin.calculate_jacobian(q, TIP, jacobian) && jacobian.cols() == q.size(), "a Jacobian");
        const double h = 1e-6;
        Eigen::VectorXd rates = Eigen::VectorXd::LinSpaced(q.size(), 0.3, 1.1);
        Eigen::Matrix<double, 6, 1> twist;
        check(plugin.convert_joint_deltas_to_cartesian_deltas(q, rates, TIP, twist), "a twist");
        Values before = own;
        Values after = own;
        for (std::size_t j = 0; j < own.size(); j++) {
            before[j] -= h * rates(j);
            after[j] += h * rates(j);
        }
        const Eigen::Isometry3d a = placed(model, before, TIP);
        const Eigen::Isometry3d b = placed(model, after, TIP);
        check(((b.translation() - a.translation()) / (2.0 * h) - twist.head<3>()).norm() < 1e-7, "its velocity");
        const Eigen::AngleAxisd turn(Eigen::Matrix3d(b.linear() * a.linear().transpose()));
        check((turn.angle() * turn.axis() / (2.0 * h) - twist.tail<3>()).norm() < 1e-6, "and turn");
        Eigen::VectorXd back;
        check(plugin.convert_cartesian_deltas_to_joint_deltas(q, twist, TIP, back), "and back");
        check((jacobian * back - twist).norm() < 1e-3 * twist.norm(), "to joints that do it");
#ifndef HUMBLE
        Eigen::Matrix<double, 7, 1> from;
        Eigen::Matrix<double, 7, 1> to;
        const Eigen::Quaterniond qa(a.linear());
        const Eigen::Quaterniond qb(b.linear());
        from << a.translation(), qa.x(), qa.y(), qa.z(), qa.w();
        to << b.translation(), qb.x(), qb.y(), qb.z(), qb.w();
        Eigen::Matrix<double, 6, 1> difference;
        check(plugin.calculate_frame_difference(from, to, 2.0 * h, difference), "a difference");
        check((difference - twist).norm() < 1e-5, "is the twist");
        check(!plugin.calculate_frame_difference(from, to, 0.0, difference), "in no time there is none");
#endif
    }
}

int main()
{
    const moveit::core::RobotModel model = robot();
    std::mt19937 random(5);
    std::vector<Values> samples;
    for (int sample = 0; sample < 40; sample++) {
        Values q;
        for (const std::string &name : JOINTS) {
            const auto bounds = model.getJointModel(name)->getVariableBounds()[0];
            const double low = bounds.position_bounded_ ? std::fmax(bounds.min_position_, -3.0) : -3.0;
            const double high = bounds.position_bounded_ ? std::fmin(bounds.max_position_, 3.0) : 3.0;
            q.push_back(std::uniform_real_distribution<double>(low, high)(random));
        }
        samples.push_back(q);
    }
    test_moveit(model, samples);
    test_control(model, samples);
    if (failures == 0) {
        std::printf("plug-ins: all checks hold\n");
    }
    return failures == 0 ? 0 : 1;
}
