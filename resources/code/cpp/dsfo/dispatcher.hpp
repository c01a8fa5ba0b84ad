// The dispatcher: one step of the run at each tick. `tick` makes one tick of the world if something
// is carried out, or else proposes the next operation.
#pragma once

#include <memory>

#include "carrier.hpp"
#include "planner.hpp"

namespace dsfo {

struct Terms {
    std::map<int, int> start;  // states of some SBs
    std::map<int, int> goals;
    std::vector<std::string> avoid;  // addresses of operations that may not begin
    long seed = 0;  // told in the events; the table world has no chance
    bool adopts = false;  // a mismatch is resolved by the only configuration that fits
};

class Dispatcher {
public:
    Dispatcher(const Hierarchy& hierarchy, World& world, Terms terms);

    // Both return the events of this moment, as JSON objects. They throw nothing.
    std::vector<std::string> open();
    std::vector<std::string> tick();

    void stop() { stopping_ = true; }  // brake and end at the next tick
    bool finished() const { return !reason_.empty(); }
    const std::string& reason() const { return reason_; }  // such as goal_reached or held

private:
    struct Hold {
        std::string reason;
        std::vector<std::string> details;
        std::string kind = "held";
    };

    void refuse(const std::string& sentence);
    void tell_start(const std::vector<Check>& checks);
    void propose();
    void look_at_goals();
    std::vector<Goal> reached() const;
    bool at_a_goal() const;
    StepPointer next_step(std::optional<Hold>& hold);
    void tell_bypasses(const std::vector<const Edge*>& edges);
    void admit(const StepPointer& step);
    std::optional<std::string> circling(const Edge& edge);
    void carry();
    void failed(const StepPointer& step, const Failure& failure);
    bool lost();
    bool endangered();
    Hold no_way();
    std::vector<std::string> risky_way();
    std::optional<Hold> relocalise(const std::string& cause, bool adopts);
    Hold hold_lost(
        const std::vector<std::string>& facts, const std::string& cause, const std::string& kind);
    std::vector<Configuration> candidates() const;
    std::vector<int> true_states(int branch, const Configuration& all) const;
    std::optional<Configuration> sub_alone(int branch) const;
    void adopt(const Configuration& configuration);
    void hold(const Hold& why);
    void finish(const std::string& reason, const std::string& sentence);
    void stop_now();
    void lose();
    Shut closed() const;
    std::string goal_text(const Goal& goal) const;
    std::vector<std::string> drained();

    const Hierarchy& hierarchy_;
    World& world_;
    Terms terms_;
    Edges edges_;
    std::unique_ptr<LiveRun> run_;
    std::vector<Goal> goals_;
    Shut shut_;
    Shut risky_;
    std::unique_ptr<Planner> planner_;
    Legs legs_;
    std::size_t leg_ = 0;
    std::size_t step_ = 0;
    std::unique_ptr<Carrier> carrier_;
    std::set<Goal> told_;
    std::set<std::string> bypassed_;
    std::map<std::pair<std::string, Configuration>, int> begun_;
    std::optional<double> since_;
    bool stopping_ = false;
    std::string reason_;
};

}  // namespace dsfo
