// What rosidl would make of action/CarryOut.action.
#pragma once

#include <string>

namespace PACKAGE::action {

struct CarryOut {
    struct Goal {
        std::string address;
        std::string arguments;
    };
    struct Result {
        bool done = false;
        std::string message;
    };
    struct Feedback {
        float progress = 0.0F;
    };
};

}  // namespace PACKAGE::action
