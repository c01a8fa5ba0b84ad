// Plans routes over joint configurations, which are made only where the search goes (clauses 11 and
// 12).
#pragma once

#include "search.hpp"

namespace dsfo {

// The route to one goal: joint steps, and the configuration before each. Without a goal it leads to
// the nearest configuration in which no SB is in a failure state.
struct Leg {
    std::optional<Goal> goal;
    std::vector<StepPointer> steps;
    std::vector<Configuration> before;

    std::string aim(const Hierarchy& hierarchy) const;
    double cost() const;
    std::vector<std::string> operations() const;
    void apply(Configuration& configuration) const;
};

using Legs = std::vector<Leg>;

class Planner {
public:
    Planner(const Hierarchy& hierarchy, const Edges& edges, Shut shut);

    // The route to all goals, one leg for each that does not hold yet. `gave_up` says that the
    // search took too much.
    std::optional<Legs> legs(
        const Configuration& start, const std::vector<Goal>& goals, bool& gave_up);

    Stepper stepper;

private:
    std::optional<Legs> way(const Configuration& start, const std::vector<Goal>& goals);
    std::optional<Legs> to_goals(const Configuration& start, const std::vector<Goal>& goals);
    std::optional<Leg> leg(
        const Configuration& start, const std::optional<Goal>& goal,
        const std::vector<Goal>& wanted, const std::vector<Goal>& all, bool clean);
    std::vector<int> movers(const std::vector<Goal>& goals) const;
    bool moves(
        const Configuration& node, const std::vector<int>& movers, const std::set<int>& quiet,
        int routed, std::vector<Move>& found);
    std::set<int> quiet_ones(const std::vector<int>& movers, const std::set<int>& seen) const;

    const Hierarchy& hierarchy_;
    const Edges& edges_;
    std::set<int> required_;
    std::set<int> asking_;
    std::set<int> in_hazards_;
    bool gave_up_ = false;
};

}  // namespace dsfo
