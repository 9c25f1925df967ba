#pragma once
#include <string>

namespace rclcpp {

enum class ParameterType { PARAMETER_NOT_SET, PARAMETER_INTEGER, PARAMETER_DOUBLE, PARAMETER_STRING };

class Parameter {
public:
    Parameter() = default;
    Parameter(const std::string &name, const std::string &value) : name_(name), text_(value) {}
    Parameter(const std::string &name, double value) : name_(name), number_(value) {}
    ParameterType get_type() const
    {
        return text_.empty() ? ParameterType::PARAMETER_DOUBLE : ParameterType::PARAMETER_STRING;
    }
    long as_int() const { return static_cast<long>(number_); }
    std::string as_string() const { return text_; }
    double as_double() const { return number_; }

private:
    std::string name_;
    std::string text_;
    double number_ = 0.0;
};

} // namespace rclcpp
