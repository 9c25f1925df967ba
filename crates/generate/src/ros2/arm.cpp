#include "@package@/arm.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "@name@.h"

namespace @package@
{
namespace
{

constexpr std::size_t JOINTS = @n@;
constexpr std::size_t FRAMES = @frames@;

/// What a joint does: the frame about or along whose z axis it moves, the frames from which on this is felt, and how far for one unit of
/// the joint.
struct Motion
{
  std::size_t joint;
  std::size_t axis;
  std::size_t felt_from;
  bool is_slide;
  double rate;
};

const Motion MOTIONS[] = {
@motions@};

/// Where a link stands on a frame: the first three rows of the homogeneous matrix.
struct Mount
{
  std::size_t frame;
  double rows[3][4];
};

const Mount MOUNTS[] = {
@mounts@};

/// What lengths are compared with, m.
constexpr double SIZE = @size@;
const bool IS_SLIDE[JOINTS] = {@is_slide@};

bool are_finite(const std::vector<double> & values)
{
  return std::all_of(values.begin(), values.end(), [](double x) {return std::isfinite(x);});
}

/// The largest difference of a joint.
double distance(const std::vector<double> & a, const std::vector<double> & b)
{
  double most = 0.0;
  for (std::size_t j = 0; j < JOINTS; j++) {
    most = std::max(most, std::fabs(a[j] - b[j]) / (IS_SLIDE[j] ? SIZE : 1.0));
  }
  return most;
}

std::size_t index_of(const std::string & link)
{
  const std::vector<std::string> & all = Arm::link_names();
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), link) - all.begin());
}

void matrix_of(const Pose & pose, double matrix[4][4])
{
  for (std::size_t i = 0; i < 3; i++) {
    for (std::size_t k = 0; k < 3; k++) {
      matrix[i][k] = pose.rotation[i][k];
    }
    matrix[i][3] = pose.position[i];
    matrix[3][i] = 0.0;
  }
  matrix[3][3] = 1.0;
}

/// A mount on its frame.
Pose on_frame(const double frames[FRAMES][4][4], const Mount & mount)
{
  const double (*frame)[4] = frames[mount.frame];
  Pose pose;
  for (std::size_t i = 0; i < 3; i++) {
    double row[4];
    for (std::size_t k = 0; k < 4; k++) {
      row[k] = frame[i][0] * mount.rows[0][k] + frame[i][1] * mount.rows[1][k]
        + frame[i][2] * mount.rows[2][k];
    }
    pose.rotation[i] = {row[0], row[1], row[2]};
    pose.position[i] = row[3] + frame[i][3];
  }
  return pose;
}

@name@_ik_limits limits_of(const std::vector<double> & lower, const std::vector<double> & upper)
{
  @name@_ik_limits limits;
  std::copy(lower.begin(), lower.end(), limits.lower);
  std::copy(upper.begin(), upper.end(), limits.upper);
  return limits;
}

/// Adds what is within the limits with these values of the joints in excess.
@name@_ik_status add_all(
  double matrix[4][4], const std::vector<double> & given, const @name@_ik_limits & limits,
  std::vector<std::vector<double>> & found)
{
@given_values@
  int count = 0;
  @name@_ik_status status = @name@_ik_all_within_limits(
    matrix, @given_argument@&limits, 0, nullptr, &count);
  if (count > 0) {
    std::vector<std::array<double, JOINTS>> room(static_cast<std::size_t>(count));
    status = @name@_ik_all_within_limits(
      matrix, @given_argument@&limits, count,
      reinterpret_cast<double (*)[JOINTS]>(room.data()), &count);
    for (const auto & q : room) {
      found.emplace_back(q.begin(), q.end());
    }
  }
  return status;
}

/// Values of the joints in excess, one set after another: those of the seed, then further and further away from them (one joint), or
/// spread over their limits (several).
class Given
{
public:
  Given(
    const std::vector<double> & seed, const std::vector<double> & lower,
    const std::vector<double> & upper, double step)
  : step_(step)
  {
    for (const std::size_t j : Arm::free_joints()) {
      start_.push_back(seed[j]);
      const double reach = IS_SLIDE[j] ? SIZE : 3.141592653589793;
      lower_.push_back(std::isfinite(lower[j]) ? lower[j] : seed[j] - reach);
      upper_.push_back(std::isfinite(upper[j]) ? upper[j] : seed[j] + reach);
    }
  }

  bool next(std::vector<double> & values)
  {
    values = start_;
    if (count_ == 0) {
      count_ = 1;
      return true;
    }
    if (start_.empty() || !(step_ > 0.0)) {
      return false;
    }
    return start_.size() == 1 ? beside(values) : spread(values);
  }

private:
  /// One step further up, then as far down, until both are outside.
  bool beside(std::vector<double> & values)
  {
    for (;; count_++) {
      const double away = step_ * static_cast<double>((count_ + 1) / 2);
      const double value = start_[0] + (count_ % 2 == 1 ? away : -away);
      if (start_[0] + away > upper_[0] && start_[0] - away < lower_[0]) {
        return false;
      }
      if (value >= lower_[0] && value <= upper_[0]) {
        values[0] = value;
        count_++;
        return true;
      }
    }
  }

  /// Halton's points: fractions of the ranges to the bases 2, 3, 5, ...
  bool spread(std::vector<double> & values)
  {
    static const std::size_t bases[] = {2, 3, 5, 7, 11, 13, 17, 19};
    for (std::size_t k = 0; k < values.size(); k++) {
      const std::size_t base = bases[k % 8];
      double part = 1.0;
      double fraction = 0.0;
      for (std::size_t rest = count_; rest > 0; rest /= base) {
        part /= static_cast<double>(base);
        fraction += part * static_cast<double>(rest % base);
      }
      values[k] = lower_[k] + fraction * (upper_[k] - lower_[k]);
    }
    count_++;
    return count_ <= MOST;
  }

  static constexpr std::size_t MOST = 100000;
  std::vector<double> start_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  double step_;
  std::size_t count_ = 0;
};

/// What a status says where nothing was accepted.
Outcome outcome_of(@name@_ik_status status)
{
  switch (status) {
    case @NAME@_IK_NO_SOLUTION:
      return Outcome::out_of_reach;
    case @NAME@_IK_OUTSIDE_LIMITS:
      return Outcome::outside_limits;
    case @NAME@_IK_NOT_A_ROTATION:
    case @NAME@_IK_NOT_FINITE:
      return Outcome::invalid;
    case @NAME@_IK_SOLVED:
    case @NAME@_IK_FAMILY:
    case @NAME@_IK_UNDECIDED:
      break;
  }
  return Outcome::undecided;
}

}  // namespace

bool from_quaternion(
  const std::array<double, 3> & position, const Quaternion & orientation, Pose & pose)
{
  const auto [x, y, z, w] = orientation;
  const double square = x * x + y * y + z * z + w * w;
  if (!(square > 1e-12 && std::isfinite(square))
    || !std::all_of(position.begin(), position.end(), [](double p) {return std::isfinite(p);}))
  {
    return false;
  }
  const double s = 2.0 / square;
  pose.rotation = {{
    {1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
    {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
    {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}}};
  pose.position = position;
  return true;
}

Quaternion to_quaternion(const Pose & pose)
{
  // Each row is 4 q times a component of q; the one with the largest diagonal entry is the best conditioned (Shepperd 1978).
  const auto & r = pose.rotation;
  const double rows[4][4] = {
    {1.0 + r[0][0] - r[1][1] - r[2][2], r[1][0] + r[0][1], r[0][2] + r[2][0], r[2][1] - r[1][2]},
    {r[1][0] + r[0][1], 1.0 - r[0][0] + r[1][1] - r[2][2], r[2][1] + r[1][2], r[0][2] - r[2][0]},
    {r[0][2] + r[2][0], r[2][1] + r[1][2], 1.0 - r[0][0] - r[1][1] + r[2][2], r[1][0] - r[0][1]},
    {r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1], 1.0 + r[0][0] + r[1][1] + r[2][2]}};
  std::size_t best = 3;
  for (std::size_t k = 0; k < 3; k++) {
    best = rows[k][k] > rows[best][best] ? k : best;
  }
  const double * row = rows[best];
  const double length = std::sqrt(
    row[0] * row[0] + row[1] * row[1] + row[2] * row[2] + row[3] * row[3]);
  const double scale = (row[3] < 0.0 ? -1.0 : 1.0) / length;
  return {scale * row[0], scale * row[1], scale * row[2], scale * row[3]};
}

std::array<double, 3> turn_between(const Pose & from, const Pose & to)
{
  Pose turn{};
  for (std::size_t i = 0; i < 3; i++) {
    for (std::size_t k = 0; k < 3; k++) {
      for (std::size_t m = 0; m < 3; m++) {
        turn.rotation[i][k] += to.rotation[i][m] * from.rotation[k][m];
      }
    }
  }
  const Quaternion q = to_quaternion(turn);
  const double sine = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  const double scale = sine > 0.0 ? 2.0 * std::atan2(sine, q[3]) / sine : 2.0;
  return {scale * q[0], scale * q[1], scale * q[2]};
}

Arm::Arm()
: lower_(@name@_limits.lower, @name@_limits.lower + JOINTS),
  upper_(@name@_limits.upper, @name@_limits.upper + JOINTS)
{
}

const std::vector<std::string> & Arm::joint_names()
{
  static const std::vector<std::string> names = {@joint_names@};
  return names;
}

const std::vector<std::string> & Arm::link_names()
{
  static const std::vector<std::string> names = {@link_names@};
  return names;
}

const std::string & Arm::base()
{
  static const std::string name = @base_text@;
  return name;
}

const std::string & Arm::tip()
{
  static const std::string name = @tip_text@;
  return name;
}

const std::vector<std::size_t> & Arm::free_joints()
{
  static const std::vector<std::size_t> joints = {@free@};
  return joints;
}

bool Arm::set_limits(const std::vector<double> & lower, const std::vector<double> & upper)
{
  if (lower.size() != JOINTS || upper.size() != JOINTS) {
    return false;
  }
  for (std::size_t j = 0; j < JOINTS; j++) {
    if (!(lower[j] <= upper[j])) {
      return false;
    }
  }
  lower_ = lower;
  upper_ = upper;
  return true;
}

bool Arm::link_pose(const std::string & link, const std::vector<double> & q, Pose & pose) const
{
  const std::size_t index = index_of(link);
  if (index == link_names().size() || q.size() != JOINTS) {
    return false;
  }
  double frames[FRAMES][4][4];
  @name@_frames(q.data(), frames);
  pose = on_frame(frames, MOUNTS[index]);
  return true;
}

bool Arm::jacobian(
  const std::string & link, const std::vector<double> & q, std::vector<double> & matrix) const
{
  const std::size_t index = index_of(link);
  if (index == link_names().size() || q.size() != JOINTS) {
    return false;
  }
  double frames[FRAMES][4][4];
  @name@_frames(q.data(), frames);
  const Mount & mount = MOUNTS[index];
  const Pose pose = on_frame(frames, mount);
  matrix.assign(6 * JOINTS, 0.0);
  for (const Motion & motion : MOTIONS) {
    if (motion.felt_from > mount.frame) {
      continue;
    }
    const double (*frame)[4] = frames[motion.axis];
    const double axis[3] = {
      motion.rate * frame[0][2], motion.rate * frame[1][2], motion.rate * frame[2][2]};
    for (std::size_t i = 0; i < 3; i++) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      const double lever_j = pose.position[j] - frame[j][3];
      const double lever_k = pose.position[k] - frame[k][3];
      matrix[JOINTS * i + motion.joint] +=
        motion.is_slide ? axis[i] : axis[j] * lever_k - axis[k] * lever_j;
      matrix[JOINTS * (i + 3) + motion.joint] += motion.is_slide ? 0.0 : axis[i];
    }
  }
  return true;
}

Outcome Arm::nearest(const Pose & pose, const Question & question, std::vector<double> & q) const
{
  const std::vector<double> & seed = question.seed;
  const bool is_bounded = !question.consistency.empty();
  if (seed.size() != JOINTS || !are_finite(seed)
    || (is_bounded && question.consistency.size() != JOINTS))
  {
    return Outcome::invalid;
  }
  double matrix[4][4];
  matrix_of(pose, matrix);
  const @name@_ik_limits limits = limits_of(lower_, upper_);
  bool is_any_rejected = false;
  bool is_any_far = false;
  const auto is_right = [&](const std::vector<double> & candidate) {
      for (std::size_t j = 0; is_bounded && j < JOINTS; j++) {
        if (!(std::fabs(candidate[j] - seed[j]) <= question.consistency[j])) {
          is_any_far = true;
          return false;
        }
      }
      if (question.accepts && !question.accepts(candidate)) {
        is_any_rejected = true;
        return false;
      }
      q = candidate;
      return true;
    };

  const bool is_free = !free_joints().empty() && !question.is_locked;
  Outcome outcome = Outcome::undecided;
  if (free_joints().empty() || is_free) {
    @name@_ik_choice choice;
    outcome = outcome_of(@name@_ik_nearest(matrix, seed.data(), &limits, &choice));
    if (outcome == Outcome::invalid) {
      return outcome;
    }
    const std::vector<double> own(choice.q, choice.q + JOINTS);
    if (choice.is_found && is_right(own)) {
      return Outcome::found;
    }
    if (question.is_approximate && !choice.is_found && outcome != Outcome::outside_limits
      && is_right(own))
    {
      return Outcome::found;
    }
  }

  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Given sets(seed, lower_, upper_, is_free ? question.step : 0.0);
  std::vector<double> given;
  while (sets.next(given)) {
    std::vector<std::vector<double>> found;
    const Outcome own = outcome_of(add_all(matrix, given, limits, found));
    outcome = free_joints().empty() ? outcome : own;
    if (own == Outcome::invalid) {
      return own;
    }
    std::sort(
      found.begin(), found.end(), [&](const std::vector<double> & a, const std::vector<double> & b) {
        return distance(a, seed) < distance(b, seed);
      });
    for (const std::vector<double> & candidate : found) {
      if (is_right(candidate)) {
        return Outcome::found;
      }
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() >= question.seconds) {
      break;
    }
  }
  if (is_any_rejected) {
    return Outcome::rejected;
  }
  if (is_any_far) {
    return Outcome::outside_limits;
  }
  // That the arm does not reach with these values of joints in excess says nothing of others.
  return is_free ? Outcome::undecided : outcome;
}

Outcome Arm::all(
  const Pose & pose, const std::vector<double> & seed, const std::vector<double> & steps,
  std::vector<std::vector<double>> & solutions) const
{
  solutions.clear();
  const std::size_t free = free_joints().size();
  if (seed.size() != JOINTS || !are_finite(seed) || (!steps.empty() && steps.size() != free)) {
    return Outcome::invalid;
  }
  double matrix[4][4];
  matrix_of(pose, matrix);
  const @name@_ik_limits limits = limits_of(lower_, upper_);
  // For each joint in excess the values that are tried.
  std::vector<std::vector<double>> values(free);
  std::size_t sets = 1;
  for (std::size_t k = 0; k < free; k++) {
    const std::size_t j = free_joints()[k];
    const bool is_ranged = std::isfinite(lower_[j]) && std::isfinite(upper_[j]);
    if (steps.empty()) {
      values[k].push_back(seed[j]);
    } else if (!is_ranged || !(steps[k] > 0.0) || (upper_[j] - lower_[j]) / steps[k] > 10000.0) {
      return Outcome::invalid;
    } else {
      const auto count = static_cast<std::size_t>((upper_[j] - lower_[j]) / steps[k]) + 1;
      for (std::size_t i = 0; i < count; i++) {
        values[k].push_back(lower_[j] + steps[k] * static_cast<double>(i));
      }
    }
    sets *= values[k].size();
    if (sets > 1000000) {
      return Outcome::invalid;
    }
  }
  bool is_decided = true;
  bool is_reached = false;
  std::vector<double> given(free);
  for (std::size_t set = 0; set < sets; set++) {
    std::size_t rest = set;
    for (std::size_t k = 0; k < free; k++) {
      given[k] = values[k][rest % values[k].size()];
      rest /= values[k].size();
    }
    const @name@_ik_status status = add_all(matrix, given, limits, solutions);
    if (outcome_of(status) == Outcome::invalid) {
      return Outcome::invalid;
    }
    is_decided = is_decided && status != @NAME@_IK_UNDECIDED && status != @NAME@_IK_FAMILY;
    is_reached = is_reached || status == @NAME@_IK_OUTSIDE_LIMITS;
  }
  std::sort(
    solutions.begin(), solutions.end(),
    [&](const std::vector<double> & a, const std::vector<double> & b) {
      return distance(a, seed) < distance(b, seed);
    });
  if (!solutions.empty()) {
    return Outcome::found;
  }
  if (is_reached) {
    return Outcome::outside_limits;
  }
  return is_decided && free == 0 ? Outcome::out_of_reach : Outcome::undecided;
}

}  // namespace @package@
