#pragma once
#include <functional>
#include <geometry_msgs/msg/pose.hpp>
#include <map>
#include <memory>
#include <moveit/robot_state/robot_state.hpp>
#include <moveit_msgs/msg/move_it_error_codes.hpp>
#include <rclcpp/node.hpp>
#include <string>
#include <vector>

namespace kinematics {

namespace DiscretizationMethods {
enum DiscretizationMethod {
    NO_DISCRETIZATION = 1,
    ALL_DISCRETIZED,
    SOME_DISCRETIZED,
    ALL_RANDOM_SAMPLED,
    SOME_RANDOM_SAMPLED
};
}
using DiscretizationMethod = DiscretizationMethods::DiscretizationMethod;

namespace KinematicErrors {
enum KinematicError {
    OK = 1,
    UNSUPORTED_DISCRETIZATION_REQUESTED,
    DISCRETIZATION_NOT_INITIALIZED,
    MULTIPLE_TIPS_NOT_SUPPORTED,
    EMPTY_TIP_POSES,
    IK_SEED_OUTSIDE_LIMITS,
    SOLVER_NOT_ACTIVE,
    NO_SOLUTION
};
}
using KinematicError = KinematicErrors::KinematicError;

struct KinematicsQueryOptions {
    bool lock_redundant_joints = false;
    bool return_approximate_solution = false;
    DiscretizationMethod discretization_method = DiscretizationMethods::NO_DISCRETIZATION;
};

struct KinematicsResult {
    KinematicError kinematic_error;
    double solution_percentage;
};

/* Short names, which the class itself must not have. */
using InPose = geometry_msgs::msg::Pose;
using Values = std::vector<double>;
using Code = moveit_msgs::msg::MoveItErrorCodes;
using Options = KinematicsQueryOptions;

class KinematicsBase {
public:
    using IKCallbackFn = std::function<void(const InPose &, const Values &, Code &)>;

    virtual ~KinematicsBase() = default;
    virtual bool getPositionIK(const InPose &, const Values &, Values &, Code &, const Options & = {}) const = 0;
    virtual bool getPositionIK(
        const std::vector<InPose> &, const Values &, std::vector<Values> &, KinematicsResult &,
        const Options & = {}) const
    {
        return false;
    }
    virtual bool searchPositionIK(
        const InPose &, const Values &, double, Values &, Code &, const Options & = {}) const = 0;
    virtual bool searchPositionIK(
        const InPose &, const Values &, double, const Values &, Values &, Code &, const Options & = {}) const = 0;
    virtual bool searchPositionIK(
        const InPose &, const Values &, double, Values &, const IKCallbackFn &, Code &,
        const Options & = {}) const = 0;
    virtual bool searchPositionIK(
        const InPose &, const Values &, double, const Values &, Values &, const IKCallbackFn &, Code &,
        const Options & = {}) const = 0;
    virtual bool getPositionFK(
        const std::vector<std::string> &, const Values &, std::vector<InPose> &) const = 0;
    virtual bool initialize(
        const rclcpp::Node::SharedPtr &, const moveit::core::RobotModel &, const std::string &,
        const std::string &, const std::vector<std::string> &, double)
    {
        return false;
    }
    virtual bool setRedundantJoints(const std::vector<unsigned int> &joints)
    {
        redundant_joint_indices_ = joints;
        setSearchDiscretization(0.1);
        return true;
    }
    bool setRedundantJoints(const std::vector<std::string> &) { return false; }
    virtual const std::vector<std::string> &getJointNames() const = 0;
    virtual const std::vector<std::string> &getLinkNames() const = 0;
    void setSearchDiscretization(double step)
    {
        steps_.clear();
        for (const unsigned int joint : redundant_joint_indices_) {
            steps_[static_cast<int>(joint)] = step;
        }
    }
    double getSearchDiscretization(int joint = 0) const
    {
        return steps_.count(joint) > 0 ? steps_.at(joint) : 0.0;
    }

protected:
    void storeValues(
        const moveit::core::RobotModel &model, const std::string &group, const std::string &base,
        const std::vector<std::string> &tips, double step)
    {
        robot_model_ = moveit::core::RobotModelConstPtr(&model, [](const moveit::core::RobotModel *) {});
        group_name_ = group;
        base_frame_ = base;
        tip_frames_ = tips;
        setSearchDiscretization(step);
    }

    rclcpp::Node::SharedPtr node_;
    moveit::core::RobotModelConstPtr robot_model_;
    std::string group_name_;
    std::string base_frame_;
    std::vector<std::string> tip_frames_;
    std::vector<unsigned int> redundant_joint_indices_;
    std::vector<DiscretizationMethod> supported_methods_ = {DiscretizationMethods::NO_DISCRETIZATION};

private:
    std::map<int, double> steps_;
};

} // namespace kinematics
