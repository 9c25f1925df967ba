// Kinematics of @title@ for ros2_control: kinematics_interface::KinematicsInterface around the arm.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <kinematics_interface/kinematics_interface.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <rclcpp/logging.hpp>
#include <rclcpp/parameter.hpp>

#include "@package@/arm.hpp"

namespace @package@
{
namespace
{

rclcpp::Logger logger()
{
  return rclcpp::get_logger("@package@.control_plugin");
}

std::vector<double> values_of(const Eigen::VectorXd & vector)
{
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

bool pose_of(const Eigen::Matrix<double, 7, 1> & x, Pose & pose)
{
  return from_quaternion({x(0), x(1), x(2)}, {x(3), x(4), x(5), x(6)}, pose);
}

}  // namespace

// No function is marked as overriding: the interface has other ones in Humble and in Jazzy and later, and this has both.
class ControlPlugin : public kinematics_interface::KinematicsInterface
{
public:
  using Parameters = std::shared_ptr<rclcpp::node_interfaces::NodeParametersInterface>;

  /// Jazzy and later. Parameters: `tip`, which must be the tip that this was generated for; `base`, likewise, if it is there; `alpha`,
  /// the square of the damping of the inverse Jacobian.
  bool initialize(
    const std::string &, Parameters parameters, const std::string & param_namespace)
  {
    const std::string prefix = param_namespace.empty() ? "" : param_namespace + ".";
    std::string tip = Arm::tip();
    std::string base = Arm::base();
    rclcpp::Parameter value;
    if (parameters->has_parameter(prefix + "tip")
      && parameters->get_parameter(prefix + "tip", value))
    {
      tip = value.as_string();
    }
    if (parameters->has_parameter(prefix + "base")
      && parameters->get_parameter(prefix + "base", value) && !value.as_string().empty())
    {
      base = value.as_string();
    }
    return begin(parameters, prefix, base, tip);
  }

  /// Humble.
  bool initialize(Parameters parameters, const std::string & end_effector_name)
  {
    return begin(parameters, "", Arm::base(), end_effector_name);
  }

  bool convert_cartesian_deltas_to_joint_deltas(
    const Eigen::VectorXd & joint_pos, const Eigen::Matrix<double, 6, 1> & delta_x,
    const std::string & link_name, Eigen::VectorXd & delta_theta)
  {
    Eigen::Matrix<double, Eigen::Dynamic, 6> inverse;
    if (!calculate_jacobian_inverse(joint_pos, link_name, inverse)) {
      return false;
    }
    delta_theta = inverse * delta_x;
    return true;
  }

  bool convert_joint_deltas_to_cartesian_deltas(
    const Eigen::VectorXd & joint_pos, const Eigen::VectorXd & delta_theta,
    const std::string & link_name, Eigen::Matrix<double, 6, 1> & delta_x)
  {
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
    if (!calculate_jacobian(joint_pos, link_name, jacobian)) {
      return false;
    }
    if (delta_theta.size() != joint_pos.size()) {
      RCLCPP_ERROR(logger(), "there are not as many differences as joints");
      return false;
    }
    delta_x = jacobian * delta_theta;
    return true;
  }

  bool calculate_link_transform(
    const Eigen::VectorXd & joint_pos, const std::string & link_name, Eigen::Isometry3d & transform)
  {
    Pose pose;
    if (!is_ready(joint_pos) || !arm_.link_pose(link_name, values_of(joint_pos), pose)) {
      return refused(link_name);
    }
    transform.setIdentity();
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) {
        transform.linear()(i, k) = pose.rotation[i][k];
      }
      transform.translation()(i) = pose.position[i];
    }
    return true;
  }

  bool calculate_jacobian(
    const Eigen::VectorXd & joint_pos, const std::string & link_name,
    Eigen::Matrix<double, 6, Eigen::Dynamic> & jacobian)
  {
    std::vector<double> matrix;
    if (!is_ready(joint_pos) || !arm_.jacobian(link_name, values_of(joint_pos), matrix)) {
      return refused(link_name);
    }
    const Eigen::Index n = joint_pos.size();
    jacobian.resize(6, n);
    for (Eigen::Index i = 0; i < 6; i++) {
      for (Eigen::Index j = 0; j < n; j++) {
        jacobian(i, j) = matrix[n * i + j];
      }
    }
    return true;
  }

  /// The damped inverse (Wampler 1986): J^T (J J^T + alpha 1)^-1.
  bool calculate_jacobian_inverse(
    const Eigen::VectorXd & joint_pos, const std::string & link_name,
    Eigen::Matrix<double, Eigen::Dynamic, 6> & jacobian_inverse)
  {
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
    if (!calculate_jacobian(joint_pos, link_name, jacobian)) {
      return false;
    }
    const Eigen::Matrix<double, 6, 6> square =
      jacobian * jacobian.transpose() + alpha_ * Eigen::Matrix<double, 6, 6>::Identity();
    jacobian_inverse = square.ldlt().solve(jacobian).transpose();
    return true;
  }

  /// How a frame must move to be at another one after a time.
  bool calculate_frame_difference(
    Eigen::Matrix<double, 7, 1> & x_a, Eigen::Matrix<double, 7, 1> & x_b, double dt,
    Eigen::Matrix<double, 6, 1> & delta_x)
  {
    Pose a;
    Pose b;
    if (!(std::fabs(dt) > 0.0) || !pose_of(x_a, a) || !pose_of(x_b, b)) {
      RCLCPP_ERROR(logger(), "a frame is none, or no time passes");
      return false;
    }
    const std::array<double, 3> turn = turn_between(a, b);
    for (int i = 0; i < 3; i++) {
      delta_x(i) = (b.position[i] - a.position[i]) / dt;
      delta_x(i + 3) = turn[i] / dt;
    }
    return true;
  }

private:
  bool begin(
    Parameters parameters, const std::string & prefix, const std::string & base,
    const std::string & tip)
  {
    if (base != Arm::base() || tip != Arm::tip()) {
      RCLCPP_ERROR(
        logger(), "from '%s' to '%s' is wanted; this was generated from '%s' to '%s'", base.c_str(),
        tip.c_str(), Arm::base().c_str(), Arm::tip().c_str());
      return false;
    }
    rclcpp::Parameter value;
    if (parameters->has_parameter(prefix + "alpha")
      && parameters->get_parameter(prefix + "alpha", value))
    {
      // YAML reads 1 as a whole number.
      const bool is_whole = value.get_type() == rclcpp::ParameterType::PARAMETER_INTEGER;
      alpha_ = is_whole ? static_cast<double>(value.as_int()) : value.as_double();
    }
    is_begun_ = alpha_ > 0.0;
    if (!is_begun_) {
      RCLCPP_ERROR(logger(), "alpha must be above 0");
    }
    return is_begun_;
  }

  bool is_ready(const Eigen::VectorXd & joint_pos) const
  {
    if (!is_begun_) {
      RCLCPP_ERROR(logger(), "initialize has not succeeded");
      return false;
    }
    const auto n = static_cast<Eigen::Index>(Arm::joint_names().size());
    if (joint_pos.size() != n) {
      RCLCPP_ERROR(
        logger(), "%d joint values; there are %d joints", static_cast<int>(joint_pos.size()),
        static_cast<int>(n));
      return false;
    }
    return true;
  }

  bool refused(const std::string & link_name) const
  {
    RCLCPP_ERROR(logger(), "nothing is known of '%s' there", link_name.c_str());
    return false;
  }

  Arm arm_;
  double alpha_ = 5e-6;
  bool is_begun_ = false;
};

}  // namespace @package@

PLUGINLIB_EXPORT_CLASS(@package@::ControlPlugin, kinematics_interface::KinematicsInterface)
