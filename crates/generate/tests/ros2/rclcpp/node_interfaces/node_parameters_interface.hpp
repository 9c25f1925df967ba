#pragma once
#include <map>
#include <rclcpp/parameter.hpp>
#include <string>

namespace rclcpp {
namespace node_interfaces {

class NodeParametersInterface {
public:
    std::map<std::string, Parameter> values;
    bool has_parameter(const std::string &name) const { return values.count(name) > 0; }
    bool get_parameter(const std::string &name, Parameter &parameter) const
    {
        const auto found = values.find(name);
        if (found == values.end()) {
            return false;
        }
        parameter = found->second;
        return true;
    }
};

} // namespace node_interfaces
} // namespace rclcpp
