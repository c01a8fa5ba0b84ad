// What rosidl would make of msg/FactValue.msg.
#pragma once

#include <string>

#include "rclcpp/rclcpp.hpp"

namespace PACKAGE::msg {

struct FactValue {
    builtin_interfaces::msg::Time stamp;
    bool known = false;
    std::string value;
};

}  // namespace PACKAGE::msg
