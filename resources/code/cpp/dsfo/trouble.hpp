// Failures: the run relocalises, and then goes on, adopts a configuration or holds (clauses 8 and
// 9). Nothing is undone.
#pragma once

#include "carrier.hpp"
#include "course.hpp"

namespace dsfo {

// Why a run cannot go on by itself. `kind` is held, no_route, guard_lost, goal_unconfirmed or
// hazard. `skipped` are the vetoed edges of a run without a route.
struct Hold {
    std::string reason;
    std::vector<std::string> details;
    std::string kind = "held";
    std::vector<std::string> skipped;

    std::string ends() const { return kind == "no_route" ? kind : "held"; }
};

class Trouble {
public:
    Trouble(LiveRun& run, Course& course, bool adopts)
        : run_(run), course_(course), adopts_(adopts) {}

    std::vector<Configuration> candidates;  // those that fitted the scene at the last look

    void blame(const JointStep& step, const Failure& failure);
    std::optional<Hold> after(const Failure& failure);
    Hold lost(
        const std::vector<std::string>& facts, const std::string& cause,
        const std::string& kind);
    Hold endangered(const std::vector<Hazard>& hazards, bool observes);
    std::optional<Hold> unconfirmed(const std::vector<Goal>& goals);

    // Go on if the scene confirms the committed configuration; else adopt the only one that fits,
    // if the terms of the run say so, or hold.
    std::optional<Hold> relocalise(const std::string& cause = "", bool adopts = true);
    void adopt(const Configuration& configuration);
    std::vector<Configuration> located() const;  // from the scene alone
    Hold no_way();

private:
    std::vector<Configuration> agreeing(bool from_scene) const;
    std::vector<int> true_states(int branch, const Configuration& all) const;
    std::optional<Configuration> sub_alone(int branch) const;
    std::string hindrance(const Edge& edge);

    LiveRun& run_;
    Course& course_;
    bool adopts_;
};

}  // namespace dsfo
