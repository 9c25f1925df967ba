#pragma once

namespace geometry_msgs {
namespace msg {

struct Point {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

struct Quaternion {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double w = 1.0;
};

struct Pose {
    Point position;
    Quaternion orientation;
};

} // namespace msg
} // namespace geometry_msgs
