#pragma once
#include <string>

namespace rclcpp {

class Parameter {
public:
    Parameter() = default;
    Parameter(const std::string &name, const std::string &value) : name_(name), text_(value) {}
    Parameter(const std::string &name, double value) : name_(name), number_(value) {}
    std::string as_string() const { return text_; }
    double as_double() const { return number_; }

private:
    std::string name_;
    std::string text_;
    double number_ = 0.0;
};

} // namespace rclcpp
