// A stand-in for the part of rclcpp_lifecycle that a generated package uses.
#pragma once

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_lifecycle {

class State {};

namespace node_interfaces {

class LifecycleNodeInterface {
public:
    enum class CallbackReturn { SUCCESS, FAILURE, ERROR };

    virtual ~LifecycleNodeInterface() = default;
    virtual CallbackReturn on_configure(const State&) { return CallbackReturn::SUCCESS; }
    virtual CallbackReturn on_activate(const State&) { return CallbackReturn::SUCCESS; }
    virtual CallbackReturn on_deactivate(const State&) { return CallbackReturn::SUCCESS; }
    virtual CallbackReturn on_cleanup(const State&) { return CallbackReturn::SUCCESS; }
    virtual CallbackReturn on_shutdown(const State&) { return CallbackReturn::SUCCESS; }
};

}  // namespace node_interfaces

template <typename Message>
class LifecyclePublisher {
public:
    explicit LifecyclePublisher(std::string topic) : topic_(std::move(topic)) {}
    void publish(const Message& message) { stand_in::publish(topic_, message); }

private:
    std::string topic_;
};

class LifecycleNode : public node_interfaces::LifecycleNodeInterface {
public:
    explicit LifecycleNode(const std::string&) {}

    template <typename Value>
    void declare_parameter(const std::string& name, const Value& value) {
        if (!parameters_.count(name)) {
            parameters_[name] = rclcpp::Parameter(value);
        }
    }
    void set_parameter(const std::string& name, rclcpp::Parameter value) {
        parameters_[name] = std::move(value);
    }
    const rclcpp::Parameter& get_parameter(const std::string& name) const {
        return parameters_.at(name);
    }

    template <typename Message, typename Callback>
    typename rclcpp::Subscription<Message>::SharedPtr create_subscription(
        const std::string& topic, const rclcpp::QoS&, Callback callback) {
        stand_in::listeners[topic].push_back([callback](const void* message) {
            callback(*static_cast<const Message*>(message));
        });
        return std::make_shared<rclcpp::Subscription<Message>>();
    }
    template <typename Message>
    std::shared_ptr<LifecyclePublisher<Message>> create_publisher(
        const std::string& topic, const rclcpp::QoS&) {
        return std::make_shared<LifecyclePublisher<Message>>(topic);
    }
    rclcpp::TimerBase::SharedPtr create_wall_timer(
        std::chrono::duration<double>, std::function<void()> callback) {
        return std::make_shared<rclcpp::TimerBase>(std::move(callback));
    }

    rclcpp::Time now() const { return rclcpp::Time(stand_in::clock_seconds); }
    rclcpp::Logger get_logger() const { return {}; }
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() { return {}; }
    rclcpp::node_interfaces::NodeGraphInterface::SharedPtr get_node_graph_interface() { return {}; }
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr get_node_logging_interface() {
        return {};
    }
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr get_node_waitables_interface() {
        return {};
    }

private:
    std::map<std::string, rclcpp::Parameter> parameters_;
};

}  // namespace rclcpp_lifecycle
