#pragma once
#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace moveit {
namespace core {

struct VariableBounds {
    double min_position_ = 0.0;
    double max_position_ = 0.0;
    bool position_bounded_ = false;
};

class JointModel {
public:
    using Bounds = std::vector<VariableBounds>;
    std::string name;
    std::string parent;
    std::string child;
    bool moves = false;
    bool slides = false;
    Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
    Bounds bounds;

    const Bounds &getVariableBounds() const { return bounds; }
};

class JointModelGroup {
public:
    std::vector<std::string> joints;
    bool hasJointModel(const std::string &name) const
    {
        for (const std::string &own : joints) {
            if (own == name) {
                return true;
            }
        }
        return false;
    }
};

class RobotModel {
public:
    /* Each behind the one that its parent is the child of. */
    std::vector<JointModel> joints;
    std::map<std::string, JointModelGroup> groups;

    const JointModelGroup *getJointModelGroup(const std::string &name) const
    {
        const auto found = groups.find(name);
        return found == groups.end() ? nullptr : &found->second;
    }
    const JointModel *getJointModel(const std::string &name) const
    {
        for (const JointModel &joint : joints) {
            if (joint.name == name) {
                return &joint;
            }
        }
        return nullptr;
    }
};

using RobotModelConstPtr = std::shared_ptr<const RobotModel>;

class RobotState {
public:
    explicit RobotState(const RobotModelConstPtr &model) : model_(model) {}
    void setToDefaultValues() { values_.clear(); }
    void setJointPositions(const JointModel *joint, const double *position)
    {
        values_[joint->name] = *position;
    }
    void update()
    {
        links_.clear();
        for (const JointModel &joint : model_->joints) {
            if (links_.count(joint.parent) == 0) {
                links_[joint.parent] = Eigen::Isometry3d::Identity();
            }
            Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
            const double value = values_.count(joint.name) > 0 ? values_[joint.name] : 0.0;
            if (joint.moves && joint.slides) {
                motion.translation() = value * joint.axis;
            } else if (joint.moves) {
                motion.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
            }
            links_[joint.child] = links_[joint.parent] * joint.origin * motion;
        }
    }
    const Eigen::Isometry3d &getGlobalLinkTransform(const std::string &link) { return links_.at(link); }

private:
    RobotModelConstPtr model_;
    std::map<std::string, double> values_;
    std::map<std::string, Eigen::Isometry3d> links_;
};

} // namespace core
} // namespace moveit
