// Inverse kinematics of @title@ for MoveIt 2: kinematics::KinematicsBase around the arm.

#if __has_include(<moveit/kinematics_base/kinematics_base.hpp>)
#include <moveit/kinematics_base/kinematics_base.hpp>
#include <moveit/robot_state/robot_state.hpp>
#else
#include <moveit/kinematics_base/kinematics_base.h>
#include <moveit/robot_state/robot_state.h>
#endif

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pluginlib/class_list_macros.hpp>
#include <rclcpp/logging.hpp>

#include "@package@/arm.hpp"

namespace @package@
{
namespace
{

/// How far the tip of the robot model may be from the one that this was generated for: m, and rad.
constexpr double SAME = 1e-5;

rclcpp::Logger logger()
{
  return rclcpp::get_logger("@package@.moveit_plugin");
}

std::string listed(const std::vector<std::string> & names)
{
  std::string text;
  for (const std::string & name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

bool read(const geometry_msgs::msg::Pose & message, Pose & pose)
{
  return from_quaternion(
    {message.position.x, message.position.y, message.position.z},
    {message.orientation.x, message.orientation.y, message.orientation.z, message.orientation.w},
    pose);
}

geometry_msgs::msg::Pose written(const Pose & pose)
{
  geometry_msgs::msg::Pose message;
  const Quaternion q = to_quaternion(pose);
  message.position.x = pose.position[0];
  message.position.y = pose.position[1];
  message.position.z = pose.position[2];
  message.orientation.x = q[0];
  message.orientation.y = q[1];
  message.orientation.z = q[2];
  message.orientation.w = q[3];
  return message;
}

}  // namespace

class MoveItPlugin : public kinematics::KinematicsBase
{
public:
  MoveItPlugin()
  {
    if (!Arm::free_joints().empty()) {
      supported_methods_.push_back(kinematics::DiscretizationMethods::ALL_DISCRETIZED);
    }
  }

  bool initialize(
    const rclcpp::Node::SharedPtr & node, const moveit::core::RobotModel & robot_model,
    const std::string & group_name, const std::string & base_frame,
    const std::vector<std::string> & tip_frames, double search_discretization) override
  {
    node_ = node;
    storeValues(robot_model, group_name, base_frame, tip_frames, search_discretization);
    const moveit::core::JointModelGroup * group = robot_model.getJointModelGroup(group_name);
    if (group == nullptr) {
      RCLCPP_ERROR(logger(), "there is no group '%s'", group_name.c_str());
      return false;
    }
    if (base_frame_ != Arm::base() || tip_frames_.size() != 1 || tip_frames_[0] != Arm::tip()) {
      RCLCPP_ERROR(
        logger(), "group '%s' is from '%s' to '%s'; this was generated from '%s' to '%s'",
        group_name.c_str(), base_frame_.c_str(), listed(tip_frames_).c_str(),
        Arm::base().c_str(), Arm::tip().c_str());
      return false;
    }
    std::vector<double> lower;
    std::vector<double> upper;
    for (const std::string & name : Arm::joint_names()) {
      if (!group->hasJointModel(name)) {
        RCLCPP_ERROR(
          logger(), "group '%s' has no joint '%s'; this was generated for %s", group_name.c_str(),
          name.c_str(), listed(Arm::joint_names()).c_str());
        return false;
      }
      const moveit::core::VariableBounds bounds =
        robot_model.getJointModel(name)->getVariableBounds()[0];
      lower.push_back(bounds.position_bounded_ ? bounds.min_position_ : -HUGE_VAL);
      upper.push_back(bounds.position_bounded_ ? bounds.max_position_ : HUGE_VAL);
    }
    std::vector<unsigned int> free;
    for (const std::size_t j : Arm::free_joints()) {
      free.push_back(static_cast<unsigned int>(j));
    }
    if (!setRedundantJoints(free)) {
      return false;
    }
    setSearchDiscretization(search_discretization);
    if (!arm_.set_limits(lower, upper)) {
      RCLCPP_ERROR(logger(), "the limits of group '%s' exclude each other", group_name.c_str());
      return false;
    }
    is_ready_ = is_same_arm(robot_model);
    return is_ready_;
  }

  bool getPositionIK(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & ik_seed_state,
    std::vector<double> & solution, moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    return search(ik_pose, ik_seed_state, 0.0, {}, solution, nullptr, error_code, options);
  }

  bool getPositionIK(
    const std::vector<geometry_msgs::msg::Pose> & ik_poses, const std::vector<double> & ik_seed_state,
    std::vector<std::vector<double>> & solutions, kinematics::KinematicsResult & result,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    solutions.clear();
    result.solution_percentage = 0.0;
    const bool is_known = std::find(
      supported_methods_.begin(), supported_methods_.end(),
      options.discretization_method) != supported_methods_.end();
    Pose pose;
    if (!is_ready_) {
      result.kinematic_error = kinematics::KinematicErrors::SOLVER_NOT_ACTIVE;
    } else if (!is_known) {
      result.kinematic_error = kinematics::KinematicErrors::UNSUPORTED_DISCRETIZATION_REQUESTED;
    } else if (ik_poses.empty()) {
      result.kinematic_error = kinematics::KinematicErrors::EMPTY_TIP_POSES;
    } else if (ik_poses.size() > 1) {
      result.kinematic_error = kinematics::KinematicErrors::MULTIPLE_TIPS_NOT_SUPPORTED;
    } else if (!read(ik_poses[0], pose)) {
      result.kinematic_error = kinematics::KinematicErrors::NO_SOLUTION;
    } else {
      std::vector<double> steps;
      if (options.discretization_method == kinematics::DiscretizationMethods::ALL_DISCRETIZED) {
        for (const std::size_t j : Arm::free_joints()) {
          steps.push_back(getSearchDiscretization(static_cast<int>(j)));
          if (!(steps.back() > 0.0)) {
            result.kinematic_error = kinematics::KinematicErrors::DISCRETIZATION_NOT_INITIALIZED;
            return false;
          }
        }
      }
      const bool is_found = arm_.all(pose, ik_seed_state, steps, solutions) == Outcome::found;
      result.kinematic_error = is_found ?
        kinematics::KinematicErrors::OK : kinematics::KinematicErrors::NO_SOLUTION;
      result.solution_percentage = is_found ? 1.0 : 0.0;
      return is_found;
    }
    return false;
  }

  bool searchPositionIK(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & ik_seed_state,
    double timeout, std::vector<double> & solution,
    moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    return search(ik_pose, ik_seed_state, timeout, {}, solution, nullptr, error_code, options);
  }

  bool searchPositionIK(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & ik_seed_state,
    double timeout, const std::vector<double> & consistency_limits, std::vector<double> & solution,
    moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    return search(
      ik_pose, ik_seed_state, timeout, consistency_limits, solution, nullptr, error_code, options);
  }

  bool searchPositionIK(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & ik_seed_state,
    double timeout, std::vector<double> & solution, const IKCallbackFn & solution_callback,
    moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    return search(
      ik_pose, ik_seed_state, timeout, {}, solution, solution_callback, error_code, options);
  }

  bool searchPositionIK(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & ik_seed_state,
    double timeout, const std::vector<double> & consistency_limits, std::vector<double> & solution,
    const IKCallbackFn & solution_callback, moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const override
  {
    return search(
      ik_pose, ik_seed_state, timeout, consistency_limits, solution, solution_callback, error_code,
      options);
  }

  // Those of other numbers of poses, and the solutions all at once, stay as they are.
  using kinematics::KinematicsBase::searchPositionIK;

  bool getPositionFK(
    const std::vector<std::string> & link_names, const std::vector<double> & joint_angles,
    std::vector<geometry_msgs::msg::Pose> & poses) const override
  {
    poses.clear();
    for (const std::string & name : link_names) {
      Pose pose;
      if (!arm_.link_pose(name, joint_angles, pose)) {
        RCLCPP_ERROR(
          logger(), "the pose of '%s' is not known with %zu joint values; links: %s", name.c_str(),
          joint_angles.size(), listed(Arm::link_names()).c_str());
        poses.clear();
        return false;
      }
      poses.push_back(written(pose));
    }
    return true;
  }

  const std::vector<std::string> & getJointNames() const override {return Arm::joint_names();}

  const std::vector<std::string> & getLinkNames() const override {return Arm::link_names();}

  /// Which joints are in excess was chosen when this was generated.
  bool setRedundantJoints(const std::vector<unsigned int> & redundant_joint_indices) override
  {
    const std::vector<std::size_t> & own = Arm::free_joints();
    std::vector<std::size_t> wanted(redundant_joint_indices.begin(), redundant_joint_indices.end());
    std::sort(wanted.begin(), wanted.end());
    if (wanted != own) {
      RCLCPP_ERROR(logger(), "other joints are in excess than those that this was generated with");
      return false;
    }
    return KinematicsBase::setRedundantJoints(redundant_joint_indices);
  }

  using kinematics::KinematicsBase::setRedundantJoints;

private:
  /// Whether the robot model brings its tip where the arm has it, at configurations within the limits.
  bool is_same_arm(const moveit::core::RobotModel & robot_model) const
  {
    const std::size_t n = Arm::joint_names().size();
    moveit::core::RobotState state(robot_model_);
    state.setToDefaultValues();
    for (int sample = 0; sample < 8; sample++) {
      std::vector<double> q(n);
      for (std::size_t j = 0; j < n; j++) {
        const double low = std::max(arm_.lower()[j], -3.0);
        const double high = std::max(low, std::min(arm_.upper()[j], 3.0));
        const double part = std::fmod(0.5 + 0.618034 * static_cast<double>(sample * 7 + 3 * j), 1.0);
        q[j] = low + part * (high - low);
        state.setJointPositions(robot_model.getJointModel(Arm::joint_names()[j]), &q[j]);
      }
      state.update();
      const auto there = state.getGlobalLinkTransform(Arm::base()).inverse()
        * state.getGlobalLinkTransform(Arm::tip());
      Pose model;
      Pose own;
      for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
          model.rotation[i][k] = there.linear()(i, k);
        }
        model.position[i] = there.translation()(i);
      }
      if (!arm_.link_pose(Arm::tip(), q, own)) {
        return false;
      }
      const std::array<double, 3> turn = turn_between(own, model);
      const double angle = std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
      const double away = std::hypot(
        own.position[0] - model.position[0], own.position[1] - model.position[1],
        own.position[2] - model.position[2]);
      if (!(away <= SAME && angle <= SAME)) {
        RCLCPP_ERROR(
          logger(), "the robot model has '%s' %g m and %g rad away from where this was generated to "
          "have it: generate again from its URDF", Arm::tip().c_str(), away, angle);
        return false;
      }
    }
    return true;
  }

  bool search(
    const geometry_msgs::msg::Pose & ik_pose, const std::vector<double> & seed, double timeout,
    const std::vector<double> & consistency_limits, std::vector<double> & solution,
    const IKCallbackFn & callback, moveit_msgs::msg::MoveItErrorCodes & error_code,
    const kinematics::KinematicsQueryOptions & options) const
  {
    error_code.val = moveit_msgs::msg::MoveItErrorCodes::NO_IK_SOLUTION;
    Pose pose;
    if (!is_ready_ || !read(ik_pose, pose)) {
      RCLCPP_ERROR(logger(), is_ready_ ? "the pose is none" : "initialize has not succeeded");
      return false;
    }
    Question question;
    question.seed = seed;
    question.consistency = consistency_limits;
    question.seconds = timeout;
    question.is_locked = options.lock_redundant_joints;
    question.is_approximate = options.return_approximate_solution;
    for (const std::size_t j : Arm::free_joints()) {
      question.step = getSearchDiscretization(static_cast<int>(j));
    }
    if (callback) {
      question.accepts = [&](const std::vector<double> & q) {
          error_code.val = moveit_msgs::msg::MoveItErrorCodes::SUCCESS;
          callback(ik_pose, q, error_code);
          return error_code.val == moveit_msgs::msg::MoveItErrorCodes::SUCCESS;
        };
    }
    const Outcome outcome = arm_.nearest(pose, question, solution);
    if (outcome == Outcome::found) {
      error_code.val = moveit_msgs::msg::MoveItErrorCodes::SUCCESS;
      return true;
    }
    if (outcome == Outcome::invalid) {
      RCLCPP_ERROR(
        logger(), "the seed has %zu values and there are %zu consistency limits; there are %zu joints",
        seed.size(), consistency_limits.size(), Arm::joint_names().size());
    }
    if (outcome != Outcome::rejected) {
      error_code.val = moveit_msgs::msg::MoveItErrorCodes::NO_IK_SOLUTION;
    }
    return false;
  }

  Arm arm_;
  bool is_ready_ = false;
};

}  // namespace @package@

PLUGINLIB_EXPORT_CLASS(@package@::MoveItPlugin, kinematics::KinematicsBase)
