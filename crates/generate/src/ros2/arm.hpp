// @title@: forward kinematics of links, Jacobians, and a search for configurations, in plain C++.
//
// It knows nothing of ROS: the plug-ins beside it call it, and its test needs a compiler alone. Lengths in m, angles in rad;
// poses are those of links in @base@. All functions may be called by any number of threads at once.

#ifndef @PACKAGE@_ARM_HPP_
#define @PACKAGE@_ARM_HPP_

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace @package@
{

/// A link in the base of the chain: the columns of the rotation are its axes.
struct Pose
{
  std::array<std::array<double, 3>, 3> rotation;
  std::array<double, 3> position;
};

/// A quaternion, x, y, z, w.
using Quaternion = std::array<double, 4>;

/// The pose with a quaternion of any length above 0; false if there is no such rotation, or a number is not finite.
bool from_quaternion(
  const std::array<double, 3> & position, const Quaternion & orientation, Pose & pose);

/// The unit quaternion of a rotation, its w at least 0.
Quaternion to_quaternion(const Pose & pose);

/// The motion that leads from one orientation to another in a second, as an angular velocity along the axes of the base.
std::array<double, 3> turn_between(const Pose & from, const Pose & to);

/// How a search ended.
enum class Outcome
{
  /// There is a solution, and it is returned.
  found,
  /// There is none: the arm does not reach.
  out_of_reach,
  /// Those that are known lie outside of the limits, or farther from the seed than was allowed.
  outside_limits,
  /// Those that are known were all rejected by the caller.
  rejected,
  /// None was found, and it is not decided whether there is one: the pose is singular, or nearly so, or the joints in excess
  /// have values that were not tried.
  undecided,
  /// The seed or the limits have another size, or a number is not finite, or the matrix is no rotation.
  invalid
};

/// What is asked of a search.
struct Question
{
  /// A configuration to be near to.
  std::vector<double> seed;
  /// How far each joint may be from the seed; empty: any distance.
  std::vector<double> consistency;
  /// For how long values of joints in excess are tried after the first, seconds.
  double seconds = 0.0;
  /// By how much such a value differs from the one tried before.
  double step = 0.1;
  /// Joints in excess stay at the values of the seed.
  bool is_locked = false;
  /// Where there is no solution: the configuration that comes close.
  bool is_approximate = false;
  /// Is asked of each candidate, the nearest first; empty: all are right.
  std::function<bool(const std::vector<double> &)> accepts;
};

/// The arm between @base@ and @tip@.
class Arm
{
public:
  /// With the limits of the description.
  Arm();

  /// The joints, in order.
  static const std::vector<std::string> & joint_names();
  /// Links whose poses are known: those of the chain, and what is fixed to them.
  static const std::vector<std::string> & link_names();
  static const std::string & base();
  static const std::string & tip();
  /// Joints that the pose of the tip leaves free, from 0: an all-solutions search takes their values from the seed.
  static const std::vector<std::size_t> & free_joints();

  /// Other limits; false if the sizes differ from the number of joints, or a lower limit is above its upper one.
  bool set_limits(const std::vector<double> & lower, const std::vector<double> & upper);
  const std::vector<double> & lower() const {return lower_;}
  const std::vector<double> & upper() const {return upper_;}

  /// The pose of a link; false if there is no such link, or not one value for each joint.
  bool link_pose(const std::string & link, const std::vector<double> & q, Pose & pose) const;

  /// The geometric Jacobian of a link's origin, row by row, 6 by the number of joints: vx, vy, vz, wx, wy, wz along the axes of
  /// the base. False as above.
  bool jacobian(
    const std::string & link, const std::vector<double> & q, std::vector<double> & matrix) const;

  /// The configuration within the limits that has the pose and is nearest to the seed, by the largest difference of a joint, among
  /// those that are accepted.
  Outcome nearest(const Pose & pose, const Question & question, std::vector<double> & q) const;

  /// All configurations within the limits that have the pose, copies in whole turns among them, the nearest to the seed first. Joints
  /// in excess have the values of the seed or, with `steps`, values that far apart within their limits. Of families there is one
  /// member.
  Outcome all(
    const Pose & pose, const std::vector<double> & seed, const std::vector<double> & steps,
    std::vector<std::vector<double>> & solutions) const;

private:
  std::vector<double> lower_;
  std::vector<double> upper_;
};

}  // namespace @package@

#endif  // @PACKAGE@_ARM_HPP_
