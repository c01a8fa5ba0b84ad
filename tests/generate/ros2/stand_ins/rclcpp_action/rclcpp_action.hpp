// A stand-in for the part of rclcpp_action that a generated package uses: clients of actions. The
// test serves the goals.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_action {

enum class ResultCode { UNKNOWN, SUCCEEDED, CANCELED, ABORTED };

template <typename Action>
class ClientGoalHandle {
public:
    using SharedPtr = std::shared_ptr<ClientGoalHandle>;

    struct WrappedResult {
        ResultCode code = ResultCode::UNKNOWN;
        std::shared_ptr<typename Action::Result> result;
    };
};

template <typename Action>
class Client {
public:
    using SharedPtr = std::shared_ptr<Client>;
    using GoalHandle = ClientGoalHandle<Action>;

    struct SendGoalOptions {
        std::function<void(typename GoalHandle::SharedPtr)> goal_response_callback;
        std::function<void(const typename GoalHandle::WrappedResult&)> result_callback;
    };

    explicit Client(std::string name) : name_(std::move(name)) {}

    bool action_server_is_ready() const { return served; }
    void async_send_goal(const typename Action::Goal& goal, const SendGoalOptions& options) {
        asked.push_back({name_, goal, options});
    }
    void async_cancel_all_goals() { ++cancelled; }

    struct Asked {
        std::string name;
        typename Action::Goal goal;
        SendGoalOptions options;
    };

    // What the test sees and sets.
    inline static std::vector<Asked> asked;
    inline static int cancelled = 0;
    inline static bool served = true;

private:
    std::string name_;
};

template <typename Action>
typename Client<Action>::SharedPtr create_client(
    const rclcpp::node_interfaces::NodeBaseInterface::SharedPtr&,
    const rclcpp::node_interfaces::NodeGraphInterface::SharedPtr&,
    const rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr&,
    const rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr&, const std::string& name) {
    return std::make_shared<Client<Action>>(name);
}

}  // namespace rclcpp_action
