// A stand-in for the part of rclcpp that a generated package uses. There is one process, one
// thread, and a clock that the test moves.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace builtin_interfaces::msg {

struct Time {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
};

}  // namespace builtin_interfaces::msg

namespace stand_in {

inline double clock_seconds = 0.0;
inline std::map<std::string, std::vector<std::function<void(const void*)>>> listeners;
inline std::vector<std::function<void()>*> timers;

template <typename Message>
void publish(const std::string& topic, const Message& message) {
    for (const auto& listener : listeners[topic]) {
        listener(&message);
    }
}

}  // namespace stand_in

namespace rclcpp {

class Logger {};

class Duration {
public:
    explicit Duration(double seconds) : seconds_(seconds) {}
    double seconds() const { return seconds_; }

private:
    double seconds_;
};

class Time {
public:
    explicit Time(double seconds) : seconds_(seconds) {}
    explicit Time(const builtin_interfaces::msg::Time& stamp)
        : seconds_(stamp.sec + stamp.nanosec * 1e-9) {}
    Duration operator-(const Time& other) const { return Duration(seconds_ - other.seconds_); }

private:
    double seconds_;
};

class QoS {
public:
    explicit QoS(std::size_t) {}
};

template <typename Message>
class Subscription {
public:
    using SharedPtr = std::shared_ptr<Subscription>;
};

// A timer lives as long as somebody holds it.
class TimerBase {
public:
    using SharedPtr = std::shared_ptr<TimerBase>;

    explicit TimerBase(std::function<void()> callback) : callback_(std::move(callback)) {
        stand_in::timers.push_back(&callback_);
    }
    TimerBase(const TimerBase&) = delete;
    TimerBase& operator=(const TimerBase&) = delete;
    ~TimerBase() {
        auto& timers = stand_in::timers;
        for (std::size_t at = 0; at < timers.size(); ++at) {
            if (timers[at] == &callback_) {
                timers.erase(timers.begin() + static_cast<std::ptrdiff_t>(at));
                return;
            }
        }
    }

private:
    std::function<void()> callback_;
};

class Parameter {
public:
    using Texts = std::vector<std::string>;

    Parameter() = default;
    explicit Parameter(std::string text) : text_(std::move(text)) {}
    explicit Parameter(double number) : number_(number) {}
    explicit Parameter(Texts texts) : texts_(std::move(texts)) {}
    const std::string& as_string() const { return text_; }
    double as_double() const { return number_; }
    const Texts& as_string_array() const { return texts_; }

private:
    std::string text_;
    double number_ = 0.0;
    Texts texts_;
};

namespace node_interfaces {

class NodeBaseInterface {
public:
    using SharedPtr = std::shared_ptr<NodeBaseInterface>;
};
class NodeGraphInterface {
public:
    using SharedPtr = std::shared_ptr<NodeGraphInterface>;
};
class NodeLoggingInterface {
public:
    using SharedPtr = std::shared_ptr<NodeLoggingInterface>;
};
class NodeWaitablesInterface {
public:
    using SharedPtr = std::shared_ptr<NodeWaitablesInterface>;
};

}  // namespace node_interfaces

namespace executors {

class SingleThreadedExecutor {
public:
    void add_node(const node_interfaces::NodeBaseInterface::SharedPtr&) {}
    void spin() {}
};

}  // namespace executors

inline void init(int, char**) {}
inline void shutdown() {}

}  // namespace rclcpp

#define RCLCPP_ERROR(logger, ...) ((void)(logger), std::fprintf(stderr, __VA_ARGS__), std::fputs("\n", stderr))
#define RCLCPP_INFO(logger, ...) RCLCPP_ERROR(logger, __VA_ARGS__)
