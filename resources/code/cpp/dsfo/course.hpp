// The course of a run: its goals, the edges that it may use, and its plan while it is valid.
#pragma once

#include "planner.hpp"

namespace dsfo {

// The next step of the plan. `leg` is set if it begins a new one; `gave_up`: the search took too
// much.
struct Next {
    StepPointer step;
    const Leg* leg = nullptr;
    bool gave_up = false;
};

// All keys are addresses of edges. `shut` are avoided or pruned, `risky` have failed, `vetoed` are
// skipped while the run stays where they were vetoed. A route uses none of them. A person may still
// ask for a risky or a vetoed edge.
class Course {
public:
    Course(
        const Hierarchy& hierarchy, std::vector<Goal> its_goals,
        const std::vector<std::string>& avoid);

    std::vector<Goal> goals;
    Shut shut;
    Shut risky;
    Shut vetoed;

    void prune(const std::string& edge, const std::string& reason);
    bool restore(const std::string& edge);  // false if it was not shut out
    void tag_risky(const std::string& edge, const std::string& reason);
    void veto(const std::string& edge, const Configuration& here);
    void lift_vetoes(const std::vector<std::string>& edges);
    bool set_cost(const std::string& edge, double cost);  // false if it costs that already
    Shut closed() const;  // all edges that routes avoid

    const Edges& edges() const { return edges_; }
    StepAnswer asked(const Configuration& here, const Edge& edge);  // by a person
    Next next_step(const Configuration& here);
    std::string next_operation(const Configuration& here);  // the plan does not change
    std::vector<const Edge*> ahead() const;  // of the plan, after the step returned last
    void drop_plan();
    std::vector<std::string> risky_way(const Configuration& here);

private:
    Next next(const Configuration& here, Planner& planner);
    Planner& planner(const std::string& what, const Shut& shut);
    void changed();

    const Hierarchy& hierarchy_;
    Edges edges_;
    Configuration vetoed_at_;
    std::map<std::string, std::unique_ptr<Planner>> planners_;
    Legs legs_;
    std::size_t leg_ = 0;
    std::size_t step_ = 0;
};

std::string goal_text(const Hierarchy& hierarchy, const Goal& goal);

}  // namespace dsfo
