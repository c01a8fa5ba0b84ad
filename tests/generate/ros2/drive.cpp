// Drives the node of a run: it senses facts, and serves or fails the goals. The words are what goes
// wrong: nothing, fails, rejected, unserved, silent (no result), stale (old facts), stopped.
#include <iostream>

#include "blueprint.hpp"
#include "channels.hpp"
#include "run_node.hpp"

namespace {

using Client = rclcpp_action::Client<ros::CarryOut>;

dsfo::Configuration configuration;

void sense(const dsfo::Blueprint& whole, bool stale) {
    for (const ros::FactTopic& one : ros::fact_topics) {
        ros::FactValue value;
        const double read = stand_in::clock_seconds - (stale ? 1.0 : 0.0);
        value.stamp.sec = static_cast<std::int32_t>(read);
        value.stamp.nanosec =
            static_cast<std::uint32_t>((read - value.stamp.sec) * 1e9);
        value.known = true;
        const auto branch = static_cast<std::size_t>(one.branch);
        value.value = whole.branches[branch].value(configuration[branch], one.digit);
        stand_in::publish(one.topic, value);
    }
}

// Serves what was asked: the facts become those of the target.
void serve(const dsfo::Blueprint& whole, const std::string& wrong) {
    std::vector<Client::Asked> asked;
    asked.swap(Client::asked);
    for (const Client::Asked& one : asked) {
        if (wrong == "rejected") {
            one.options.goal_response_callback(nullptr);
            continue;
        }
        one.options.goal_response_callback(std::make_shared<Client::GoalHandle>());
        const std::vector<std::string> names = dsfo::parts(one.goal.address);
        const auto branch = static_cast<std::size_t>(whole.number_of(names[0]));
        const dsfo::Branch& own = whole.branches[branch];
        const auto source = static_cast<std::size_t>(own.number_of(names[1]));
        for (const auto& [operation, target] : own.states[source].operations) {
            if (operation == names[2] && wrong != "fails") {
                configuration[branch] = target;
            }
        }
        Client::GoalHandle::WrappedResult said;
        said.code = rclcpp_action::ResultCode::SUCCEEDED;
        said.result = std::make_shared<ros::CarryOut::Result>();
        said.result->done = wrong != "fails";
        if (wrong != "silent") {
            one.options.result_callback(said);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    const std::string wrong = count > 1 ? words[1] : "nothing";
    const dsfo::Blueprint whole = blueprint();
    for (const dsfo::Branch& one : whole.branches) {
        configuration.push_back(one.initial);
    }
    const rclcpp_lifecycle::State state;
    ros::RunNode node;
    if (count > 2) {
        node.set_parameter("log", rclcpp::Parameter(std::string(words[2])));
    }
    Client::served = wrong != "unserved";
    stand_in::listeners["~/events"].push_back([](const void* message) {
        std::cout << static_cast<const std_msgs::msg::String*>(message)->data << "\n";
    });
    using Answer = ros::RunNode::Answer;
    if (node.on_configure(state) != Answer::SUCCESS) {
        return 2;
    }
    sense(whole, wrong == "stale");
    if (node.on_activate(state) != Answer::SUCCESS) {
        return 2;
    }
    for (int tick = 0; tick < 20000 && node.reason().empty(); ++tick) {
        stand_in::clock_seconds += 0.05;
        sense(whole, wrong == "stale");
        const auto timers = stand_in::timers;
        for (const auto& timer : timers) {
            (*timer)();
        }
        if (wrong == "stopped" && !Client::asked.empty()) {
            break;
        }
        serve(whole, wrong);
    }
    node.on_deactivate(state);
    std::cerr << "cancelled " << Client::cancelled << "\n";
    node.on_cleanup(state);
    return 0;
}
