// The arm held to the C functions, to itself, and to poses that the description's own tree of links has.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "@name@.h"
#include "@package@/arm.hpp"

using @package@::Arm;
using @package@::Outcome;
using @package@::Pose;
using @package@::Question;

namespace
{

constexpr std::size_t JOINTS = @n@;
const bool IS_SLIDE[JOINTS] = {@is_slide@};
/// Which columns of a pose a solution must meet.
const bool IS_MET[4] = {@is_met@};
int failures = 0;

void check(bool holds, const char * what)
{
  if (!holds) {
    failures++;
    std::printf("not so: %s\n", what);
  }
}

/// A configuration within the limits, none twice.
std::vector<double> configuration(const Arm & arm, std::size_t sample)
{
  std::vector<double> q;
  for (std::size_t j = 0; j < JOINTS; j++) {
    const double low = std::fmax(arm.lower()[j], -3.0);
    const double high = std::fmin(arm.upper()[j], 3.0);
    const double part = std::fmod(0.31 + 0.618034 * static_cast<double>(sample * 11 + 5 * j), 1.0);
    q.push_back(low + (0.05 + 0.9 * part) * (high - low));
  }
  return q;
}

/// The largest difference of an entry, lengths in sizes of the arm.
double apart(const Pose & a, const Pose & b)
{
  double most = 0.0;
  for (std::size_t i = 0; i < 3; i++) {
    for (std::size_t k = 0; k < 3; k++) {
      most = std::fmax(most, std::fabs(a.rotation[i][k] - b.rotation[i][k]));
    }
    most = std::fmax(most, std::fabs(a.position[i] - b.position[i]) / @size@);
  }
  return most;
}

/// The same of what a solution must meet.
double missed(const Pose & a, const Pose & b)
{
  Pose near = a;
  for (std::size_t i = 0; i < 3; i++) {
    for (std::size_t k = 0; k < 3; k++) {
      near.rotation[i][k] = IS_MET[k] ? a.rotation[i][k] : b.rotation[i][k];
    }
  }
  return apart(near, b);
}

Pose tip_at(const Arm & arm, const std::vector<double> & q)
{
  Pose pose;
  check(arm.link_pose(Arm::tip(), q, pose), "the pose of the tip is known");
  return pose;
}

/// Poses of links, as the tree of bodies has them: configuration, link, rows of the matrix.
struct Known
{
  double q[JOINTS];
  const char * link;
  double rows[3][4];
};

const Known KNOWN[] = {
@known@};

void test_links(const Arm & arm)
{
  for (const Known & known : KNOWN) {
    Pose pose;
    const std::vector<double> q(known.q, known.q + JOINTS);
    check(arm.link_pose(known.link, q, pose), "a link is known");
    Pose there;
    for (std::size_t i = 0; i < 3; i++) {
      there.rotation[i] = {known.rows[i][0], known.rows[i][1], known.rows[i][2]};
      there.position[i] = known.rows[i][3];
    }
    check(apart(pose, there) < 1e-9, "a link stands where the tree of bodies has it");
  }
  Pose pose;
  std::vector<double> matrix;
  check(!arm.link_pose("no such link", std::vector<double>(JOINTS), pose), "other links are refused");
  check(!arm.link_pose(Arm::tip(), std::vector<double>(JOINTS + 1), pose), "so are other sizes");
  check(!arm.jacobian("no such link", std::vector<double>(JOINTS), matrix), "in Jacobians, too");
}

/// Jacobians are what poses change by, and that of the tip is the one in C.
void test_jacobians(const Arm & arm)
{
  const double step = 1e-6;
  for (std::size_t sample = 0; sample < 4; sample++) {
    const std::vector<double> q = configuration(arm, sample);
    for (const std::string & link : Arm::link_names()) {
      std::vector<double> matrix;
      check(arm.jacobian(link, q, matrix), "a Jacobian is known");
      for (std::size_t j = 0; j < JOINTS; j++) {
        std::vector<double> before = q;
        std::vector<double> after = q;
        before[j] -= step;
        after[j] += step;
        Pose a;
        Pose b;
        check(arm.link_pose(link, before, a) && arm.link_pose(link, after, b), "so are poses");
        const std::array<double, 3> turn = turn_between(a, b);
        for (std::size_t i = 0; i < 3; i++) {
          const double v = (b.position[i] - a.position[i]) / (2.0 * step);
          check(std::fabs(v - matrix[JOINTS * i + j]) < 1e-7 * (1.0 + @size@), "velocities");
          check(
            std::fabs(turn[i] / (2.0 * step) - matrix[JOINTS * (i + 3) + j]) < 1e-7,
            "angular velocities");
        }
      }
    }
    double own[6][JOINTS];
    @name@_jacobian(q.data(), own);
    std::vector<double> matrix;
    check(arm.jacobian(Arm::tip(), q, matrix), "that of the tip is known");
    for (std::size_t k = 0; k < 6 * JOINTS; k++) {
      check(std::fabs(own[k / JOINTS][k % JOINTS] - matrix[k]) < 1e-9 * (1.0 + @size@), "it is that of C");
    }
  }
}

void test_quaternions(const Arm & arm)
{
  for (std::size_t sample = 0; sample < 50; sample++) {
    const Pose pose = tip_at(arm, configuration(arm, sample));
    @package@::Quaternion q = to_quaternion(pose);
    for (double & x : q) {
      x *= -3.0;
    }
    Pose back;
    check(from_quaternion(pose.position, q, back), "a quaternion of any length is one");
    check(apart(pose, back) < 1e-12, "to a quaternion and back");
  }
  Pose pose;
  check(!from_quaternion({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, pose), "0 is none");
  check(!from_quaternion({0.0, std::nan(""), 0.0}, {0.0, 0.0, 0.0, 1.0}, pose), "NaN is refused");
}

/// What is found has the pose, is within the limits and as near as is asked; the first seed is found again.
void test_search(Arm arm)
{
  std::size_t solved = 0;
  for (std::size_t sample = 0; sample < 200; sample++) {
    const std::vector<double> q = configuration(arm, sample);
    const Pose pose = tip_at(arm, q);
    Question question;
    question.seed = q;
    std::vector<double> found;
    // Beside singular poses what is found there may be less exact.
    if (arm.nearest(pose, question, found) == Outcome::found) {
      solved++;
      check(missed(tip_at(arm, found), pose) < 1e-6, "what is found has the pose");
      for (std::size_t j = 0; j < JOINTS; j++) {
        check(found[j] >= arm.lower()[j] && found[j] <= arm.upper()[j], "it is within the limits");
        check(std::fabs(found[j] - q[j]) < 1e-4, "the seed has the pose, and is found");
      }
      // Another one than those that are rejected, further and further away.
      std::vector<std::vector<double>> all;
      check(
        arm.all(pose, q, {}, all) == Outcome::found && !all.empty(), "all of them are there, too");
      double before = -1.0;
      std::size_t asked = 0;
      question.accepts = [&](const std::vector<double> & candidate) {
          check(missed(tip_at(arm, candidate), pose) < 1e-6, "each candidate has the pose");
          double away = 0.0;
          for (std::size_t j = 0; j < JOINTS; j++) {
            away = std::fmax(away, std::fabs(candidate[j] - q[j]) / (IS_SLIDE[j] ? @size@ : 1.0));
          }
          check(asked < 2 || away >= before - 1e-9, "the nearest comes first");
          before = away;
          asked++;
          return false;
        };
      question.is_locked = true;
      check(arm.nearest(pose, question, found) == Outcome::rejected, "all can be rejected");
      check(asked >= all.size(), "each is asked for");
      question.accepts = nullptr;
      question.is_locked = false;
      question.consistency.assign(JOINTS, 1e-3);
      check(arm.nearest(pose, question, found) == Outcome::found, "one that is near enough is found");
      question.consistency.assign(JOINTS, -1.0);
      check(
        arm.nearest(pose, question, found) == Outcome::outside_limits, "none is nearer than that");
    }
  }
  check(solved >= 190, "most configurations are found again");

  std::vector<double> found;
  Question question;
  question.seed = configuration(arm, 1);
  Pose far = tip_at(arm, question.seed);
  for (double & x : far.position) {
    x += 100.0 * @size@;
  }
  check(arm.nearest(far, question, found) != Outcome::found, "what is far is not reached");
  question.seed.pop_back();
  check(arm.nearest(far, question, found) == Outcome::invalid, "the seed has a value for each joint");
  question.seed.push_back(std::nan(""));
  check(arm.nearest(far, question, found) == Outcome::invalid, "and these are numbers");

  // Limits around one configuration leave that one.
  const std::vector<double> q = configuration(arm, 2);
  std::vector<double> lower = q;
  std::vector<double> upper = q;
  for (std::size_t j = 0; j < JOINTS; j++) {
    lower[j] -= 1e-3;
    upper[j] += 1e-3;
  }
  check(arm.set_limits(lower, upper), "limits can be given");
  check(!arm.set_limits(upper, lower), "but not exchanged");
  std::vector<std::vector<double>> all;
  check(arm.all(tip_at(arm, q), q, {}, all) == Outcome::found && all.size() == 1, "one is left");
  for (std::size_t j = 0; j < JOINTS; j++) {
    lower[j] += 0.01;
    upper[j] += 0.01;
  }
  check(arm.set_limits(lower, upper), "other limits");
  check(arm.all(tip_at(arm, q), q, {}, all) != Outcome::found && all.empty(), "none is left");
}

}  // namespace

int main()
{
  const Arm arm;
  test_links(arm);
  test_jacobians(arm);
  test_quaternions(arm);
  test_search(arm);
  if (failures == 0) {
    std::printf("arm: all checks hold\n");
  }
  return failures == 0 ? 0 : 1;
}
