// The dispatcher: one step of the run at each tick, chosen by the plan or by a person. `tick` carries
// out the waiting commands first. Then it makes one tick of the world if something is carried out, or
// else proposes the next operation.
#pragma once

#include "commands.hpp"

namespace dsfo {

struct Terms {
    std::map<int, int> start;  // states of some SBs
    std::map<int, int> goals;
    std::vector<std::string> avoid;  // addresses of operations that may not begin
    long seed = 0;  // what chance of disturbances comes from
    bool adopts = false;  // a mismatch is resolved by the only configuration that fits
    bool attended = false;  // somebody is there to decide and to answer
    std::map<std::string, std::string> levels;  // set before the start
    std::string refused;  // why the run may not start, empty if it may
    std::function<void(const Task&)> asks;  // called with every question to people that opens
    Supervisor* supervisor = nullptr;  // asked before every operation, after all guards
};

class Dispatcher {
public:
    Dispatcher(const Hierarchy& hierarchy, World& world, Terms terms);

    // Both return the events of this moment, as JSON objects. They throw nothing.
    std::vector<std::string> open();
    std::vector<std::string> tick();

    // Give a command (`command_table`). It waits for the next tick.
    void command(const Command& command) { waiting_.push_back(command); }
    void answer(
        const std::string& task, const std::string& option, const std::string& by,
        const std::string& role = "");
    void stop();  // brake and latch; end, if nobody attends the run
    void leave() { leaving_ = true; }  // nobody attends the run any more

    std::vector<const Task*> tasks() const;  // the open questions to people
    bool finished() const { return !reason_.empty(); }
    const std::string& reason() const { return reason_; }  // such as goal_reached or held
    double time() const { return run_ ? run_->time() : 0.0; }
    std::string phase() const;
    bool carrying() const { return driver_ && driver_->carrier; }

private:
    void begin();
    std::string refusal(Configuration& start, std::vector<Goal>& goals) const;
    bool obey();  // whether a command has set an operation going
    bool under_way() const;
    void end_before(const std::string& sentence);
    void lose();
    std::vector<std::string> drained();

    const Hierarchy& hierarchy_;
    World& world_;
    Terms terms_;
    Levels levels_;
    RiskLimit limit_;
    std::unique_ptr<LiveRun> run_;
    std::unique_ptr<Course> course_;
    std::unique_ptr<Driver> driver_;
    std::vector<Command> waiting_;
    bool leaving_ = false;
    std::string reason_;
};

}  // namespace dsfo
